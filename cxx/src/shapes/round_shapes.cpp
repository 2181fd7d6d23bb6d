#include "shapes/round_shapes.hpp"

#include <algorithm>
#include <cstddef>

namespace difmesh::detail {

EllipsoidModel::EllipsoidModel(const Vec3& semi_axes) : axes_(semi_axes) {
  for (std::size_t a = 0; a < 3; ++a) {
    weight_[a] = 1.0 / (axes_[a] * axes_[a]);
  }
  half_ = 0.5 * std::min({axes_[0], axes_[1], axes_[2]});
}

Extent EllipsoidModel::extent(const Vec3& direction) const {
  const double reach =
      length({axes_[0] * direction[0], axes_[1] * direction[1], axes_[2] * direction[2]});
  return {reach, reach};
}

// The nearest point is x_i = a_i^2 |u_i| / (t + a_i^2) for the largest root t of g(t) = sum (a_i
// |u_i| / (t + a_i^2))^2 - 1. In s = t + c^2, c the least semi-axis, s >= 0 and g is convex and
// falling, so Newton from the left goes up to the root without passing it. Working in s keeps all
// digits where the root is next to the pole at s = 0, which is where u is near the plane of the two
// longer axes. On that plane there may be no root: then s = 0, and x is completed along the short
// axis.
double EllipsoidModel::distance(const Vec3& u) const {
  const double c = std::min({axes_[0], axes_[1], axes_[2]});
  const Vec3 y{std::abs(u[0]), std::abs(u[1]), std::abs(u[2])};
  Vec3 gap;
  Vec3 product;
  double s = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    gap[a] = (axes_[a] - c) * (axes_[a] + c);
    product[a] = axes_[a] * y[a];
    // g >= 0 where one of its terms alone is 1.
    s = std::max(s, product[a] - gap[a]);
  }
  const auto add_term = [&](std::size_t a, double at, double& g, double& slope) {
    if (product[a] > 0.0) {
      const double q = product[a] / (at + gap[a]);
      g += q * q;
      slope -= 2.0 * q * q / (at + gap[a]);
    }
  };
  constexpr int kMaxSteps = 100;
  for (int step = 0; step < kMaxSteps; ++step) {
    double g = -1.0;
    double slope = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      add_term(a, s, g, slope);
    }
    const double next = s - g / slope;
    if (!(g > 0.0) || !(next > s)) {
      break;
    }
    s = next;
  }
  Vec3 x{};
  double rest = 1.0;
  std::size_t shortest = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (product[a] > 0.0) {
      x[a] = axes_[a] * product[a] / (s + gap[a]);
    }
    rest -= weight_[a] * x[a] * x[a];
    shortest = axes_[a] < axes_[shortest] ? a : shortest;
  }
  if (y[shortest] == 0.0 && s == 0.0) {
    x[shortest] = c * std::sqrt(std::max(0.0, rest));
  }
  // Along the normal at x: a small error of x then does not matter even if u is next to the
  // surface.
  const Vec3 normal{weight_[0] * x[0], weight_[1] * x[1], weight_[2] * x[2]};
  const Vec3 offset = plus(y, -1.0, x);
  return dot(offset, normal) / length(normal);
}

}  // namespace difmesh::detail
