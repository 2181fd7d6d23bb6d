#pragma once
/// \file vec3.hpp
/// The few vector operations that the oracles need, on difmesh::Vec3.

#include <cmath>
#include <cstdint>
#include <random>

#include "difmesh/grid.hpp"

namespace difmesh::test {

inline Vec3 add(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 subtract(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 scaled(const Vec3& a, double factor) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}
inline Vec3 unit(const Vec3& a) {
  return scaled(a, 1.0 / length(a));
}

/// Random numbers that are the same everywhere: the conversion from random bits is spelt out, as
/// the distributions of <random> differ between standard libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// Uniform in [low, high).
  double uniform(double low = 0.0, double high = 1.0) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// A unit vector, uniform over the sphere.
  Vec3 direction() {
    for (;;) {
      const Vec3 v{uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
      const double size = length(v);
      if (size > 0.01 && size < 1.0) {
        return unit(v);
      }
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace difmesh::test
