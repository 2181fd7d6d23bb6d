#include "difmesh/float_environment.hpp"
#include "difmesh/metrics/distance.hpp"
#include "difmesh/shapes.hpp"

namespace difmesh {

Distance distance(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                  const Shape& shape, const DistanceOptions& options) {
  const DefaultFloatEnvironment environment;
  const SignedDistance function = [&shape](const Vec3& point) { return shape.distance(point); };
  return distance(positions, triangles, function, options);
}

}  // namespace difmesh
