#include "planes/stretched_normal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/vector3.hpp"
#include "planes/cells_around.hpp"
#include "planes/cube_fraction.hpp"
#include "planes/fitted_normals.hpp"
#include "planes/normal_math.hpp"

namespace difmesh::detail {
namespace {

using baseline::kTie;

/// The cells around one: how wide they are, and where their centres lie from its own.
class Surroundings : public CellsAround<kColumnReach> {
 public:
  Surroundings(const BlockField& field, const Index3& cell)
      : CellsAround(field, cell), purity_tolerance_(field.purity_tolerance) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::int64_t step = -kColumnReach; step <= kColumnReach; ++step) {
        at(axis, step).width = field.width(axis, cell[axis] + step);
      }
      for (std::int64_t step = 1; step <= kColumnReach; ++step) {
        at(axis, step).centre =
            at(axis, step - 1).centre + 0.5 * (at(axis, step - 1).width + at(axis, step).width);
        at(axis, -step).centre =
            at(axis, 1 - step).centre - 0.5 * (at(axis, 1 - step).width + at(axis, -step).width);
      }
    }
  }

  [[nodiscard]] double width(std::size_t axis, std::int64_t step) const {
    return extents_[axis][static_cast<std::size_t>(step + kColumnReach)].width;
  }
  [[nodiscard]] double centre(std::size_t axis, std::int64_t step) const {
    return extents_[axis][static_cast<std::size_t>(step + kColumnReach)].centre;
  }
  /// Sizes of the cell itself.
  [[nodiscard]] Vec3 size() const { return {width(0, 0), width(1, 0), width(2, 0)}; }
  [[nodiscard]] double purity_tolerance() const { return purity_tolerance_; }

 private:
  struct Extent {
    double width = 0.0;
    double centre = 0.0;
  };
  [[nodiscard]] Extent& at(std::size_t axis, std::int64_t step) {
    return extents_[axis][static_cast<std::size_t>(step + kColumnReach)];
  }
  double purity_tolerance_;
  std::array<std::array<Extent, 2 * kColumnReach + 1>, 3> extents_;
};

/// A normal in space as one in the unit cube, |.|₁ = 1; zero stays zero.
Vec3 in_unit_cube(const Vec3& normal, const Vec3& size) {
  const Vec3 m{normal[0] * size[0], normal[1] * size[1], normal[2] * size[2]};
  const double sum = norm1(m);
  return sum > 0.0 ? scaled(m, 1.0 / sum) : m;
}

/// Minus the gradient: differences over the distances of centres, weighted (1,2,1)x(1,2,1) over the
/// lines there are, which makes those at open sides one-sided.
Vec3 gradient(const Surroundings& around) {
  Vec3 result{0.0, 0.0, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t low = around.is_there(axis, -1) ? -1 : 0;
    const std::int64_t high = around.is_there(axis, 1) ? 1 : 0;
    if (low == high) {
      continue;
    }
    const double distance = around.centre(axis, high) - around.centre(axis, low);
    double sum = 0.0;
    double weights = 0.0;
    for (std::int64_t v = -1; v <= 1; ++v) {
      for (std::int64_t u = -1; u <= 1; ++u) {
        Index3 from{0, 0, 0};
        from[(axis + 1) % 3] = u;
        from[(axis + 2) % 3] = v;
        Index3 to = from;
        from[axis] = low;
        to[axis] = high;
        if (around.is_there(from) && around.is_there(to)) {
          const double weight = (u == 0 ? 2.0 : 1.0) * (v == 0 ? 2.0 : 1.0);
          sum += weight * (around.fraction(from) - around.fraction(to));
          weights += weight;
        }
      }
    }
    result[axis] = sum / (weights * distance);
  }
  return result;
}

