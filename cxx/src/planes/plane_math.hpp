#pragma once
// Planes in the unit cell, for one double or eight (lanes.hpp).
//
// A cuboid cell is mapped to the unit cube about its centre, u in [-1/2, 1/2]^3; the plane becomes
// m·u = a with m_i = n_i c_i. Formulas are homogeneous in (m, a), so no scaling is needed for them.
// By symmetry only |m_i| and alpha = (sum - 2|a|) / 2, the plane's distance from the nearest
// corner, enter. The pieces of the ordered form (Scardovelli & Zaleski 2000) are arranged so that
// nothing is multiplied by the inverse of the smallest |m| but what makes a ratio in [0,1]: no
// cancellation, whatever the direction.

#include "lanes/lanes.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

/// 1 / |value|, but no more than 1e300, so that 0 times it is 0.
template <class R>
[[gnu::always_inline]] inline R tame_inverse(const R& size) {
  return 1.0 / larger(size, constant<R>(1e-300));
}

/// |m| sorted, small <= middle <= large, and the inverses.
template <class R>
struct Sorted {
  R small, middle, large;
  R inverse_small, inverse_middle, inverse_large;

  [[nodiscard]] R sum() const { return small + middle + large; }
};

template <class R>
[[gnu::always_inline]] inline Sorted<R> sorted(const R& m0, const R& m1, const R& m2) {
  const R size0 = magnitude(m0);
  const R size1 = magnitude(m1);
  const R size2 = magnitude(m2);
  const R low = smaller(size0, size1);
  const R high = larger(size0, size1);
  const R small = smaller(low, size2);
  const R large = larger(high, size2);
  const R middle = larger(low, smaller(high, size2));
  return {small, middle, large, tame_inverse(small), tame_inverse(middle), tame_inverse(large)};
}

/// What alpha past the middle and the large component takes off, times 6 m.small.
template <class R>
struct Excess {
  R middle;
  R large;
};

template <class R>
[[gnu::always_inline]] inline Excess<R> excess_past(const Sorted<R>& m, const R& alpha) {
  const R zero = constant<R>(0.0);
  return {larger(alpha - m.middle, zero), larger(alpha - m.large, zero)};
}

/// True where the plane cuts all four edges of the cube along the largest component.
template <class R>
[[gnu::always_inline]] inline Mask<R> is_column_cut(const Sorted<R>& m, const R& alpha) {
  const R two = m.small + m.middle;
  return (alpha >= two) & (two <= m.large);
}

/// Share of the unit cube cut off at a distance alpha, middle <= alpha <= sum/2, from its corner.
template <class R>
[[gnu::always_inline]] inline R upper_corner_fraction(const Sorted<R>& m, const R& alpha) {
  const R quadratic = alpha * (alpha - m.small) * 0.5 + m.small * m.small * (1.0 / 6.0);
  const Excess<R> past = excess_past(m, alpha);
  const R cut = past.middle * m.inverse_small * past.middle * past.middle +
                past.large * m.inverse_small * past.large * past.large;
  const R general = (quadratic - cut * (1.0 / 6.0)) * m.inverse_middle * m.inverse_large;
  const R column = (alpha - (m.small + m.middle) * 0.5) * m.inverse_large;
  return select(is_column_cut(m, alpha), column, general);
}

/// The same for any alpha, 0 < alpha <= sum/2.
template <class R>
[[gnu::always_inline]] inline R corner_fraction(const Sorted<R>& m, const R& alpha) {
  const R corner = (alpha * m.inverse_small) * (alpha * m.inverse_middle) *
                   (alpha * m.inverse_large) * (1.0 / 6.0);
  const R quadratic = alpha * (alpha - m.small) * 0.5 + m.small * m.small * (1.0 / 6.0);
  const R wedge = quadratic * m.inverse_middle * m.inverse_large;
  return select(alpha < m.small, corner,
                select(alpha < m.middle, wedge, upper_corner_fraction(m, alpha)));
}

/// Derivatives of upper_corner_fraction by alpha, where no column is cut.
template <class R>
struct CornerSlopes {
  R first;
  R second;
};

template <class R>
[[gnu::always_inline]] inline CornerSlopes<R> corner_slopes(const Sorted<R>& m, const R& alpha) {
  const Excess<R> past = excess_past(m, alpha);
  const R middle = past.middle * m.inverse_small;
  const R large = past.large * m.inverse_small;
  const R cut = middle * past.middle + large * past.large;
  const R scale = m.inverse_middle * m.inverse_large;
  return {(alpha - m.small * 0.5 - cut * 0.5) * scale, (1.0 - middle - large) * scale};
}

/// Share of the unit cube where m·u <= a. m = 0: all or nothing, by the sign of a.
template <class R>
[[gnu::always_inline]] inline R cube_share(const Sorted<R>& m, const R& a) {
  const R zero = constant<R>(0.0);
  const R one = constant<R>(1.0);
  const R alpha = m.sum() * 0.5 - magnitude(a);
  const R share = corner_fraction(m, alpha);
  return select(alpha <= zero, select(a >= zero, one, zero), select(a > zero, 1.0 - share, share));
}

