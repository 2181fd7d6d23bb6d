#pragma once
// Planes in the unit cell, in the form that all of the core computes with.
//
// A cuboid cell is mapped to the unit cube about its centre, u in [-1/2, 1/2]^3; the plane becomes
// m·u = a with m_i = n_i c_i. Formulas are homogeneous in (m, a), so no scaling is needed for them.
// By symmetry only |m_i| and alpha = (sum - 2|a|) / 2, the plane's distance from the nearest
// corner, enter. The pieces of the ordered form (Scardovelli & Zaleski 2000) are arranged so that
// nothing is divided by the smallest |m| but ratios in [0,1]: no cancellation, whatever the
// direction.

#include <algorithm>
#include <cmath>

namespace difmesh::detail {

/// |m| sorted: small <= middle <= large.
struct SortedNormal {
  double small, middle, large;

  SortedNormal(double m0, double m1, double m2) {
    const double low = std::min(m0, m1);
    const double high = std::max(m0, m1);
    small = std::min(low, m2);
    large = std::max(high, m2);
    middle = std::max(low, std::min(high, m2));
  }
  [[nodiscard]] double sum() const { return small + middle + large; }
};

/// Share of the unit cube cut off at a distance alpha <= sum/2 from its corner.
inline double corner_fraction(const SortedNormal& m, double alpha) {
  if (alpha <= 0.0) {
    return 0.0;
  }
  if (alpha < m.small) {
    return (alpha / m.small) * (alpha / m.middle) * (alpha / m.large) / 6.0;
  }
  const double quadratic = alpha * (alpha - m.small) / 2.0 + m.small * m.small / 6.0;
  if (alpha < m.middle) {
    return quadratic / m.middle / m.large;
  }
  const double two = m.small + m.middle;
  if (alpha >= two && two <= m.large) {
    return (alpha - two / 2.0) / m.large;
  }
  const double past_middle = alpha - m.middle;
  double cut = past_middle / m.small * past_middle * past_middle;
  if (alpha > m.large) {
    const double past_large = alpha - m.large;
    cut += past_large / m.small * past_large * past_large;
  }
  return (quadratic - cut / 6.0) / m.middle / m.large;
}

/// Derivative of corner_fraction by alpha, in the range where all three components matter.
inline double corner_area(const SortedNormal& m, double alpha) {
  const double past_middle = std::max(alpha - m.middle, 0.0);
  const double past_large = std::max(alpha - m.large, 0.0);
  const double cut = past_middle / m.small * past_middle + past_large / m.small * past_large;
  return (alpha - m.small / 2.0 - cut / 2.0) / m.middle / m.large;
}

/// Share of the unit cube where m·u <= a. m = 0: all or nothing, by the sign of a.
inline double cube_fraction(double m0, double m1, double m2, double a) {
  const SortedNormal m(std::abs(m0), std::abs(m1), std::abs(m2));
  const double alpha = m.sum() / 2.0 - std::abs(a);
  if (alpha <= 0.0) {
    return a >= 0.0 ? 1.0 : 0.0;
  }
  const double share = corner_fraction(m, alpha);
  return a > 0.0 ? 1.0 - share : share;
}

/// Share of the unit square where m·u <= a.
inline double square_fraction(double m0, double m1, double a) {
  const double small = std::min(std::abs(m0), std::abs(m1));
  const double large = std::max(std::abs(m0), std::abs(m1));
  const double alpha = (small + large) / 2.0 - std::abs(a);
  if (alpha <= 0.0) {
    return a >= 0.0 ? 1.0 : 0.0;
  }
  const double share =
      alpha < small ? alpha / small * (alpha / large) / 2.0 : (alpha - small / 2.0) / large;
  return a > 0.0 ? 1.0 - share : share;
}

/// alpha at which corner_fraction is share, in (0, 1/2].
double corner_distance(const SortedNormal& m, double share);

/// a at which cube_fraction(m, a) is the fraction, clamped to [0,1].
inline double cube_offset(double m0, double m1, double m2, double fraction) {
  const SortedNormal m(std::abs(m0), std::abs(m1), std::abs(m2));
  const double half = m.sum() / 2.0;
  if (fraction <= 0.0) {
    return -half;
  }
  if (fraction >= 1.0) {
    return half;
  }
  return fraction > 0.5 ? half - corner_distance(m, 1.0 - fraction)
                        : corner_distance(m, fraction) - half;
}

}  // namespace difmesh::detail