/// Length of the material in a column of cells within a reach, as far as they are there.
double column_length(const Surroundings& around, std::size_t along, Index3 foot,
                     std::int64_t reach) {
  double length = 0.0;
  for (std::int64_t step = -reach; step <= reach; ++step) {
    foot[along] = step;
    if (around.is_there(along, step)) {
      length += around.fraction(foot) * around.width(along, step);
    }
  }
  return length;
}

/// Slopes of heights of neighbouring columns at the centre of the middle one: of the parabola with
/// these means, or of the line through two where one is missing.
struct Slopes {
  std::optional<double> backward;
  std::optional<double> forward;
  double best = 0.0;

  Slopes(const Surroundings& around, std::size_t across, const std::array<double, 3>& height) {
    const double below = around.centre(across, -1);
    const double above = around.centre(across, 1);
    const bool has_below = around.is_there(across, -1);
    const bool has_above = around.is_there(across, 1);
    if (has_below) {
      backward = (height[1] - height[0]) / -below;
    }
    if (has_above) {
      forward = (height[2] - height[1]) / above;
    }
    if (!has_below || !has_above) {
      best = has_above ? *forward : backward.value_or(0.0);
      return;
    }
    // With p = a + b x + c x² and its means, backward = b + c low and forward = b + c high.
    const double own = around.width(across, 0) * around.width(across, 0);
    const double size_below = around.width(across, -1) * around.width(across, -1);
    const double size_above = around.width(across, 1) * around.width(across, 1);
    const double low = below + (size_below - own) / (12.0 * below);
    const double high = above + (size_above - own) / (12.0 * above);
    best = *backward - low * (*forward - *backward) / (high - low);
  }
};

/// The heights of the three columns along an axis, side by side.
std::array<double, 3> heights(const Surroundings& around, std::size_t along, std::size_t across,
                              std::int64_t reach) {
  std::array<double, 3> height{};
  for (std::int64_t step = -1; step <= 1; ++step) {
    Index3 foot{0, 0, 0};
    foot[across] = step;
    height[static_cast<std::size_t>(step + 1)] =
        around.is_there(across, step) ? column_length(around, along, foot, reach) : 0.0;
  }
  return height;
}

/// The normal that points along an axis by the sense, from the slopes of columns across it: the
/// material ends at a height of its length, or at minus that where it fills the high end.
Vec3 normal_of(std::size_t axis, double sense, double slope_other, double slope_third) {
  Vec3 normal;
  normal[axis] = sense;
  normal[(axis + 1) % 3] = -slope_other;
  normal[(axis + 2) % 3] = -slope_third;
  return normal;
}

/// MYC of Aulisa et al. 2007 in the unit cube. \param m Youngs' normal
UnitNormal mixed(const Surroundings& around, const Vec3& m) {
  std::array<Vec3, 3> candidates{};
  Vec3 own{0.0, 0.0, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double lower_minus_upper = 0.0;
    for (std::int64_t v = -1; v <= 1; ++v) {
      for (std::int64_t u = -1; u <= 1; ++u) {
        for (const std::int64_t step : {-1, 1}) {
          Index3 steps{0, 0, 0};
          steps[axis] = around.is_there(axis, step) ? step : 0;
          steps[(axis + 1) % 3] = u;
          steps[(axis + 2) % 3] = v;
          if (around.is_there(steps)) {
            lower_minus_upper -= static_cast<double>(step) * around.fraction(steps);
          }
        }
      }
    }
    if (std::abs(lower_minus_upper) <= kTie) {
      continue;
    }
    const std::size_t other = (axis + 1) % 3;
    const std::size_t third = (axis + 2) % 3;
    const Slopes along_other(around, other, heights(around, axis, other, 1));
    const Slopes along_third(around, third, heights(around, axis, third, 1));
    candidates[axis] = in_unit_cube(
        normal_of(axis, lower_minus_upper > 0.0 ? 1.0 : -1.0, along_other.best, along_third.best),
        around.size());
    own[axis] = std::abs(candidates[axis][axis]);
  }
  const double best = std::max({own[0], own[1], own[2]});
  const double largest = std::max({std::abs(m[0]), std::abs(m[1]), std::abs(m[2])});
  Vec3 sum{0.0, 0.0, 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t t = 0; own[axis] >= best - kTie && t < 3; ++t) {
      sum[t] += candidates[axis][t];
    }
  }
  const double size = norm1(sum);
  if (best > largest || best == 0.0 || size < kTie) {
    return {m, NormalSource::youngs};
  }
  return {scaled(sum, 1.0 / size), NormalSource::centred_columns};
}

