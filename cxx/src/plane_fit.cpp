#include "plane_fit.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "unit_plane.hpp"

namespace difmesh::detail {
namespace {

constexpr std::size_t kCells = 27;
using Residuals = std::array<double, kCells>;

double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3 scaled(const Vec3& v, double factor) {
  return {v[0] * factor, v[1] * factor, v[2] * factor};
}

Vec3 unit(const Vec3& v) {
  return scaled(v, 1.0 / std::sqrt(dot(v, v)));
}

Vec3 turned(const Vec3& m, const Vec3& across0, const Vec3& across1, double by0, double by1) {
  Vec3 result;
  for (std::size_t t = 0; t < 3; ++t) {
    result[t] = m[t] + by0 * across0[t] + by1 * across1[t];
  }
  return unit(result);
}

class Fit {
 public:
  explicit Fit(const NeighbourFractions& hood) : hood_(hood) {}

  // Returns the sum of squares.
  double residuals(const Vec3& m, Residuals& r) const {
    const double a = cube_offset(m[0], m[1], m[2], hood_.fraction[1][1][1]);
    double sum = 0.0;
    std::size_t n = 0;
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i, ++n) {
          r[n] = 0.0;
          if (hood_.is_there[k][j][i]) {
            const double shift = m[0] * (i - 1) + m[1] * (j - 1) + m[2] * (k - 1);
            r[n] = cube_fraction(m[0], m[1], m[2], a - shift) - hood_.fraction[k][j][i];
            sum += r[n] * r[n];
          }
        }
      }
    }
    return sum;
  }

  // The turn, about two unit vectors across m, that the residuals' derivatives promise to be best.
  std::array<double, 2> step(const Vec3& m, const Residuals& r, const Vec3& across0,
                             const Vec3& across1) const {
    // Central differences over turns this wide err by some 1e-4 of the derivatives, which costs a step, and
    // hardly by rounding, so that mirrored neighbourhoods get mirrored planes.
    constexpr double kTurn = 1e-2;
    Residuals less0;
    Residuals more0;
    Residuals less1;
    Residuals more1;
    residuals(turned(m, across0, across1, -kTurn, 0.0), less0);
    residuals(turned(m, across0, across1, kTurn, 0.0), more0);
    residuals(turned(m, across0, across1, 0.0, -kTurn), less1);
    residuals(turned(m, across0, across1, 0.0, kTurn), more1);
    double a00 = 0.0;
    double a01 = 0.0;
    double a11 = 0.0;
    double b0 = 0.0;
    double b1 = 0.0;
    for (std::size_t n = 0; n < kCells; ++n) {
      const double d0 = (more0[n] - less0[n]) / (2.0 * kTurn);
      const double d1 = (more1[n] - less1[n]) / (2.0 * kTurn);
      a00 += d0 * d0;
      a01 += d0 * d1;
      a11 += d1 * d1;
      b0 -= d0 * r[n];
      b1 -= d1 * r[n];
    }
    const double determinant = a00 * a11 - a01 * a01;
    // A direction that no neighbour feels cannot be fitted.
    if (!(determinant > 1e-6 * (a00 + a11) * (a00 + a11))) {
      return {0.0, 0.0};
    }
    return {(a11 * b0 - a01 * b1) / determinant, (a00 * b1 - a01 * b0) / determinant};
  }

 private:
  const NeighbourFractions& hood_;
};

}  // namespace

Vec3 fit_to_neighbours(const NeighbourFractions& hood, const Vec3& start) {
  constexpr int kMost = 12;
  constexpr double kLongest = 0.5;  // radians, about: longer turns leave what the derivatives know
  const Fit fit(hood);
  Vec3 m = unit(start);
  Residuals r;
  double sum = fit.residuals(m, r);
  for (int n = 0; n < kMost; ++n) {
    const std::size_t least = std::abs(m[0]) <= std::abs(m[1])
                                  ? (std::abs(m[0]) <= std::abs(m[2]) ? 0U : 2U)
                                  : (std::abs(m[1]) <= std::abs(m[2]) ? 1U : 2U);
    Vec3 helper{0.0, 0.0, 0.0};
    helper[least] = 1.0;
    const Vec3 across0 = unit(cross(m, helper));
    const Vec3 across1 = cross(m, across0);
    std::array<double, 2> by = fit.step(m, r, across0, across1);
    const double length = std::hypot(by[0], by[1]);
    const double shorten = length > kLongest ? kLongest / length : 1.0;
    bool better = false;
    for (double factor = shorten; factor > 0.05 * shorten && !better; factor *= 0.5) {
      const Vec3 candidate = turned(m, across0, across1, factor * by[0], factor * by[1]);
      Residuals at_candidate;
      const double candidate_sum = fit.residuals(candidate, at_candidate);
      // Near the best plane sums differ by rounding only, and rounding must not decide.
      better = candidate_sum <= sum * (1.0 + 1e-6) + 1e-24;
      if (better) {
        m = candidate;
        r = at_candidate;
        sum = candidate_sum;
      }
    }
    if (!better || length < 1e-14) {
      break;
    }
  }
  return scaled(m, 1.0 / (std::abs(m[0]) + std::abs(m[1]) + std::abs(m[2])));
}

}  // namespace difmesh::detail
