#include "smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/smoothing.hpp"
#include "names.hpp"
#include "parse.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

/// The number of a kind that comes without, and what it may be.
struct KindRules {
  SmoothingKind kind;
  double usual;
  Range range;
  bool is_whole;
};

constexpr std::array<Named<SmoothingKind>, 4> kKinds{{{"laplacian", SmoothingKind::laplacian},
                                                      {"taubin", SmoothingKind::taubin},
                                                      {"flow", SmoothingKind::flow},
                                                      {"constrained", SmoothingKind::constrained}}};

constexpr std::array<KindRules, 4> kRules{{{SmoothingKind::laplacian, 1.0, {1.0, 1e6}, true},
                                           {SmoothingKind::taubin, 15.0, {1.0, 1e6}, true},
                                           {SmoothingKind::flow, 1.0, {1e-6, 1e6}, false},
                                           {SmoothingKind::constrained, 0.01, {1e-9, 0.5}, false}}};

const KindRules& rules_of(SmoothingKind kind) {
  return *std::find_if(kRules.begin(), kRules.end(),
                       [kind](const KindRules& rules) { return rules.kind == kind; });
}

Array<Vec3> moved(const Smoothing& smoothing, const SmoothingContext& context, const Mesh& mesh) {
  const int steps = static_cast<int>(smoothing.number);
  switch (smoothing.kind) {
    case SmoothingKind::laplacian: {
      LaplacianOptions options;
      options.steps = steps;
      options.threads = context.threads;
      options.progress = context.progress;
      return smooth_laplacian(mesh.positions, mesh.triangles, options);
    }
    case SmoothingKind::taubin: {
      TaubinOptions options;
      options.steps = steps;
      options.threads = context.threads;
      options.progress = context.progress;
      return smooth_taubin(mesh.positions, mesh.triangles, options);
    }
    case SmoothingKind::flow: {
      const Vec3& spacing = context.grid.spacing;
      const double cell = *std::min_element(spacing.begin(), spacing.end());
      CurvatureFlowOptions options;
      options.time = smoothing.number * cell * cell;
      options.threads = context.threads;
      options.progress = context.progress;
      return smooth_by_curvature_flow(mesh.positions, mesh.triangles, options);
    }
    case SmoothingKind::constrained:
      break;
  }
  ConstrainedSmoothingOptions options;
  options.tolerance = smoothing.number;
  options.threads = context.threads;
  options.progress = context.progress;
  return smooth_within_fractions(mesh, context.grid, options).positions;
}

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Vec3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Vertices whose triangles have no area keep the normal that they had.
void renew_normals(Mesh& mesh) {
  Array<Vec3> sums;
  sums.assign(mesh.positions.size(), Vec3{0.0, 0.0, 0.0});
  for (const Triangle& t : mesh.triangles) {
    const Vec3 area = area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    for (const std::uint32_t v : t) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sums[v][axis] += area[axis];
      }
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double length = std::hypot(sums[v][0], sums[v][1], sums[v][2]);
    for (std::size_t axis = 0; axis < 3 && length > 0.0; ++axis) {
      mesh.normals[v][axis] = sums[v][axis] / length;
    }
  }
}

}  // namespace

Smoothing parse_smoothing(const std::string& option, const std::string& text) {
  const std::size_t colon = text.find(':');
  Smoothing smoothing;
  smoothing.kind = parse_name(option, text.substr(0, colon), kKinds);
  const KindRules& rules = rules_of(smoothing.kind);
  smoothing.number = rules.usual;
  if (colon != std::string::npos) {
    const std::string number = text.substr(colon + 1);
    smoothing.number = rules.is_whole
                           ? static_cast<double>(parse_integer(
                                 option, number, static_cast<std::int64_t>(rules.range.low),
                                 static_cast<std::int64_t>(rules.range.high)))
                           : parse_number(option, number, rules.range);
  }
  return smoothing;
}

std::string smoothing_text(const Smoothing& smoothing) {
  return std::string(name_of(kKinds, smoothing.kind)) + ":" + exact(smoothing.number);
}

void smooth_surface(const Smoothing& smoothing, const SmoothingContext& context, Mesh& mesh) {
  mesh.positions = moved(smoothing, context, mesh);
  if (!mesh.normals.empty()) {
    renew_normals(mesh);
  }
}

}  // namespace difmesh::cli
