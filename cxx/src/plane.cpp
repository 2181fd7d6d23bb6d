#include "difmesh/plane.hpp"

#include "unit_plane.hpp"

namespace difmesh {
namespace detail {
namespace {

// The range where the cut is a polygon of four to six corners has no inverse free of cancellation.
// corner_fraction is smooth and increasing there, so a few of Newton's steps from the chord do,
// within a bracket that closes where rounding would throw them about.
double solve_corner_distance(const SortedNormal& m, double share, double low, double high) {
  const double at_low = corner_fraction(m, low);
  const double at_high = corner_fraction(m, high);
  if (share >= at_high || !(at_low < at_high)) {
    return high;
  }
  const double lost = 1e-9 * (high - low);
  double alpha = low + (high - low) * std::max(share - at_low, 0.0) / (at_high - at_low);
  for (int step = 0; step < 32; ++step) {
    const double excess = corner_fraction(m, alpha) - share;
    const double next = std::clamp(alpha - excess / corner_area(m, alpha), low, high);
    // Steps shrink quadratically: after one this small the next would be lost in rounding.
    if (std::abs(next - alpha) <= lost) {
      return next;
    }
    (excess > 0.0 ? high : low) = alpha;
    alpha = next;
  }
  return alpha;
}

}  // namespace

double corner_distance(const SortedNormal& m, double share) {
  // Shares at which the plane passes the next corner of the cube.
  const double at_small = m.middle > 0.0 ? m.small / m.middle * (m.small / m.large) / 6.0 : 0.0;
  if (share < at_small) {
    return std::cbrt(6.0 * share * m.small * m.middle * m.large);
  }
  const double at_middle = at_small + (m.middle - m.small) / m.large / 2.0;
  if (share < at_middle) {
    const double product = 2.0 * m.middle * m.large * (share - at_small);
    return m.small / 2.0 + std::sqrt(m.small * m.small / 4.0 + product);
  }
  const double two = m.small + m.middle;
  if (two <= m.large && share >= two / m.large / 2.0) {
    return share * m.large + two / 2.0;
  }
  return solve_corner_distance(m, share, m.middle, std::min(two, m.sum() / 2.0));
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