// The range where the cut is a polygon of four to six corners has no inverse free of cancellation.
// upper_corner_fraction is smooth and increasing there: two of Halley's steps do, from the cubic
// that has its values and slopes at both ends, within a bracket that closes where rounding would
// throw them about.
template <class R>
[[gnu::always_inline]] inline R solve_corner_distance(const Sorted<R>& m, const R& share,
                                                      const R& share_at_middle,
                                                      const Mask<R>& wanted) {
  const R zero = constant<R>(0.0);
  const R two = m.small + m.middle;
  const R half = m.sum() * 0.5;
  R low = m.middle;
  R high = smaller(two, half);
  const R width = high - low;
  const R rise =
      select(two <= m.large, two * m.inverse_large * 0.5, constant<R>(0.5)) - share_at_middle;
  const R above_low = larger(share - share_at_middle, zero);
  // The cubic, alpha as a function of the share, with a single division. Where the range is so
  // narrow that this underflows, or empty by rounding, its end will do.
  const R slope_low = (m.middle - m.small * 0.5) * m.inverse_middle * m.inverse_large * width;
  const R slope_high = corner_slopes(m, high).first * width;
  const R product = rise * slope_low * slope_high;
  Mask<R> done = opposite(wanted) | (above_low >= rise) | opposite(product > constant<R>(1e-290));
  R result = high;
  const R inverse = 1.0 / product;
  const R t = above_low * slope_low * slope_high * inverse;
  const R start = rise * rise * slope_high * inverse;
  const R end = rise * rise * slope_low * inverse;
  R alpha = low + width * (t * (start + t * (3.0 - 2.0 * start - end + t * (start + end - 2.0))));
  alpha = clamped(alpha, low, high);
  const R settled = width * 1e-5;
  for (int step = 0; step < 32 && any(opposite(done)); ++step) {
    const R excess = upper_corner_fraction(m, alpha) - share;
    const CornerSlopes<R> slopes = corner_slopes(m, alpha);
    const R next = clamped(alpha - (2.0 * excess * slopes.first) /
                                       (2.0 * slopes.first * slopes.first - excess * slopes.second),
                           low, high);
    result = select(done, result, next);
    // Steps shrink to the third power: after one this small the next would be lost in rounding.
    done = done | (magnitude(next - alpha) <= settled);
    const Mask<R> above = excess > zero;
    high = select(above, alpha, high);
    low = select(above, low, alpha);
    alpha = next;
  }
  return result;
}

/// alpha at which corner_fraction is share, in (0, 1/2].
template <class R>
[[gnu::always_inline]] inline R corner_distance(const Sorted<R>& m, const R& share) {
  // Shares at which the plane passes the next corner of the cube.
  const R at_small = m.small * m.inverse_middle * (m.small * m.inverse_large) * (1.0 / 6.0);
  const R at_middle = at_small + (m.middle - m.small) * m.inverse_large * 0.5;
  const R two = m.small + m.middle;
  const Mask<R> in_corner = share < at_small;
  const Mask<R> in_wedge = share < at_middle;
  const Mask<R> in_column = (two <= m.large) & (share >= two * m.inverse_large * 0.5);
  R result = share * m.large + two * 0.5;
  const Mask<R> elsewhere = opposite(in_corner | in_wedge | in_column);
  if (any(elsewhere)) {
    result = select(elsewhere, solve_corner_distance(m, share, at_middle, elsewhere), result);
  }
  if (any(in_wedge)) {
    const R product = 2.0 * m.middle * m.large * (share - at_small);
    const R root = square_root(m.small * m.small * 0.25 + product);
    result = select(in_wedge, m.small * 0.5 + root, result);
  }
  if (any(in_corner)) {
    result = select(in_corner, cube_root(6.0 * share * m.small * m.middle * m.large), result);
  }
  return result;
}

/// A plane that misses the centre of its cell misses it by more, if only by so little.
inline constexpr double kBesideCentre = 1e-300;

/// a at which cube_share(m, a) is the fraction, clamped to [0,1]. Whatever rounding does, a has the
/// sign of the fraction less 1/2: a plane and the fraction that it was made of agree on which side
/// the cell's centre is.
template <class R>
[[gnu::always_inline]] inline R offset_of_share(const Sorted<R>& m, const R& fraction) {
  const R half = m.sum() * 0.5;
  const R zero = constant<R>(0.0);
  const R one_half = constant<R>(0.5);
  const Mask<R> mostly_full = fraction > one_half;
  const R distance = corner_distance(m, select(mostly_full, 1.0 - fraction, fraction));
  const R size = larger(half - distance, constant<R>(kBesideCentre));
  const R inner = select(fraction == one_half, zero, select(mostly_full, size, -size));
  return select(fraction <= zero, -half, select(fraction >= constant<R>(1.0), half, inner));
}

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