/// Whether a column has a height. Where its last cell is all but pure next to an interfacial one,
/// the surface may go on behind it.
bool has_height(const Surroundings& around, std::size_t axis, double sense, Index3 foot) {
  const double full = 1.0 - around.purity_tolerance();
  const double empty = around.purity_tolerance();
  FractionColumn column{};
  int count = 0;
  for (std::int64_t n = -kColumnReach; n <= kColumnReach; ++n) {
    const std::int64_t step = sense > 0.0 ? n : -n;
    if (around.is_there(axis, step)) {
      foot[axis] = step;
      column[count++] = around.fraction(foot);
    }
  }
  if (count < 2 || !is_consistent(column, count, full, empty)) {
    return false;
  }
  const bool ends_full = column[0] == 1.0 || column[1] >= full;
  const bool ends_empty = column[count - 1] == 0.0 || column[count - 2] <= empty;
  return ends_full && ends_empty;
}

/// From the heights along one axis, if all columns that there are agree.
std::optional<Vec3> from_heights(const Surroundings& around, std::size_t axis, double sense) {
  const std::size_t other = (axis + 1) % 3;
  const std::size_t third = (axis + 2) % 3;
  for (std::int64_t v = -1; v <= 1; ++v) {
    for (std::int64_t u = -1; u <= 1; ++u) {
      if (around.is_there(other, u) && around.is_there(third, v)) {
        Index3 foot{0, 0, 0};
        foot[other] = u;
        foot[third] = v;
        if (!has_height(around, axis, sense, foot)) {
          return std::nullopt;
        }
      }
    }
  }
  const Slopes along_other(around, other, heights(around, axis, other, kColumnReach));
  const Slopes along_third(around, third, heights(around, axis, third, kColumnReach));
  return in_unit_cube(normal_of(axis, sense, along_other.best, along_third.best), around.size());
}

/// The neighbours that there are, as seen from the unit cube of the cell.
class Neighbours {
 public:
  explicit Neighbours(const Surroundings& around) : centre_(around.fraction({0, 0, 0})) {
    const Vec3 size = around.size();
    for (int n = 0; n < 27; ++n) {
      const Index3 steps{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      if (n == 13 || !around.is_there(steps)) {
        continue;
      }
      Neighbour& each = list_[static_cast<std::size_t>(count_++)];
      each.fraction = around.fraction(steps);
      for (std::size_t t = 0; t < 3; ++t) {
        each.shift[t] = around.centre(t, steps[t]) / size[t];
        each.size[t] = around.width(t, steps[t]) / size[t];
      }
    }
  }

  using Residuals = std::array<double, 26>;

  /// Differences between the fractions that the cell's plane of this normal gives its neighbours
  /// and theirs; returns the sum of squares.
  double residuals(const Vec3& m, Residuals& residuals) const {
    const double a = cube_offset(m[0], m[1], m[2], centre_);
    double sum = 0.0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(count_); ++n) {
      const Neighbour& each = list_[n];
      const double shift = m[0] * each.shift[0] + m[1] * each.shift[1] + m[2] * each.shift[2];
      residuals[n] =
          cube_fraction(m[0] * each.size[0], m[1] * each.size[1], m[2] * each.size[2], a - shift) -
          each.fraction;
      sum += residuals[n] * residuals[n];
    }
    return sum;
  }
  [[nodiscard]] double misfit(const Vec3& m) const {
    Residuals ignored;
    return residuals(m, ignored);
  }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(count_); }

 private:
  struct Neighbour {
    double fraction;
    Vec3 shift;
    Vec3 size;
  };
  double centre_;
  int count_ = 0;
  std::array<Neighbour, 26> list_;
};

