#pragma once
// Vector operations.

#include <cmath>

#include "difmesh/vec3.hpp"

namespace difmesh::detail {

[[nodiscard]] inline Vec3 plus(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
[[nodiscard]] inline Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline Vec3 scaled(const Vec3& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}
[[nodiscard]] inline double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Sum of the components' sizes.
[[nodiscard]] inline double norm1(const Vec3& a) {
  return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
}
[[nodiscard]] inline double squared_length(const Vec3& a) {
  return dot(a, a);
}
[[nodiscard]] inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}
/// \pre the squares neither overflow nor underflow
[[nodiscard]] inline Vec3 unit(const Vec3& a) {
  return scaled(a, 1.0 / length(a));
}

}  // namespace difmesh::detail
