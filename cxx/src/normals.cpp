#include "difmesh/normals.hpp"

#include <algorithm>
#include <cmath>

#include "fitted_normals.hpp"
#include "normal_stencil.hpp"
#include "plane_fit.hpp"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace difmesh {
namespace detail {
namespace {

// Cells on each side of the centre in a column of heights.
constexpr int kReach = 4;
// Below this, in fractions per cell, a gradient is rounding; above 1 - this, a share is a tie. Ties
// are settled by all that tie, so that no axis is preferred.
constexpr double kTie = 1e-12;

double norm1(const Vec3& v) {
  return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}

void scale(Vec3& v, double factor) {
  for (double& component : v) {
    component *= factor;
  }
}

}  // namespace

template <class T>
NormalStencil<T>::NormalStencil(const BlockField& field, Normals normals)
    : field_(field),
      normals_(normals),
      data_(static_cast<const T*>(field.view.data)),
      empty_(field.purity_tolerance),
      full_(1.0 - field.purity_tolerance) {}

template <class T>
UnitNormal NormalStencil<T>::operator()(const Index3& cell) const {
  if (is_fitted(normals_)) {
    return fitted_normal(field_, normals_, cell, NormalStencil(field_, Normals::myc)(cell));
  }
  Neighbourhood hood;
  gather(cell, hood);
  Vec3 gradient = youngs(hood);
  const double size = norm1(gradient);
  if (size < kTie) {
    return {};
  }
  scale(gradient, 1.0 / size);
  UnitNormal normal{gradient, NormalSource::youngs};
  if (normals_ == Normals::youngs) {
    return normal;
  }
  normal = mixed(hood, gradient);
  if (normals_ == Normals::myc) {
    return normal;
  }
  if (hood.is_cut_short && hood.c[1][1][1] > 0.0 && hood.c[1][1][1] < 1.0) {
    normal = {fit(hood, normal.m), NormalSource::least_squares};
  }
  const Vec3 size_of{std::abs(normal.m[0]), std::abs(normal.m[1]), std::abs(normal.m[2])};
  const double largest = std::max({size_of[0], size_of[1], size_of[2]});
  Vec3 sum{0.0, 0.0, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size_of[axis] >= largest * (1.0 - kTie) &&
        add_heights(cell, axis, normal.m[axis] > 0.0 ? 1.0 : -1.0, sum)) {
      normal.source = NormalSource::height_function;
    }
  }
  if (normal.source == NormalSource::height_function) {
    scale(sum, 1.0 / norm1(sum));
    normal.m = sum;
  }
  return normal;
}

// True if all nine columns are in memory.
template <class T>
bool NormalStencil<T>::is_inside(const Index3& cell, std::size_t axis) const {
  for (std::size_t t = 0; t < 3; ++t) {
    const std::int64_t reach = t == axis ? kReach : 1;
    if (cell[t] - reach < field_.axes[t].low || cell[t] + reach >= field_.axes[t].high) {
      return false;
    }
  }
  return true;
}

template <class T>
void NormalStencil<T>::gather(const Index3& cell, Neighbourhood& hood) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell[axis] - 1 < field_.axes[axis].low || cell[axis] + 1 >= field_.axes[axis].high) {
      gather_at_side(cell, hood);
      return;
    }
  }
  const Index3& step = field_.view.strides;
  const T* centre = data_ + field_.element(cell);
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      const T* row = centre + (k - 1) * step[2] + (j - 1) * step[1];
      hood.c[k][j][0] = fraction_of(row[-step[0]]);
      hood.c[k][j][1] = fraction_of(row[0]);
      hood.c[k][j][2] = fraction_of(row[step[0]]);
    }
  }
  for (auto& axis : hood.present) {
    axis[0] = axis[1] = axis[2] = 1.0;
  }
  hood.is_cut_short = false;
}

template <class T>
void NormalStencil<T>::gather_at_side(const Index3& cell, Neighbourhood& hood) const {
  std::int64_t resolved[3][3];
  hood.is_cut_short = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::int64_t offset = 0; offset < 3; ++offset) {
      const std::int64_t index = field_.axes[axis].resolve(cell[axis] + offset - 1);
      // A missing layer is read as the centre first and continued below.
      resolved[axis][offset] = index == kMissing ? cell[axis] : index;
      hood.present[axis][offset] = index == kMissing ? 0.0 : 1.0;
      hood.is_cut_short = hood.is_cut_short || index == kMissing;
    }
  }
  double* c = &hood.c[0][0][0];
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        c[9 * k + 3 * j + i] = field_.fraction({resolved[0][i], resolved[1][j], resolved[2][k]});
      }
    }
  }
  const int steps[3] = {1, 3, 9};
  for (int axis = 0; axis < 3; ++axis) {
    const int step = steps[axis];
    const int other = steps[(axis + 1) % 3];
    const int third = steps[(axis + 2) % 3];
    for (int side = 0; side < 3; side += 2) {
      const int opposite = 2 - side;
      if (hood.present[axis][side] != 0.0 || hood.present[axis][opposite] == 0.0) {
        continue;  // there, or the whole axis is one layer: the copy of the centre is the
                   // continuation
      }
      for (int line = 0; line < 9; ++line) {
        double* start = c + (line % 3) * other + (line / 3) * third;
        start[side * step] = 2.0 * start[step] - start[opposite * step];
      }
    }
  }
}

