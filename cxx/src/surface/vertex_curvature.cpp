#include "difmesh/vertex_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector3.hpp"
#include "curved/surface_maker.hpp"
#include "curved/surface_table.hpp"
#include "difmesh/edge_id.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "surface/node_place.hpp"

namespace difmesh {
namespace {

using detail::BlockField;

constexpr std::int64_t kVerticesPerPortion = 8192;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// An end of a vertex's edge: the cell that it stands for, as far as one does, and where the vertex
// is from the cell's centre.
struct End {
  std::int64_t cell = -1;  // its number in the grid; -1: none
  Vec3 vertex{0.0, 0.0, 0.0};
};

struct VertexEnds {
  End lower;
  End upper;
  double share = 0.0;  // of the way from the lower one
};

End end_at(const BlockField& field, const detail::NodePlace& place, std::size_t axis,
           double along) {
  End end;
  end.vertex = place.from_centre;
  end.vertex[axis] += along;
  std::int64_t number = 0;
  for (std::size_t t = 3; t-- > 0;) {
    const std::int64_t resolved = field.axes[t].resolve(place.cell[t]);
    if (!detail::is_cell(resolved)) {
      return end;
    }
    number = number * field.grid.dims[t] + resolved;
  }
  end.cell = number;
  return end;
}

VertexEnds ends_of(const BlockField& field, std::uint64_t id, const Vec3& position) {
  const DualEdgeName edge = edge_of(field.grid.dims, id);
  const auto axis = static_cast<std::size_t>(edge.axis);
  // Local indices of nodes are one more than those of cells.
  Index3 lower{edge.lower[0] + 1, edge.lower[1] + 1, edge.lower[2] + 1};
  Index3 upper = lower;
  ++upper[axis];
  const detail::NodePlace low = detail::place_of(field, lower);
  const detail::NodePlace high = detail::place_of(field, upper);
  const double from_lower = position[axis] - field.grid.cell_centre(low.cell)[axis];
  const double apart =
      detail::centre_distance(field, axis, low.cell[axis], high.cell[axis] - low.cell[axis]);
  VertexEnds ends;
  ends.lower = end_at(field, low, axis, from_lower - low.from_centre[axis]);
  ends.upper = end_at(field, high, axis, from_lower - apart - high.from_centre[axis]);
  if (ends.lower.cell == ends.upper.cell) {
    ends.upper.cell = -1;  // from a centre to its face, or between faces
  }
  ends.share = apart != 0.0 ? std::clamp(from_lower / apart, 0.0, 1.0) : 0.0;
  return ends;
}

// Vertices of a portion: their ends, and the surfaces of all cells among these.
template <class T>
class Portion {
 public:
  Portion(const BlockField& field, const detail::SurfaceMaker<T>& maker, const Mesh& mesh)
      : field_(field), maker_(maker), mesh_(mesh) {}

  void run(std::size_t begin, std::size_t end, Curvature& result) {
    for (std::size_t v = begin; v < end; ++v) {
      ends_.push_back(ends_of(field_, mesh_.edge_ids[v], mesh_.positions[v]));
      for (const End& each : {ends_.back().lower, ends_.back().upper}) {
        if (each.cell >= 0) {
          cells_.push_back(each.cell);
        }
      }
    }
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    for (const std::int64_t cell : cells_) {
      surfaces_.push_back(maker_(cell_at(cell)));
    }
    for (std::size_t v = begin; v < end; ++v) {
      const detail::LevelCurvature curvature = curvature_at(ends_[v - begin]);
      result.mean[v] = curvature.mean;
      result.gaussian[v] = curvature.gaussian;
      if (!result.largest.empty()) {
        result.largest[v] = curvature.mean + curvature.spread();
        result.smallest[v] = curvature.mean - curvature.spread();
      }
    }
  }

 private:
  [[nodiscard]] Index3 cell_at(std::int64_t number) const {
    const Index3& dims = field_.grid.dims;
    return {number % dims[0], number / dims[0] % dims[1], number / dims[0] / dims[1]};
  }

  // The surface of an end's cell; null where it owns none.
  [[nodiscard]] const detail::LocalSurface* surface_of(const End& end) const {
    if (end.cell < 0) {
      return nullptr;
    }
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), end.cell) - cells_.begin();
    const detail::LocalSurface& surface = surfaces_[static_cast<std::size_t>(at)];
    return surface.count > 0 ? &surface : nullptr;
  }

