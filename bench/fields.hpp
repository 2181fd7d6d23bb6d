#pragma once
// Fields to measure on: a sphere of radius 0.35 N, off the grid's centre, and eight periods of a
// gyroid.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "difmesh/plane.hpp"

namespace difmesh::bench {

// Fractions from the plane tangent at the closest point: near enough to time on.
template <class T>
std::vector<T> sphere(std::int64_t n) {
  const auto size = static_cast<double>(n);
  const double radius = 0.35 * size;
  const Vec3 centre{0.5 * size + 0.137, 0.5 * size - 0.21, 0.5 * size + 0.33};
  std::vector<T> field(static_cast<std::size_t>(n * n * n));
  auto next = field.begin();
  for (std::int64_t k = 0; k < n; ++k) {
    for (std::int64_t j = 0; j < n; ++j) {
      for (std::int64_t i = 0; i < n; ++i) {
        const double x = static_cast<double>(i) + 0.5 - centre[0];
        const double y = static_cast<double>(j) + 0.5 - centre[1];
        const double z = static_cast<double>(k) + 0.5 - centre[2];
        const double r = std::sqrt(x * x + y * y + z * z);
        double fraction = r < radius ? 1.0 : 0.0;
        if (std::abs(r - radius) < 1.0) {
          fraction = plane_fraction({x / r, y / r, z / r}, {1.0, 1.0, 1.0}, radius - r);
        }
        *next++ = static_cast<T>(fraction);
      }
    }
  }
  return field;
}

template <class T>
std::vector<T> gyroid(std::int64_t n) {
  const double w = 2.0 * std::numbers::pi * 8.0 / static_cast<double>(n);
  std::vector<T> field(static_cast<std::size_t>(n * n * n));
  auto next = field.begin();
  for (std::int64_t k = 0; k < n; ++k) {
    for (std::int64_t j = 0; j < n; ++j) {
      for (std::int64_t i = 0; i < n; ++i) {
        const double x = w * (static_cast<double>(i) + 0.5);
        const double y = w * (static_cast<double>(j) + 0.5);
        const double z = w * (static_cast<double>(k) + 0.5);
        const double g =
            std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
        const Vec3 gradient{w * (std::cos(x) * std::cos(y) - std::sin(z) * std::sin(x)),
                            w * (std::cos(y) * std::cos(z) - std::sin(x) * std::sin(y)),
                            w * (std::cos(z) * std::cos(x) - std::sin(y) * std::sin(z))};
        const double steepness = std::hypot(gradient[0], gradient[1], gradient[2]);
        double fraction = g < 0.0 ? 1.0 : 0.0;
        if (std::abs(g) < steepness && steepness > 0.0) {
          fraction = plane_fraction(gradient, {1.0, 1.0, 1.0}, -g);
        }
        *next++ = static_cast<T>(fraction);
      }
    }
  }
  return field;
}

}  // namespace difmesh::bench
