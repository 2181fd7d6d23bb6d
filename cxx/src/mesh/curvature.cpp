#include "difmesh/curvature.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "mesh/area_vectors.hpp"
#include "mesh/mesh_arrays.hpp"
#include "mesh/vertex_neighbours.hpp"
#include "mesh/vertex_patch.hpp"

namespace difmesh {
namespace {

using namespace detail;

constexpr std::int64_t kVerticesPerPortion = 512;
constexpr int kMostRings = 8;
void check(std::span<const Vec3> positions, std::span<const Triangle> triangles,
           const CurvatureOptions& options) {
  if (options.rings < 1 || options.rings > kMostRings) {
    throw Error(ErrorCode::invalid_argument, "curvature: rings must be 1 to " +
                                                 std::to_string(kMostRings) + ", got " +
                                                 std::to_string(options.rings));
  }
  check_mesh_arrays("curvature", positions, triangles);
}

void store(const PatchFit& fitted, std::size_t vertex, Curvature& result) {
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
  const DefaultFloatEnvironment environment;
  check(positions, triangles, options);
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  const Array<Vec3> areas = area_vectors(positions, triangles);
  const VertexNeighbours neighbours(positions.size(), triangles, workers);
  const PatchSurface surface{positions, areas, neighbours, options.rings};

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
    VertexPatch fit(surface);
    Counts& here = counts[static_cast<std::size_t>(begin / kVerticesPerPortion)];
    for (std::int64_t v = begin; v < end; ++v) {
      const PatchFit fitted = fit(static_cast<std::uint32_t>(v));
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
