#include "difmesh/metrics/point_distances.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

#include "base/first_error.hpp"
#include "base/parallel.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "reference_surface.hpp"
#include "surface_view.hpp"

namespace difmesh {
namespace {

using namespace detail;

constexpr std::int64_t kPointsAtOnce = 256;

void check_points(std::span<const Vec3> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
      throw Error(ErrorCode::invalid_argument,
                  "distance: point " + std::to_string(i) + " is not finite");
    }
  }
}

}  // namespace

PointDistances point_distances(std::span<const Vec3> points, const Mesh& reference,
                               const DistanceOptions& options) {
  const DefaultFloatEnvironment environment;
  check_points(points);
  SurfaceView surface{"reference", reference.positions, reference.triangles};
  check_surface(surface);
  const Box box = box_of(reference.positions);
  surface.scale = scale_of(box, points.empty() ? box : box_of(points));
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  const ReferenceSurface field(surface, options.with_sign, options.threads, workers);
  PointDistances result{Array<double>(points.size()), field.has_sign()};
  FirstError error;
  phases.run(1.0, static_cast<std::int64_t>(points.size()), kPointsAtOnce,
             [&](std::int64_t begin, std::int64_t end) {
               error.guard(begin, [&] {
                 const std::unique_ptr<DistanceProbe> probe = field.probe();
                 for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end);
                      ++i) {
                   result.distances[i] = probe->measure(points[i]);
                 }
               });
             });
  error.rethrow();
  phases.finish();
  return result;
}

}  // namespace difmesh
