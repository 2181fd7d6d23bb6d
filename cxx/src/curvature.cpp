#include "difmesh/curvature.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "mesh_arrays.hpp"
#include "parallel.hpp"
#include "quadric_patch.hpp"
#include "ring_walk.hpp"
#include "vector3.hpp"
#include "vertex_neighbours.hpp"

namespace difmesh {
namespace {

using namespace detail;

constexpr std::int64_t kVerticesPerPortion = 512;
constexpr int kMostRings = 8;
// Twice what a patch has coefficients: half a neighbourhood of two rings, as on a boundary, has
// less.
constexpr std::size_t kEnoughNeighbours = 12;
constexpr int kMostExtraRings = 4;

void check(std::span<const Vec3> positions, std::span<const Triangle> triangles,
           const CurvatureOptions& options) {
  if (options.rings < 1 || options.rings > kMostRings) {
    throw Error(ErrorCode::invalid_argument, "curvature: rings must be 1 to " +
                                                 std::to_string(kMostRings) + ", got " +
                                                 std::to_string(options.rings));
  }
  if (positions.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::too_large, "curvature: the mesh has " +
                                          std::to_string(positions.size()) +
                                          " vertices, more than 2^32 - 1");
  }
  check_mesh_arrays("curvature", positions, triangles);
}

/// Sums of the triangles' vector areas, in the order of the triangles.
Array<Vec3> area_vectors(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  Array<Vec3> sums;
  sums.assign(positions.size(), Vec3{0.0, 0.0, 0.0});
  for (const Triangle& t : triangles) {
    const Vec3& base = positions[t[0]];
    const Vec3 area = cross(minus(positions[t[1]], base), minus(positions[t[2]], base));
    for (const std::uint32_t v : t) {
      sums[v] = plus(sums[v], area);
    }
  }
  return sums;
}

/// Everything that vertices are fitted from.
struct Surface {
  std::span<const Vec3> positions;
  const Array<Vec3>& areas;
  const VertexNeighbours& neighbours;
  int rings;
};

class VertexFit {
 public:
  explicit VertexFit(const Surface& surface) : surface_(surface), walk_(surface.neighbours) {}

  PatchCurvature operator()(std::uint32_t vertex) {
    is_widened_ = false;
    walk_.start(vertex);
    for (int ring = 0; ring < surface_.rings; ++ring) {
      walk_.add_ring();
    }
    const Vec3& area = surface_.areas[vertex];
    const double size = std::max({std::abs(area[0]), std::abs(area[1]), std::abs(area[2])});
    if (!(size > 0.0) || !std::isfinite(size)) {
      return {};
    }
    const Vec3 normal = unit({area[0] / size, area[1] / size, area[2] / size});
    for (int extra = 0;; ++extra) {
      if (walk_.vertices().size() > kEnoughNeighbours) {
        const PatchCurvature curvature = fit(normal);
        if (curvature.is_determined) {
          return curvature;
        }
      }
      if (extra == kMostExtraRings || !walk_.add_ring()) {
        return fit(normal);
      }
      is_widened_ = true;
    }
  }
  /// Whether the last vertex needed more rings.
  [[nodiscard]] bool is_widened() const { return is_widened_; }

 private:
  PatchCurvature fit(const Vec3& normal) {
    points_.assign(surface_.positions, walk_.vertices());
    const double unit = points_.unit();
    if (!(unit > 0.0) || !std::isfinite(unit)) {
      return {};
    }
    PatchCurvature curvature = fit_patch(points_.points(), normal);
    curvature.mean /= unit;
    curvature.half_difference /= unit;
    curvature.is_determined = curvature.is_determined && std::isfinite(curvature.mean) &&
                              std::isfinite(curvature.half_difference);
    return curvature;
  }

  const Surface& surface_;
  RingWalk walk_;
  PatchPoints points_;
  bool is_widened_ = false;
};

void store(const PatchCurvature& fitted, std::size_t vertex, Curvature& result) {
  constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
  const double mean = fitted.is_determined ? fitted.mean : kUndefined;
  const double half = fitted.half_difference;
  result.mean[vertex] = mean;
  result.gaussian[vertex] = (mean - half) * (mean + half);
  if (!result.largest.empty()) {
    result.largest[vertex] = mean + half;
    result.smallest[vertex] = mean - half;
  }
}

}  // namespace

Curvature curvature(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                    const CurvatureOptions& options) {
  check(positions, triangles, options);
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  const Array<Vec3> areas = area_vectors(positions, triangles);
  const VertexNeighbours neighbours(positions.size(), triangles, workers);
  const Surface surface{positions, areas, neighbours, options.rings};

  Curvature result;
  result.mean.resize(positions.size());
  result.gaussian.resize(positions.size());
  if (options.principal) {
    result.largest.resize(positions.size());
    result.smallest.resize(positions.size());
  }
  struct Counts {
    std::int64_t undefined = 0;
    std::int64_t widened = 0;
  };
  const auto count = static_cast<std::int64_t>(positions.size());
  std::vector<Counts> counts(
      static_cast<std::size_t>((count + kVerticesPerPortion - 1) / kVerticesPerPortion));
  phases.run(1.0, count, kVerticesPerPortion, [&](std::int64_t begin, std::int64_t end) {
    VertexFit fit(surface);
    Counts& here = counts[static_cast<std::size_t>(begin / kVerticesPerPortion)];
    for (std::int64_t v = begin; v < end; ++v) {
      const PatchCurvature fitted = fit(static_cast<std::uint32_t>(v));
      store(fitted, static_cast<std::size_t>(v), result);
      here.undefined += fitted.is_determined ? 0 : 1;
      here.widened += fitted.is_determined && fit.is_widened() ? 1 : 0;
    }
  });
  for (const Counts& part : counts) {
    result.undefined_vertices += part.undefined;
    result.widened_vertices += part.widened;
  }
  phases.finish();
  return result;
}

}  // namespace difmesh
