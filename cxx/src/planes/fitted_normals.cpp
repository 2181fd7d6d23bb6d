#include "planes/fitted_normals.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "planes/cells_around.hpp"
#include "planes/cube_fraction.hpp"
#include "planes/plane_fit.hpp"

namespace difmesh::detail {
namespace {

using Surroundings = CellsAround<kElviraReach>;

NeighbourFractions neighbours_in(const Surroundings& around) {
  NeighbourFractions hood;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        const bool is_there = around.is_there({i - 1, j - 1, k - 1});
        hood.is_there[k][j][i] = is_there;
        hood.fraction[k][j][i] = is_there ? around.fraction({i - 1, j - 1, k - 1}) : 0.0;
      }
    }
  }
  return hood;
}

/// Sum of the squared differences between the fractions that the centre's plane gives its
/// neighbours and theirs; anything above `bound` where it is more.
double misfit(const NeighbourFractions& hood, const Vec3& m, double bound) {
  const double a = cube_offset(m[0], m[1], m[2], hood.fraction[1][1][1]);
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        if (hood.is_there[k][j][i]) {
          const double shift = m[0] * (i - 1) + m[1] * (j - 1) + m[2] * (k - 1);
          const double away = cube_fraction(m[0], m[1], m[2], a - shift) - hood.fraction[k][j][i];
          sum += away * away;
        }
      }
      if (sum > bound) {
        return sum;
      }
    }
  }
  return sum;
}

double column(const Surroundings& around, std::size_t axis, Index3 foot) {
  double sum = 0.0;
  for (std::int64_t step = -kElviraReach; step <= kElviraReach; ++step) {
    foot[axis] = step;
    sum += around.is_there(axis, step) ? around.fraction(foot) : 0.0;
  }
  return sum;
}

/// Differences of the columns beside the centre's, in units of cells: backward, centred, forward,
/// as far as there are columns.
struct Slopes {
  std::array<double, 3> value{};
  std::size_t count = 0;

  Slopes(const Surroundings& around, std::size_t along, std::size_t across, double middle) {
    Index3 foot{0, 0, 0};
    std::array<double, 2> beside{};
    for (std::size_t side = 0; side < 2; ++side) {
      const std::int64_t step = side == 0 ? -1 : 1;
      if (around.is_there(across, step)) {
        foot[across] = step;
        beside[side] = column(around, along, foot);
        value[count++] = side == 0 ? middle - beside[0] : beside[1] - middle;
      }
    }
    if (count == 2) {
      value[count++] = 0.5 * (beside[1] - beside[0]);
    } else if (count == 0) {
      value[count++] = 0.0;  // a grid of one layer
    }
  }
};

/// Keeps the candidate of the least misfit; the first of equals.
class Choice {
 public:
  Choice(const NeighbourFractions& hood, const Vec3& start)
      : hood_(hood),
        best_(start),
        least_(misfit(hood, start, std::numeric_limits<double>::infinity())) {}
  void consider(const Vec3& m) {
    const double here = misfit(hood_, m, least_);
    if (here < least_) {
      least_ = here;
      best_ = m;
    }
  }
  [[nodiscard]] const Vec3& best() const { return best_; }

 private:
  const NeighbourFractions& hood_;
  Vec3 best_;
  double least_;
};

Vec3 best_of_columns(const Surroundings& around, const NeighbourFractions& hood,
                     const Vec3& start) {
  Choice choice(hood, start);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (start[axis] == 0.0) {
      continue;  // no telling at which end the material is
    }
    const std::size_t other = (axis + 1) % 3;
    const std::size_t third = (axis + 2) % 3;
    const double middle = column(around, axis, {0, 0, 0});
    const Slopes along_other(around, axis, other, middle);
    const Slopes along_third(around, axis, third, middle);
    for (std::size_t u = 0; u < along_other.count; ++u) {
      for (std::size_t v = 0; v < along_third.count; ++v) {
        Vec3 m;
        m[axis] = start[axis] > 0.0 ? 1.0 : -1.0;
        m[other] = -along_other.value[u];
        m[third] = -along_third.value[v];
        const double size = std::abs(m[0]) + std::abs(m[1]) + std::abs(m[2]);
        choice.consider({m[0] / size, m[1] / size, m[2] / size});
      }
    }
  }
  return choice.best();
}

}  // namespace

UnitNormal fitted_normal(const BlockField& field, Normals normals, const Index3& cell,
                         const UnitNormal& start) {
  const Surroundings around(field, cell);
  const NeighbourFractions hood = neighbours_in(around);
  const double fraction = hood.fraction[1][1][1];
  if (start.source == NormalSource::none || !(fraction > 0.0 && fraction < 1.0)) {
    return start;
  }
  const Vec3 m = normals == Normals::elvira ? best_of_columns(around, hood, start.m)
                                            : fit_to_neighbours(hood, start.m);
  return {m, NormalSource::least_squares};
}

}  // namespace difmesh::detail