  [[nodiscard]] detail::LevelCurvature at(const End& end,
                                          const detail::LocalSurface& surface) const {
    const double length = detail::unit_length(field_, cell_at(end.cell));
    const detail::LevelCurvature local =
        detail::curvature_of(surface.jet(detail::scaled(end.vertex, 1.0 / length)));
    return {local.mean / length, local.gaussian / length / length};
  }

  [[nodiscard]] detail::LevelCurvature curvature_at(const VertexEnds& ends) const {
    const detail::LocalSurface* const lower = surface_of(ends.lower);
    const detail::LocalSurface* const upper = surface_of(ends.upper);
    if (lower == nullptr && upper == nullptr) {
      return {kNaN, kNaN};
    }
    if (lower == nullptr || upper == nullptr) {
      return lower != nullptr ? at(ends.lower, *lower) : at(ends.upper, *upper);
    }
    const double weight = detail::blend(ends.share);
    const detail::LevelCurvature low = at(ends.lower, *lower);
    const detail::LevelCurvature high = at(ends.upper, *upper);
    return {(1.0 - weight) * low.mean + weight * high.mean,
            (1.0 - weight) * low.gaussian + weight * high.gaussian};
  }

  const BlockField& field_;
  const detail::SurfaceMaker<T>& maker_;
  const Mesh& mesh_;
  std::vector<VertexEnds> ends_;
  std::vector<std::int64_t> cells_;  // ascending
  std::vector<detail::LocalSurface> surfaces_;
};

void check_mesh(const Mesh& mesh, const Grid& grid) {
  if (mesh.edge_ids.size() != mesh.positions.size()) {
    throw Error(ErrorCode::invalid_argument, "vertex_curvature: the mesh has no edge_ids");
  }
  const std::uint64_t end = edge_id_end(grid.dims);
  for (const std::uint64_t id : mesh.edge_ids) {
    if (id >= end) {
      throw Error(ErrorCode::invalid_argument,
                  "vertex_curvature: an edge id outside the grid: " + std::to_string(id));
    }
  }
}

// Patches on the mesh where cells say nothing.
void fill_in(const Mesh& mesh, const Options& options, Curvature& result) {
  if (std::none_of(result.mean.begin(), result.mean.end(),
                   [](double mean) { return std::isnan(mean); })) {
    return;
  }
  CurvatureOptions patches;
  patches.threads = options.threads;
  patches.principal = !result.largest.empty();
  const Curvature fitted = curvature(mesh, patches);
  for (std::size_t v = 0; v < result.mean.size(); ++v) {
    if (!std::isnan(result.mean[v])) {
      continue;
    }
    result.mean[v] = fitted.mean[v];
    result.gaussian[v] = fitted.gaussian[v];
    if (patches.principal) {
      result.largest[v] = fitted.largest[v];
      result.smallest[v] = fitted.smallest[v];
    }
    result.undefined_vertices += std::isnan(fitted.mean[v]) ? 1 : 0;
  }
  result.widened_vertices = fitted.widened_vertices;
}

}  // namespace

Curvature vertex_curvature(const FieldView& field, const Grid& grid, const Mesh& mesh,
                           const Options& options, bool principal) {
  const DefaultFloatEnvironment environment;
  const BlockField block =
      detail::make_block_field(field, {{0, 0, 0}, grid.dims, {}, {}}, grid, options);
  check_mesh(mesh, grid);
  const std::size_t vertices = mesh.positions.size();
  Curvature result;
  result.mean.resize(vertices);
  result.gaussian.resize(vertices);
  result.largest.resize(principal ? vertices : 0);
  result.smallest.resize(principal ? vertices : 0);
  detail::Workers workers(options.threads);
  detail::Phases phases(workers, options.progress);
  detail::with_scalar(field.type, [&](auto type) {
    using T = decltype(type);
    const detail::SurfaceMaker<T> maker(block, CellSurfaceKind::curvature);
    phases.run(1.0, static_cast<std::int64_t>(vertices), kVerticesPerPortion,
               [&](std::int64_t begin, std::int64_t end) {
                 Portion<T>(block, maker, mesh)
                     .run(static_cast<std::size_t>(begin), static_cast<std::size_t>(end), result);
               });
  });
  fill_in(mesh, options, result);
  phases.finish();
  return result;
}

}  // namespace difmesh
