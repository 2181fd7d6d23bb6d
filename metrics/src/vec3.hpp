#pragma once
// The few vector operations that distances need.

#include <cmath>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

[[nodiscard]] inline Vec3 plus(const Vec3& a, const Vec3& b) noexcept {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
[[nodiscard]] inline Vec3 minus(const Vec3& a, const Vec3& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline Vec3 times(double factor, const Vec3& a) noexcept {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
[[nodiscard]] inline double dot(const Vec3& a, const Vec3& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline double squared_length(const Vec3& a) noexcept {
  return dot(a, a);
}
[[nodiscard]] inline double length(const Vec3& a) noexcept {
  return std::sqrt(dot(a, a));
}

}  // namespace difmesh::detail
