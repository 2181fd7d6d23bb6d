#pragma once
// Normals from 3x3x3 fractions, for one cell or eight (lanes.hpp). Normals are in the unit cell and
// scaled to |m|₁ = 1.

#include "lanes/lanes.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

// Below this, in fractions per cell, a gradient is rounding; above 1 - this, a share is a tie. Ties
// are settled by all that tie, so that no axis is preferred.
inline constexpr double kTie = 1e-12;

template <class R>
struct Triple {
  R v[3];
};

template <class R>
[[gnu::always_inline]] inline R norm1(const Triple<R>& m) {
  return magnitude(m.v[0]) + magnitude(m.v[1]) + magnitude(m.v[2]);
}

template <class R>
[[gnu::always_inline]] inline Triple<R> scaled(const Triple<R>& m, const R& factor) {
  return {{m.v[0] * factor, m.v[1] * factor, m.v[2] * factor}};
}

/// Minus the gradient of the fractions c[z][y][x], per cell: differences of layers weighted
/// (1,2,1)x(1,2,1)/16.
template <class R>
[[gnu::always_inline]] inline Triple<R> youngs(const R (&c)[27]) {
  const auto layers = [&](int step, int first, int second) __attribute__((always_inline)) {
    R sum = constant<R>(0.0);
    for (int v = 0; v < 3; ++v) {
      for (int u = 0; u < 3; ++u) {
        const double weight = (u == 1 ? 2.0 : 1.0) * (v == 1 ? 2.0 : 1.0);
        const R* foot = c + u * first + v * second;
        sum = sum + weight * (foot[0] - foot[2 * step]);
      }
    }
    return sum * (1.0 / 32.0);
  };
  return {{layers(1, 3, 9), layers(3, 1, 9), layers(9, 1, 3)}};
}

template <class R>
struct MixedNormal {
  Triple<R> m;
  Mask<R> is_youngs;
};

/// MYC of Aulisa et al. 2007. `gradient` is Youngs' normal; present[axis][0] and [2] are 0 for
/// layers that are missing, else 1.
template <class R>
[[gnu::always_inline]] inline MixedNormal<R> mixed_normal(const R (&c)[27],
                                                          const double (&present)[3][3],
                                                          const Triple<R>& gradient) {
  constexpr int kSteps[3] = {1, 3, 9};
  const R zero = constant<R>(0.0);
  const R one = constant<R>(1.0);
  const R tie = constant<R>(kTie);
  Triple<R> candidates[3];
  R own[3];
  for (int axis = 0; axis < 3; ++axis) {
    const int step = kSteps[axis];
    const double low = present[axis][0];
    const double high = present[axis][2];
    Triple<R>& m = candidates[axis];
    for (int t = 1; t < 3; ++t) {
      const int other = (axis + t) % 3;
      const int third = kSteps[(axis + 3 - t) % 3];
      const auto height = [&](int offset) __attribute__((always_inline)) {
        const R* foot = c + kSteps[other] * offset + third;
        return low * foot[0] + foot[step] + high * foot[2 * step];
      };
      m.v[other] = (height(0) - height(2)) * 0.5;
    }
    R lower_minus_upper = zero;
    for (int line = 0; line < 9; ++line) {
      const R* start =
          c + (line % 3) * kSteps[(axis + 1) % 3] + (line / 3) * kSteps[(axis + 2) % 3];
      lower_minus_upper = lower_minus_upper + (start[0] - start[2 * step]);
    }
    m.v[axis] = select(lower_minus_upper > tie, one, select(lower_minus_upper < -tie, -one, zero));
    const R size = norm1(m);
    m = scaled(m, select(size > tie, 1.0 / size, zero));
    own[axis] = magnitude(m.v[axis]);
  }
  const R best = larger(larger(own[0], own[1]), own[2]);
  const R largest =
      larger(larger(magnitude(gradient.v[0]), magnitude(gradient.v[1])), magnitude(gradient.v[2]));
  Triple<R> sum{{zero, zero, zero}};
  for (int axis = 0; axis < 3; ++axis) {
    const Mask<R> takes_part = own[axis] >= best - tie;
    for (int t = 0; t < 3; ++t) {
      sum.v[t] = sum.v[t] + select(takes_part, candidates[axis].v[t], zero);
    }
  }
  const R size = norm1(sum);
  const Mask<R> is_youngs = (best > largest) | (best == zero) | (size < tie);
  const Triple<R> mean = scaled(sum, 1.0 / size);
  MixedNormal<R> result;
  for (int t = 0; t < 3; ++t) {
    result.m.v[t] = select(is_youngs, gradient.v[t], mean.v[t]);
  }
  result.is_youngs = is_youngs;
  return result;
}

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
