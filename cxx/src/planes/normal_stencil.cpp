#include "planes/normal_stencil.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/vector3.hpp"
#include "planes/column_rule.hpp"
#include "planes/fitted_normals.hpp"
#include "planes/normal_math.hpp"
#include "planes/plane_fit.hpp"
#include "planes/stretched_normal.hpp"

namespace difmesh {
namespace detail {
namespace {

using baseline::kTie;

Vec3 to_vec3(const baseline::Triple<double>& triple) {
  return {triple.v[0], triple.v[1], triple.v[2]};
}

void scale(Vec3& v, double factor) {
  for (double& component : v) {
    component *= factor;
  }
}

}  // namespace

bool is_consistent(const FractionColumn& column, int count, double least_full, double most_empty) {
  const auto place = [](double fraction) { return std::bit_cast<std::int64_t>(fraction); };
  baseline::ColumnCheck<std::int64_t> check;
  for (int n = 0; n < count; ++n) {
    check.add(n, baseline::filled(place(column[n]), place(least_full), place(most_empty)));
    if (check.wrong < 0) {
      return false;
    }
  }
  check.end();
  return check.wrong >= 0;
}

template <class T>
NormalStencil<T>::NormalStencil(const BlockField& field, Normals normals)
    : field_(field),
      normals_(normals),
      data_(static_cast<const T*>(field.view.data)),
      empty_(field.purity_tolerance),
      full_(1.0 - field.purity_tolerance) {}

template <class T>
UnitNormal NormalStencil<T>::operator()(const Index3& cell) const {
  if (field_.is_stretched) {
    return stretched_normal(field_, normals_, cell);
  }
  if (is_fitted(normals_)) {
    return fitted_normal(field_, normals_, cell, NormalStencil(field_, Normals::myc)(cell));
  }
  Neighbourhood hood;
  gather(cell, hood);
  baseline::Triple<double> gradient = baseline::youngs(hood.c);
  const double size = norm1(gradient);
  if (size < kTie) {
    return {};
  }
  gradient = baseline::scaled(gradient, 1.0 / size);
  if (normals_ == Normals::youngs) {
    return {to_vec3(gradient), NormalSource::youngs};
  }
  const auto mixed = baseline::mixed_normal(hood.c, hood.present, gradient);
  UnitNormal normal{to_vec3(mixed.m),
                    mixed.is_youngs ? NormalSource::youngs : NormalSource::centred_columns};
  if (normals_ == Normals::myc) {
    return normal;
  }
  if (hood.is_cut_short && hood.c[13] > 0.0 && hood.c[13] < 1.0) {
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

// As BlockField::fraction().
template <class T>
double NormalStencil<T>::fraction(const Index3& resolved) const {
  if (is_cell(resolved[0]) && is_cell(resolved[1]) && is_cell(resolved[2])) {
    return fraction_of(data_[field_.element(resolved)]);
  }
  return field_.fraction(resolved);
}

// True if all nine columns are in memory.
template <class T>
bool NormalStencil<T>::is_inside(const Index3& cell, std::size_t axis) const {
  for (std::size_t t = 0; t < 3; ++t) {
    const std::int64_t reach = t == axis ? kColumnReach : 1;
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
      double* c = hood.c + 9 * k + 3 * j;
      c[0] = fraction_of(row[-step[0]]);
      c[1] = fraction_of(row[0]);
      c[2] = fraction_of(row[step[0]]);
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
  double* c = hood.c;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        c[9 * k + 3 * j + i] = fraction({resolved[0][i], resolved[1][j], resolved[2][k]});
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

// One-sided differences tell too little of a surface that leaves the domain; all that the
// neighbours hold tells enough.
template <class T>
Vec3 NormalStencil<T>::fit(const Neighbourhood& hood, const Vec3& m) {
  NeighbourFractions neighbours;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        neighbours.fraction[k][j][i] = hood.c[9 * k + 3 * j + i];
        neighbours.is_there[k][j][i] =
            hood.present[0][i] != 0.0 && hood.present[1][j] != 0.0 && hood.present[2][k] != 0.0;
      }
    }
  }
  return fit_to_neighbours(neighbours, m);
}

// Adds the normal from the heights along one axis, scaled to |.|₁ = 1, if all nine columns agree.
// `sense` is +1 where the material is at the low end of the columns.
template <class T>
bool NormalStencil<T>::add_heights(const Index3& cell, std::size_t axis, double sense,
                                   Vec3& sum) const {
  const std::size_t other = (axis + 1) % 3;
  const std::size_t third = (axis + 2) % 3;
  double height[3][3] = {};
  bool there[2][3] = {{true, true, true}, {true, true, true}};
  if (is_inside(cell, axis)) {
    const Index3& step = field_.view.strides;
    const std::int64_t along = sense > 0.0 ? step[axis] : -step[axis];
    const T* centre = data_ + field_.element(cell) - kColumnReach * along;
    for (const int u : {1, 0, 2}) {
      for (const int v : {1, 0, 2}) {
        const T* end = centre + (u - 1) * step[other] + (v - 1) * step[third];
        Column column;
        for (int n = 0; n < baseline::kColumn; ++n) {
          column[n] = fraction_of(end[n * along]);
        }
        if (!is_column(column, baseline::kColumn, height[u][v])) {
          return false;
        }
      }
    }
  } else {
    const SideColumns columns = side_columns(cell, axis, sense);
    for (int t = 0; t < 3; ++t) {
      there[0][t] = columns.foot[0][static_cast<std::size_t>(t)] != kMissing;
      there[1][t] = columns.foot[1][static_cast<std::size_t>(t)] != kMissing;
    }
    for (const int u : {1, 0, 2}) {
      for (const int v : {1, 0, 2}) {
        if (there[0][u] && there[1][v] && !column_at_side(columns, axis, u, v, height[u][v])) {
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

// Of nine cells, or what the domain has of them, from the material's end on.
template <class T>
bool NormalStencil<T>::is_column(const Column& column, int count, double& height) const {
  if (!is_consistent(column, count, full_, empty_)) {
    return false;
  }
  height = baseline::height_of(column);
  return true;
}

template <class T>
typename NormalStencil<T>::SideColumns NormalStencil<T>::side_columns(const Index3& cell,
                                                                      std::size_t axis,
                                                                      double sense) const {
  SideColumns columns;
  for (std::int64_t n = -kColumnReach; n <= kColumnReach; ++n) {
    const std::int64_t index = field_.axes[axis].resolve(cell[axis] + n);
    if (index != kMissing) {
      columns.along[static_cast<std::size_t>(columns.count++)] = index;
    }
  }
  if (sense < 0.0) {
    std::reverse(columns.along.begin(), columns.along.begin() + columns.count);
  }
  for (std::size_t t = 0; t < 2; ++t) {
    const std::size_t across = (axis + 1 + t) % 3;
    for (std::int64_t n = 0; n < 3; ++n) {
      columns.foot[t][static_cast<std::size_t>(n)] =
          field_.axes[across].resolve(cell[across] + n - 1);
    }
  }
  return columns;
}

template <class T>
bool NormalStencil<T>::column_at_side(const SideColumns& columns, std::size_t axis, int u, int v,
                                      double& height) const {
  Index3 resolved;
  resolved[(axis + 1) % 3] = columns.foot[0][static_cast<std::size_t>(u)];
  resolved[(axis + 2) % 3] = columns.foot[1][static_cast<std::size_t>(v)];
  Column column{};
  for (std::size_t n = 0; n < static_cast<std::size_t>(columns.count); ++n) {
    resolved[axis] = columns.along[n];
    column[n] = fraction(resolved);
  }
  return is_column(column, columns.count, height);
}

template class NormalStencil<float>;
template class NormalStencil<double>;
template class NormalStencil<std::uint8_t>;
template class NormalStencil<std::uint16_t>;

}  // namespace detail

}  // namespace difmesh
