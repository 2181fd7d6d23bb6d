#pragma once
// The search of plane_fit.hpp: eight neighbours at a time.

#include "planes/kernels.hpp"
#include "planes/plane_math.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

class PlaneSearch {
 public:
  explicit PlaneSearch(const FitTask& cells)
      : centre_(cells.centre), groups_((cells.count + kLanes - 1) / kLanes) {
    for (int g = 0; g < groups_; ++g) {
      fraction_[g] = load(cells.fraction + g * kLanes);
      for (int n = 0; n < kLanes; ++n) {
        is_there_[g].set(n, g * kLanes + n < cells.count ? 1.0 : 0.0);
      }
      for (int t = 0; t < 3; ++t) {
        shift_[t][g] = load(cells.shift[t] + g * kLanes);
      }
    }
  }

  void run(double (&m)[3]) const {
    constexpr int kMost = 12;
    constexpr double kLongest =
        0.5;  // radians, about: longer turns leave what the derivatives know
    // Where a curved surface leaves residuals, a step that lessens their sum by less is the last. A
    // plane's sum falls by a factor of 1e8 at each step, until nothing but rounding is left.
    constexpr double kWorthwhile = 1e-3;
    Vector best = unit({m[0], m[1], m[2]});
    Residuals r;
    double sum = residuals(best, offset(best), r);
    for (int n = 0; n < kMost; ++n) {
      const Vector across0 = unit(cross(best, least_axis(best)));
      const Vector across1 = cross(best, across0);
      const Turn by = step(best, r, across0, across1);
      const double length = square_root(by.by0 * by.by0 + by.by1 * by.by1);
      const double shorten = length > kLongest ? kLongest / length : 1.0;
      bool better = false;
      bool settled = false;
      for (double factor = shorten; factor > 0.05 * shorten && !better; factor *= 0.5) {
        const Vector candidate = turned(best, across0, across1, factor * by.by0, factor * by.by1);
        Residuals at_candidate;
        const double candidate_sum = residuals(candidate, offset(candidate), at_candidate);
        // Near the best plane sums differ by rounding only, and rounding must not decide.
        better = candidate_sum <= sum * (1.0 + 1e-6) + 1e-24;
        if (better) {
          settled = candidate_sum > sum * (1.0 - kWorthwhile);
          best = candidate;
          r = at_candidate;
          sum = candidate_sum;
        }
      }
      if (!better || settled || length < 1e-9) {
        break;
      }
    }
    const double size = magnitude(best.x) + magnitude(best.y) + magnitude(best.z);
    m[0] = best.x * (1.0 / size);
    m[1] = best.y * (1.0 / size);
    m[2] = best.z * (1.0 / size);
  }

 private:
  static constexpr int kGroups = kFitCells / kLanes;

  struct Vector {
    double x, y, z;
  };
  struct Turn {
    double by0, by1;
  };
  struct Residuals {
    Lanes group[kGroups];
  };

  static double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  static Vector unit(const Vector& v) {
    const double factor = 1.0 / square_root(dot(v, v));
    return {v.x * factor, v.y * factor, v.z * factor};
  }
  static Vector turned(const Vector& m, const Vector& across0, const Vector& across1, double by0,
                       double by1) {
    return unit({m.x + by0 * across0.x + by1 * across1.x, m.y + by0 * across0.y + by1 * across1.y,
                 m.z + by0 * across0.z + by1 * across1.z});
  }
  static Vector least_axis(const Vector& m) {
    const double x = magnitude(m.x);
    const double y = magnitude(m.y);
    const double z = magnitude(m.z);
    const bool is_x = x <= y && x <= z;
    const bool is_y = !(x <= y) && y <= z;
    return {is_x ? 1.0 : 0.0, is_y ? 1.0 : 0.0, is_x || is_y ? 0.0 : 1.0};
  }
  static double total(const Lanes& v) {
    return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
  }

  [[nodiscard]] double offset(const Vector& m) const {
    return offset_of_share(sorted(m.x, m.y, m.z), centre_);
  }

  // Returns the sum of squares.
  double residuals(const Vector& m, double a, Residuals& r) const {
    const Sorted<double> one = sorted(m.x, m.y, m.z);
    const Sorted<Lanes> all{broadcast(one.small),          broadcast(one.middle),
                            broadcast(one.large),          broadcast(one.inverse_small),
                            broadcast(one.inverse_middle), broadcast(one.inverse_large)};
    Lanes sum = broadcast(0.0);
    for (int g = 0; g < groups_; ++g) {
      const Lanes shift = m.x * shift_[0][g] + m.y * shift_[1][g] + m.z * shift_[2][g];
      r.group[g] = (cube_share(all, a - shift) - fraction_[g]) * is_there_[g];
      sum = sum + r.group[g] * r.group[g];
    }
    return total(sum);
  }

  // The turn, about two unit vectors across m, that the residuals' derivatives promise to be best.
  Turn step(const Vector& m, const Residuals& r, const Vector& across0,
            const Vector& across1) const {
    // Central differences over turns this wide err by some 1e-4 of the derivatives, which costs a
    // step, and hardly by rounding, so that mirrored neighbourhoods get mirrored planes.
    constexpr double kTurn = 1e-2;
    const Vector turns[4] = {
        turned(m, across0, across1, -kTurn, 0.0), turned(m, across0, across1, kTurn, 0.0),
        turned(m, across0, across1, 0.0, -kTurn), turned(m, across0, across1, 0.0, kTurn)};
    Lanes x = broadcast(0.0);
    Lanes y = x;
    Lanes z = x;
    for (int n = 0; n < kLanes; ++n) {
      x.set(n, turns[n % 4].x);
      y.set(n, turns[n % 4].y);
      z.set(n, turns[n % 4].z);
    }
    const Lanes offsets = offset_of_share(sorted(x, y, z), broadcast(centre_));
    Residuals turned_residuals[4];
    for (int n = 0; n < 4; ++n) {
      residuals(turns[n], offsets[n], turned_residuals[n]);
    }
    Lanes a00 = broadcast(0.0);
    Lanes a01 = a00;
    Lanes a11 = a00;
    Lanes b0 = a00;
    Lanes b1 = a00;
    for (int g = 0; g < groups_; ++g) {
      const Lanes d0 =
          (turned_residuals[1].group[g] - turned_residuals[0].group[g]) * (0.5 / kTurn);
      const Lanes d1 =
          (turned_residuals[3].group[g] - turned_residuals[2].group[g]) * (0.5 / kTurn);
      a00 = a00 + d0 * d0;
      a01 = a01 + d0 * d1;
      a11 = a11 + d1 * d1;
      b0 = b0 - d0 * r.group[g];
      b1 = b1 - d1 * r.group[g];
    }
    const double s00 = total(a00);
    const double s01 = total(a01);
    const double s11 = total(a11);
    const double t0 = total(b0);
    const double t1 = total(b1);
    const double determinant = s00 * s11 - s01 * s01;
    // A direction that no neighbour feels cannot be fitted.
    if (!(determinant > 1e-6 * (s00 + s11) * (s00 + s11))) {
      return {0.0, 0.0};
    }
    return {(s11 * t0 - s01 * t1) / determinant, (s00 * t1 - s01 * t0) / determinant};
  }

  double centre_;
  int groups_;
  Lanes fraction_[kGroups];
  Lanes is_there_[kGroups];  // 1 or 0
  Lanes shift_[3][kGroups];
};

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
