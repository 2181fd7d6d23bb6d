#pragma once
/// \file interval.hpp
/// Interval arithmetic: bounds on polynomials over boxes. Ends are not rounded outwards; the users
/// only ask whether a surface is near, so a unit in the last place does not matter.

#include <algorithm>
#include <cmath>

namespace difmesh::test {

struct Interval {
  double low = 0.0;
  double high = 0.0;

  constexpr Interval() = default;
  constexpr Interval(double value) : low(value), high(value) {}  // numbers take part in formulas
  constexpr Interval(double a, double b) : low(a), high(b) {}

  [[nodiscard]] bool has_zero() const { return low <= 0.0 && high >= 0.0; }
  /// Smallest and largest absolute value.
  [[nodiscard]] double mignitude() const {
    return has_zero() ? 0.0 : std::min(std::abs(low), std::abs(high));
  }
  [[nodiscard]] double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
};

inline Interval operator+(const Interval& a, const Interval& b) {
  return {a.low + b.low, a.high + b.high};
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return {a.low - b.high, a.high - b.low};
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}

/// x², tighter than x x over an interval that holds 0.
inline Interval square(const Interval& x) {
  const double high = x.magnitude();
  const double low = x.mignitude();
  return {low * low, high * high};
}
inline double square(double x) {
  return x * x;
}

}  // namespace difmesh::test
