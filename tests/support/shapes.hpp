#pragma once
/// \file shapes.hpp
/// Test shapes as polynomials f, inside where f < 0. A shape is a struct with
///   T value(const std::array<T,3>&) and std::array<T,3> gradient(const std::array<T,3>&),
/// both for T = double and T = Interval, so that bounds over boxes come from the same formula.

#include <array>
#include <cmath>

#include "support/interval.hpp"
#include "support/vec3.hpp"

namespace difmesh::test {

template <class T>
using Triple = std::array<T, 3>;

struct Sphere {
  Vec3 centre{0.0, 0.0, 0.0};
  double radius = 1.0;

  template <class T>
  [[nodiscard]] T value(const Triple<T>& p) const {
    return square(p[0] - centre[0]) + square(p[1] - centre[1]) + square(p[2] - centre[2]) -
           radius * radius;
  }
  template <class T>
  [[nodiscard]] Triple<T> gradient(const Triple<T>& p) const {
    return {2.0 * (p[0] - centre[0]), 2.0 * (p[1] - centre[1]), 2.0 * (p[2] - centre[2])};
  }
};

/// Half-axes along the coordinate axes.
struct Ellipsoid {
  Vec3 centre{0.0, 0.0, 0.0};
  Vec3 half_axes{1.0, 1.0, 1.0};

  template <class T>
  [[nodiscard]] T value(const Triple<T>& p) const {
    T sum = -1.0;
    for (std::size_t a = 0; a < 3; ++a) {
      sum = sum + square((1.0 / half_axes[a]) * (p[a] - centre[a]));
    }
    return sum;
  }
  template <class T>
  [[nodiscard]] Triple<T> gradient(const Triple<T>& p) const {
    Triple<T> g;
    for (std::size_t a = 0; a < 3; ++a) {
      g[a] = (2.0 / (half_axes[a] * half_axes[a])) * (p[a] - centre[a]);
    }
    return g;
  }
};

/// The body of E19 with three holes, F = 2y(y²-3x²)(1-z²) + (x²+y²)² - (9z²-1)(1-z²). It lies in
/// |x|, |y| < 1.84 and |z| <= 1 times the scale; further out F has other pieces.
struct Genus {
  Vec3 centre{0.0, 0.0, 0.0};
  double scale = 1.0;

  template <class T>
  [[nodiscard]] T value(const Triple<T>& p) const {
    const auto [x, y, z] = local(p);
    const T w = 1.0 - square(z);
    return 2.0 * y * (square(y) - 3.0 * square(x)) * w + square(square(x) + square(y)) -
           (9.0 * square(z) - 1.0) * w;
  }
  template <class T>
  [[nodiscard]] Triple<T> gradient(const Triple<T>& p) const {
    const auto [x, y, z] = local(p);
    const T w = 1.0 - square(z);
    const T radial = 4.0 * (square(x) + square(y));
    const T per_scale = 1.0 / scale;
    return {per_scale * x * (radial - 12.0 * y * w),
            per_scale * (6.0 * w * (square(y) - square(x)) + y * radial),
            per_scale * z * (-4.0 * y * (square(y) - 3.0 * square(x)) + 36.0 * square(z) - 20.0)};
  }

 private:
  template <class T>
  [[nodiscard]] Triple<T> local(const Triple<T>& p) const {
    return {(1.0 / scale) * (p[0] - centre[0]), (1.0 / scale) * (p[1] - centre[1]),
            (1.0 / scale) * (p[2] - centre[2])};
  }
};

/// Half-space normal·x < level.
struct HalfSpace {
  Vec3 normal{0.0, 0.0, 1.0};
  double level = 0.0;

  template <class T>
  [[nodiscard]] T value(const Triple<T>& p) const {
    return normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - level;
  }
  template <class T>
  [[nodiscard]] Triple<T> gradient(const Triple<T>&) const {
    return {normal[0], normal[1], normal[2]};
  }
};

/// The point of the surface closest to p, for p much closer to the surface than its radii of
/// curvature: each round takes a Newton step onto the surface and the tangential way back towards
/// p.
template <class Shape>
[[nodiscard]] Vec3 closest_point(const Shape& shape, const Vec3& p) {
  Vec3 q = p;
  for (int round = 0; round < 60; ++round) {
    const Vec3 g = shape.gradient(q);
    const double g2 = dot(g, g);
    const Vec3 way_back = subtract(p, q);
    const double along = (dot(way_back, g) + shape.value(q)) / g2;
    const Vec3 step = subtract(way_back, scaled(g, along));
    q = add(q, step);
    if (dot(step, step) <= 1e-30 * (1.0 + dot(p, p))) {
      break;
    }
  }
  return q;
}

/// Unsigned distance of a point near the surface.
template <class Shape>
[[nodiscard]] double distance(const Shape& shape, const Vec3& p) {
  return length(subtract(p, closest_point(shape, p)));
}
[[nodiscard]] inline double distance(const Sphere& sphere, const Vec3& p) {
  return std::abs(length(subtract(p, sphere.centre)) - sphere.radius);
}
[[nodiscard]] inline double distance(const HalfSpace& half_space, const Vec3& p) {
  return std::abs(half_space.value(p)) / length(half_space.normal);
}

}  // namespace difmesh::test