Vec3 turned(const Vec3& m, const std::array<Vec3, 2>& across, double by0, double by1) {
  return unit(plus(plus(m, scaled(across[0], by0)), scaled(across[1], by1)));
}

std::array<Vec3, 2> directions_across(const Vec3& m) {
  std::size_t least = 0;
  for (std::size_t t = 1; t < 3; ++t) {
    least = std::abs(m[t]) < std::abs(m[least]) ? t : least;
  }
  const std::size_t next = (least + 1) % 3;
  const std::size_t third = (least + 2) % 3;
  Vec3 first{0.0, 0.0, 0.0};
  first[next] = m[third];
  first[third] = -m[next];
  first = unit(first);
  return {first, cross(m, first)};
}

/// The turns about the two directions that the residuals' derivatives promise to be best.
std::array<double, 2> best_turn(const Neighbours& neighbours, const Vec3& m,
                                const Neighbours::Residuals& r, const std::array<Vec3, 2>& across) {
  constexpr double kTurn = 1e-2;
  std::array<Neighbours::Residuals, 2> derivative{};
  for (std::size_t d = 0; d < 2; ++d) {
    Neighbours::Residuals low{};
    Neighbours::Residuals high{};
    const double by0 = d == 0 ? kTurn : 0.0;
    const double by1 = d == 0 ? 0.0 : kTurn;
    neighbours.residuals(turned(m, across, -by0, -by1), low);
    neighbours.residuals(turned(m, across, by0, by1), high);
    for (std::size_t n = 0; n < neighbours.count(); ++n) {
      derivative[d][n] = (high[n] - low[n]) * (0.5 / kTurn);
    }
  }
  double a00 = 0.0;
  double a01 = 0.0;
  double a11 = 0.0;
  double b0 = 0.0;
  double b1 = 0.0;
  for (std::size_t n = 0; n < neighbours.count(); ++n) {
    const double d0 = derivative[0][n];
    const double d1 = derivative[1][n];
    a00 += d0 * d0;
    a01 += d0 * d1;
    a11 += d1 * d1;
    b0 -= d0 * r[n];
    b1 -= d1 * r[n];
  }
  const double determinant = a00 * a11 - a01 * a01;
  // A direction that no neighbour feels cannot be fitted.
  if (!(determinant > 1e-12 * (a00 + a11) * (a00 + a11))) {
    return {0.0, 0.0};
  }
  return {(a11 * b0 - a01 * b1) / determinant, (a00 * b1 - a01 * b0) / determinant};
}

/// Turns m to lessen the sum of squares: LVIRA, by Gauss-Newton steps. See plane_fit.hpp.
Vec3 fit(const Neighbours& neighbours, const Vec3& start) {
  constexpr int kMost = 30;
  constexpr double kLongest = 0.5;  // radians, about
  constexpr double kWorthwhile = 1e-3;
  Vec3 best = unit(start);
  Neighbours::Residuals r{};
  double sum = neighbours.residuals(best, r);
  for (int n = 0; n < kMost; ++n) {
    const std::array<Vec3, 2> across = directions_across(best);
    const std::array<double, 2> by = best_turn(neighbours, best, r, across);
    const double length = std::hypot(by[0], by[1]);
    const double shorten = length > kLongest ? kLongest / length : 1.0;
    bool better = false;
    bool settled = false;
    for (double factor = shorten; factor > 0.05 * shorten && !better; factor *= 0.5) {
      const Vec3 candidate = turned(best, across, factor * by[0], factor * by[1]);
      Neighbours::Residuals at_candidate{};
      const double candidate_sum = neighbours.residuals(candidate, at_candidate);
      better = candidate_sum <= sum * (1.0 + 1e-6) + 1e-26;
      if (better) {
        settled = candidate_sum > sum * (1.0 - kWorthwhile);
        best = candidate;
        r = at_candidate;
        sum = candidate_sum;
      }
    }
    if (!better || settled || length < 1e-12) {
      break;
    }
  }
  return scaled(best, 1.0 / norm1(best));
}