// One-sided differences tell too little of a surface that leaves the domain; all that the neighbours hold
// tells enough.
template <class T>
Vec3 NormalStencil<T>::fit(const Neighbourhood& hood, const Vec3& m) {
  NeighbourFractions neighbours;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        neighbours.fraction[k][j][i] = hood.c[k][j][i];
        neighbours.is_there[k][j][i] =
            hood.present[0][i] != 0.0 && hood.present[1][j] != 0.0 && hood.present[2][k] != 0.0;
      }
    }
  }
  return fit_to_neighbours(neighbours, m);
}

// Minus the gradient of the fractions, per cell: differences of layers weighted (1,2,1)x(1,2,1)/16.
template <class T>
Vec3 NormalStencil<T>::youngs(const Neighbourhood& hood) {
  constexpr double weight[3] = {1.0, 2.0, 1.0};
  Vec3 sum{0.0, 0.0, 0.0};
  double along_x[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      const double* row = hood.c[k][j];
      sum[0] += weight[j] * weight[k] * (row[0] - row[2]);
      along_x[k][j] = row[0] + 2.0 * row[1] + row[2];
    }
  }
  for (int t = 0; t < 3; ++t) {
    sum[1] += weight[t] * (along_x[t][0] - along_x[t][2]);
    sum[2] += weight[t] * (along_x[0][t] - along_x[2][t]);
  }
  scale(sum, 1.0 / 32.0);
  return sum;
}

// MYC of Aulisa et al. 2007. `gradient` is Youngs' normal, scaled to |.|₁ = 1.
template <class T>
UnitNormal NormalStencil<T>::mixed(const Neighbourhood& hood, const Vec3& gradient) {
  const double* c = &hood.c[0][0][0];
  constexpr int kSteps[3] = {1, 3, 9};
  Vec3 candidates[3];
  double own[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int step = kSteps[axis];
    const double low = hood.present[axis][0];
    const double high = hood.present[axis][2];
    Vec3& m = candidates[axis];
    for (std::size_t t = 1; t < 3; ++t) {
      const std::size_t other = (axis + t) % 3;
      const int third = kSteps[(axis + 3 - t) % 3];
      const auto height = [&](int offset) {
        const double* foot = c + kSteps[other] * offset + third;
        return low * foot[0] + foot[step] + high * foot[2 * step];
      };
      m[other] = (height(0) - height(2)) / 2.0;
    }
    double lower_minus_upper = 0.0;
    for (int line = 0; line < 9; ++line) {
      const double* start =
          c + (line % 3) * kSteps[(axis + 1) % 3] + (line / 3) * kSteps[(axis + 2) % 3];
      lower_minus_upper += start[0] - start[2 * step];
    }
    m[axis] = lower_minus_upper > kTie ? 1.0 : (lower_minus_upper < -kTie ? -1.0 : 0.0);
    const double size = norm1(m);
    scale(m, size > kTie ? 1.0 / size : 0.0);
    own[axis] = std::abs(m[axis]);
  }
  const double best = std::max({own[0], own[1], own[2]});
  const double largest =
      std::max({std::abs(gradient[0]), std::abs(gradient[1]), std::abs(gradient[2])});
  if (best > largest || best == 0.0) {
    return {gradient, NormalSource::youngs};
  }
  Vec3 sum{0.0, 0.0, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t t = 0; own[axis] >= best - kTie && t < 3; ++t) {
      sum[t] += candidates[axis][t];
    }
  }
  const double size = norm1(sum);
  if (size < kTie) {
    return {gradient, NormalSource::youngs};
  }
  scale(sum, 1.0 / size);
  return {sum, NormalSource::centred_columns};
}

