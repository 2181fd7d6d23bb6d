#include "closest_point.hpp"

#include <algorithm>
#include <cstddef>

#include "base/vector3.hpp"

namespace difmesh::detail {
namespace {

// Rounding moves the foot along a triangle by 2^-52 of its length, times length over height. Each
// correction brings that factor in once more. In thin triangles one is not enough; and where the
// normal is nothing but rounding none helps, but then the sides are as close.
constexpr double kThin = 0x1p-20;
constexpr int kThinCorrections = 4;

double sum(const Vec3& weights) noexcept {
  return weights[0] + weights[1] + weights[2];
}

/// \pre the sum of the weights is positive
Vec3 combine(const Vec3& weights, const Corners& corners) noexcept {
  const Vec3 sides = plus(scaled(corners[0], weights[0]), scaled(corners[1], weights[1]));
  return scaled(plus(sides, scaled(corners[2], weights[2])), 1.0 / sum(weights));
}

Vec3 closest_on_sides(const Corners& corners) noexcept {
  Vec3 best = closest_on_segment(corners[0], corners[1]);
  for (const std::size_t from : {std::size_t{1}, std::size_t{2}}) {
    const Vec3 point = closest_on_segment(corners[from], corners[(from + 1) % 3]);
    best = squared_length(point) < squared_length(best) ? point : best;
  }
  return best;
}

}  // namespace

Vec3 closest_on_segment(const Vec3& a, const Vec3& b) noexcept {
  const Vec3 way = minus(b, a);
  const double past_a = -dot(a, way);
  const double before_b = dot(b, way);
  if (!(past_a > 0.0)) {
    return a;
  }
  if (!(before_b > 0.0)) {
    return b;
  }
  // From the nearer end, so that rounding is in proportion to the shorter way.
  const double whole = past_a + before_b;
  return past_a < before_b ? plus(a, scaled(way, past_a / whole))
                           : minus(b, scaled(way, before_b / whole));
}

Vec3 closest_on_triangle(const Corners& corners) noexcept {
  const auto& [a, b, c] = corners;
  const Vec3 ab = minus(b, a);
  const Vec3 bc = minus(c, b);
  const Vec3 ca = minus(a, c);
  const Vec3 normal = cross(ab, bc);
  // The share of each corner in the foot of the perpendicular is the area over the opposite side.
  Vec3 weights{dot(normal, cross(b, bc)), dot(normal, cross(c, ca)), dot(normal, cross(a, ab))};
  if (*std::min_element(weights.begin(), weights.end()) < 0.0 || !(sum(weights) > 0.0)) {
    return closest_on_sides(corners);
  }
  const double longest2 = std::max({squared_length(ab), squared_length(bc), squared_length(ca)});
  const bool thin = squared_length(normal) < kThin * kThin * longest2 * longest2;
  Vec3 foot = combine(weights, corners);
  for (int correction = 0; correction < (thin ? kThinCorrections : 1); ++correction) {
    // What is left of the way in the plane.
    const Vec3 rest = cross(normal, foot);
    weights = {std::max(0.0, weights[0] + dot(bc, rest)), std::max(0.0, weights[1] + dot(ca, rest)),
               std::max(0.0, weights[2] + dot(ab, rest))};
    if (sum(weights) > 0.0) {
      foot = combine(weights, corners);
    }
  }
  if (thin) {
    const Vec3 on_side = closest_on_sides(corners);
    return squared_length(on_side) < squared_length(foot) ? on_side : foot;
  }
  return foot;
}

}  // namespace difmesh::detail
