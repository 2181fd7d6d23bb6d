#include "difmesh/plane.hpp"

#include <algorithm>
#include <cmath>

#include "planes/cube_fraction.hpp"

namespace difmesh {
namespace detail {

double cube_offset(double m0, double m1, double m2, double fraction) {
  return baseline::offset_of_share(baseline::sorted(m0, m1, m2), fraction);
}

}  // namespace detail

namespace {

// Scaled to a largest component of 1, so that no product underflows. The offset scales along.
struct ScaledNormal {
  Vec3 m;
  double scale;

  ScaledNormal(const Vec3& normal, const Vec3& spacing)
      : m{normal[0] * spacing[0], normal[1] * spacing[1], normal[2] * spacing[2]},
        scale(std::max({std::abs(m[0]), std::abs(m[1]), std::abs(m[2])})) {
    for (double& component : m) {
      component /= scale;
    }
  }
};

}  // namespace

double plane_fraction(const Vec3& normal, const Vec3& spacing, double offset) noexcept {
  const ScaledNormal scaled(normal, spacing);
  return detail::cube_fraction(scaled.m[0], scaled.m[1], scaled.m[2], offset / scaled.scale);
}

double plane_offset(const Vec3& normal, const Vec3& spacing, double fraction) noexcept {
  const ScaledNormal scaled(normal, spacing);
  return scaled.scale * detail::cube_offset(scaled.m[0], scaled.m[1], scaled.m[2], fraction);
}

}  // namespace difmesh