// Adds the normal from the heights along one axis, scaled to |.|₁ = 1, if all nine columns agree.
// `sense` is +1 where the material is at the low end of the columns.
template <class T>
bool NormalStencil<T>::add_heights(const Index3& cell, std::size_t axis, double sense,
                                   Vec3& sum) const {
  const std::size_t other = (axis + 1) % 3;
  const std::size_t third = (axis + 2) % 3;
  double height[3][3];
  bool there[2][3] = {{true, true, true}, {true, true, true}};
  if (is_inside(cell, axis)) {
    const Index3& step = field_.view.strides;
    const std::int64_t along = sense > 0.0 ? step[axis] : -step[axis];
    const T* centre = data_ + field_.element(cell) - kReach * along;
    for (const int u : {1, 0, 2}) {
      for (const int v : {1, 0, 2}) {
        const T* end = centre + (u - 1) * step[other] + (v - 1) * step[third];
        Column column{};
        for (int n = 0; n <= 2 * kReach; ++n) {
          column[static_cast<std::size_t>(n)] = fraction_of(end[n * along]);
        }
        if (!is_column(column, 2 * kReach + 1, height[u][v])) {
          return false;
        }
      }
    }
  } else {
    for (int t = 0; t < 3; ++t) {
      there[0][t] = field_.axes[other].resolve(cell[other] + t - 1) != kMissing;
      there[1][t] = field_.axes[third].resolve(cell[third] + t - 1) != kMissing;
    }
    for (const int u : {1, 0, 2}) {
      for (const int v : {1, 0, 2}) {
        Index3 foot = cell;
        foot[other] += u - 1;
        foot[third] += v - 1;
        if (there[0][u] && there[1][v] && !column_at_side(foot, axis, sense, height[u][v])) {
          return false;
        }
      }
    }
  }
  const auto slope = [](double low, double middle, double high, const bool* is_there) {
    if (is_there[0] && is_there[2]) {
      return (high - low) / 2.0;
    }
    return is_there[2] ? high - middle : (is_there[0] ? middle - low : 0.0);
  };
  Vec3 m;
  m[axis] = sense;
  m[other] = -slope(height[0][1], height[1][1], height[2][1], there[0]);
  m[third] = -slope(height[1][0], height[1][1], height[1][2], there[1]);
  const double size = norm1(m);
  for (std::size_t t = 0; t < 3; ++t) {
    sum[t] += m[t] / size;
  }
  return true;
}

// Sums nine cells, or what the domain has of them, from the material's end. Consistent: full cells, then
// interfacial ones, then empty ones, at least one full and one empty.
template <class T>
bool NormalStencil<T>::is_column(const Column& column, int count, double& height) const {
  unsigned full = 0;
  unsigned not_empty = 0;
  double even = 0.0;
  double odd = 0.0;
#ifdef __SSE2__
  __m128d sums = _mm_setzero_pd();
  for (int n = 0; n < kColumn; n += 2) {
    const __m128d pair = _mm_loadu_pd(column.data() + n);
    full |= static_cast<unsigned>(_mm_movemask_pd(_mm_cmpge_pd(pair, _mm_set1_pd(full_)))) << n;
    not_empty |= static_cast<unsigned>(_mm_movemask_pd(_mm_cmpgt_pd(pair, _mm_set1_pd(empty_))))
                 << n;
    sums = _mm_add_pd(sums, pair);
  }
  even = _mm_cvtsd_f64(sums);
  odd = _mm_cvtsd_f64(_mm_unpackhi_pd(sums, sums));
#else
  for (int n = 0; n < kColumn; n += 2) {
    for (int m = n; m < n + 2; ++m) {
      const double fraction = column[static_cast<std::size_t>(m)];
      full |= static_cast<unsigned>(fraction >= full_) << m;
      not_empty |= static_cast<unsigned>(fraction > empty_) << m;
      (m == n ? even : odd) += fraction;
    }
  }
#endif
  height = even + odd;
  // Both must run from the first cell on without a gap, and end before the last.
  return (full & 1U) != 0 && (full & (full + 1U)) == 0 && (not_empty & (not_empty + 1U)) == 0 &&
         not_empty >> (count - 1) == 0;
}

template <class T>
bool NormalStencil<T>::column_at_side(const Index3& foot, std::size_t axis, double sense,
                                      double& height) const {
  Index3 resolved;
  for (std::size_t t = 0; t < 3; ++t) {
    resolved[t] = field_.axes[t].resolve(foot[t]);
  }
  Column column{};
  int count = 0;
  for (std::int64_t offset = -kReach; offset <= kReach; ++offset) {
    resolved[axis] = field_.axes[axis].resolve(foot[axis] + offset);
    if (resolved[axis] != kMissing) {
      column[static_cast<std::size_t>(count++)] = field_.fraction(resolved);
    }
  }
  if (sense < 0.0) {
    std::reverse(column.begin(), column.begin() + count);
  }
  return is_column(column, count, height);
}

template class NormalStencil<float>;
template class NormalStencil<double>;
template class NormalStencil<std::uint8_t>;
template class NormalStencil<std::uint16_t>;

}  // namespace detail

}  // namespace difmesh
