#pragma once
/// \file import_plan.hpp
/// From a view of a mesh to halfedges that can be written into any library. Internal to the
/// adapters.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "difmesh/adapters/detail/halfedges.hpp"
#include "difmesh/adapters/detail/refuse_faces.hpp"

namespace difmesh::detail {

/// What a library can hold.
struct Limits {
  std::uint64_t items = 0;  ///< vertices, halfedges, faces: as many of each
  double coordinate = 0.0;  ///< largest coordinate
};

struct ImportPlan {
  Corners corners;                         ///< of the faces that stay
  std::vector<std::uint32_t> own_indices;  ///< theirs, where some were refused
  Halfedges halfedges;
  ImportReport report;
};

inline void check_arrays(const MeshView& view, double largest) {
  const auto fail = [](ErrorCode code, const std::string& message) { throw Error(code, message); };
  if (view.vertices < 0 || view.triangles < 0 || (view.vertices > 0 && !view.positions) ||
      (view.triangles > 0 && !view.indices)) {
    fail(ErrorCode::invalid_argument, "a mesh view has negative sizes or lacks an array");
  }
  for (const ScalarView& scalar : view.scalars) {
    if (scalar.values.size() != static_cast<std::size_t>(view.vertices)) {
      fail(ErrorCode::invalid_argument, "scalar '" + scalar.name + "' holds " +
                                            std::to_string(scalar.values.size()) + " values for " +
                                            std::to_string(view.vertices) + " vertices");
    }
  }
  bool fits = true;
  for (std::int64_t n = 0; n < 3 * view.vertices; ++n) {
    fits = fits & (std::abs(view.positions[n]) <= largest);
  }
  for (std::int64_t n = 0; !fits && n < 3 * view.vertices; ++n) {
    if (!(std::abs(view.positions[n]) <= largest)) {
      fail(ErrorCode::invalid_value, "the position of vertex " + std::to_string(n / 3) +
                                         " is not finite or too large for the library's numbers");
    }
  }
}

[[nodiscard]] inline bool all_faces_proper(const Corners& corners) {
  for (std::uint32_t face = 0; face < corners.count / 3; ++face) {
    if (fate_alone(corners, face)) {
      return false;
    }
  }
  return true;
}

inline void drop_refused(ImportPlan& plan) {
  const Fates fates = refuse_faces(plan.corners);
  for (std::uint32_t face = 0; face < fates.size(); ++face) {
    if (fates[face]) {
      plan.report.refused.push_back({std::int64_t{face}, *fates[face]});
    } else {
      const std::uint32_t* v = plan.corners.indices + std::size_t{3} * face;
      plan.own_indices.insert(plan.own_indices.end(), v, v + 3);
    }
  }
  plan.corners.indices = plan.own_indices.data();
  plan.corners.count = static_cast<std::uint32_t>(plan.own_indices.size());
}

/// \throw Error invalid_argument, invalid_value, too_large
[[nodiscard]] inline ImportPlan plan_import(const MeshView& view, const Limits& limits) {
  check_arrays(view, limits.coordinate);
  const auto too_large = [&limits](std::uint64_t count, const char* what) {
    if (count > limits.items) {
      throw Error(ErrorCode::too_large, "the mesh library cannot hold " + std::to_string(count) +
                                            " " + what + ", " + std::to_string(limits.items) +
                                            " at most");
    }
  };
  // Corners are counted in 32 bits here.
  const auto corners = 3 * static_cast<std::uint64_t>(view.triangles);
  if (corners >= kNone) {
    throw Error(ErrorCode::too_large, std::to_string(view.triangles) + " triangles are too many");
  }
  too_large(static_cast<std::uint64_t>(view.vertices), "vertices");

  ImportPlan plan;
  plan.corners = {view.indices, static_cast<std::uint32_t>(corners),
                  static_cast<std::uint32_t>(view.vertices)};
  if (!all_faces_proper(plan.corners) || !connect(plan.corners, plan.halfedges)) {
    drop_refused(plan);
    if (!connect(plan.corners, plan.halfedges)) {
      throw std::logic_error("difmesh: refused faces do not leave a manifold");
    }
  }
  too_large(2 * std::uint64_t{plan.halfedges.edges}, "halfedges");
  plan.report.vertices = view.vertices;
  plan.report.edges = plan.halfedges.edges;
  plan.report.faces = plan.corners.count / 3;
  return plan;
}

}  // namespace difmesh::detail