/// Of the differences of columns of five, in all ways and along all axes, what fits best: ELVIRA.
Vec3 best_of_columns(const Surroundings& around, const Neighbours& neighbours, const Vec3& start) {
  Vec3 best = start;
  double least = neighbours.misfit(start);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (start[axis] == 0.0) {
      continue;  // no telling at which end the material is
    }
    const std::size_t other = (axis + 1) % 3;
    const std::size_t third = (axis + 2) % 3;
    const Slopes along_other(around, other, heights(around, axis, other, kElviraReach));
    const Slopes along_third(around, third, heights(around, axis, third, kElviraReach));
    const auto all = [](const Slopes& slopes) {
      return std::array<double, 3>{slopes.backward.value_or(slopes.best), slopes.best,
                                   slopes.forward.value_or(slopes.best)};
    };
    for (const double u : all(along_other)) {
      for (const double v : all(along_third)) {
        const Vec3 m =
            in_unit_cube(normal_of(axis, start[axis] > 0.0 ? 1.0 : -1.0, u, v), around.size());
        const double misfit = neighbours.misfit(m);
        if (misfit < least) {
          least = misfit;
          best = m;
        }
      }
    }
  }
  return best;
}

}  // namespace

UnitNormal stretched_normal(const BlockField& field, Normals normals, const Index3& cell) {
  const Surroundings around(field, cell);
  const Vec3 by_gradient = gradient(around);
  const Vec3 size = around.size();
  const Vec3 per_cell{by_gradient[0] * size[0], by_gradient[1] * size[1], by_gradient[2] * size[2]};
  if (norm1(per_cell) < kTie) {
    return {};
  }
  const Vec3 youngs = in_unit_cube(by_gradient, size);
  if (normals == Normals::youngs) {
    return {youngs, NormalSource::youngs};
  }
  const UnitNormal normal = mixed(around, youngs);
  const double fraction = around.fraction({0, 0, 0});
  const bool is_fit_for_planes = fraction > 0.0 && fraction < 1.0;
  if (normals == Normals::myc || (is_fitted(normals) && !is_fit_for_planes)) {
    return normal;
  }
  const Neighbours neighbours(around);
  if (normals == Normals::elvira) {
    return {best_of_columns(around, neighbours, normal.m), NormalSource::least_squares};
  }
  // Planes are found from starts some ten degrees off, and centred columns may be off by more.
  const auto fitted = [&] {
    return fit(neighbours, best_of_columns(around, neighbours, normal.m));
  };
  if (normals == Normals::lvira) {
    return {fitted(), NormalSource::least_squares};
  }
  // Where cells shrink along a column, four of them may be too short for a plane that leans as far
  // as one can: the fit takes such cells everywhere, not at open sides alone.
  const double largest =
      std::max({std::abs(normal.m[0]), std::abs(normal.m[1]), std::abs(normal.m[2])});
  Vec3 sum{0.0, 0.0, 0.0};
  bool has_heights = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(normal.m[axis]) < largest * (1.0 - kTie)) {
      continue;
    }
    if (const std::optional<Vec3> m =
            from_heights(around, axis, normal.m[axis] > 0.0 ? 1.0 : -1.0)) {
      has_heights = true;
      for (std::size_t t = 0; t < 3; ++t) {
        sum[t] += (*m)[t];
      }
    }
  }
  if (has_heights) {
    return {scaled(sum, 1.0 / norm1(sum)), NormalSource::height_function};
  }
  return is_fit_for_planes ? UnitNormal{fitted(), NormalSource::least_squares} : normal;
}

}  // namespace difmesh::detail
