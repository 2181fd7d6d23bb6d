#pragma once
/// \file near_pure.hpp
/// Fields whose values lie on, and one rounding beside, the limits by which the library decides.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "support/fields.hpp"

namespace difmesh::test {

/// The value, or the next number below or above it, within [0,1].
inline double beside(double value, int ulps) {
  const double next = ulps == 0 ? value : std::nextafter(value, ulps < 0 ? -1.0 : 2.0);
  return std::clamp(next, 0.0, 1.0);
}

/// Independent values: nothing, next to nothing, halves and all, and the tolerance by which cells
/// count as pure; a third of them rounded up or down.
inline OwnedField near_pure_noise(const Index3& dims, double purity_tolerance, std::uint64_t seed) {
  const std::array<double, 10> values{
      0.0, 1e-7, 1e-6, 0.01, 0.5, 0.99, 1.0 - 1e-6, 1.0, purity_tolerance, 1.0 - purity_tolerance};
  OwnedField field(dims);
  std::mt19937_64 random(seed);
  for (double& value : field.values) {
    const int ulps = random() % 3 == 0 ? static_cast<int>(random() % 3) - 1 : 0;
    value = beside(values[random() % values.size()], ulps);
  }
  return field;
}

/// Independent values out of 1/2 and the numbers next to it, and nothing.
inline OwnedField near_half_noise(const Index3& dims, std::uint64_t seed) {
  OwnedField field(dims);
  std::mt19937_64 random(seed);
  for (double& value : field.values) {
    const auto choice = static_cast<int>(random() % 4);
    value = choice == 3 ? 0.0 : beside(0.5, choice - 1);
  }
  return field;
}

}  // namespace difmesh::test
