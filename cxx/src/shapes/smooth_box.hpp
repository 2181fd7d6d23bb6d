#pragma once
// A superellipsoid.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "shapes/nearest_point.hpp"
#include "shapes/shape_body.hpp"

namespace difmesh::detail {

/// f = c ((sum |u_i / a_i|^p)^(1/p) - 1), c the least semi-axis: grows by at most 1 per unit of
/// length.
class SmoothBoxModel {
 public:
  SmoothBoxModel(const Vec3& semi_axes, double exponent);

  [[nodiscard]] double value(const Vec3& u) const { return least_ * (norm(u) - 1.0); }
  [[nodiscard]] Vec3 gradient(const Vec3& u) const;
  [[nodiscard]] double distance(const Vec3& u) const;
  [[nodiscard]] Extent extent(const Vec3& direction) const;
  [[nodiscard]] std::optional<double> volume() const;

 private:
  [[nodiscard]] double power(double base) const {
    if (whole_ == 0) {
      return std::pow(base, exponent_);
    }
    double result = 1.0;
    for (int bits = whole_; bits > 0; bits >>= 1) {
      result = (bits & 1) != 0 ? result * base : result;
      base *= base;
    }
    return result;
  }
  // Divided by the largest first, so that no power overflows far away.
  [[nodiscard]] double norm(const Vec3& u) const {
    const Vec3 t{std::abs(u[0]) / axes_[0], std::abs(u[1]) / axes_[1], std::abs(u[2]) / axes_[2]};
    const double most = std::max({t[0], t[1], t[2]});
    if (most == 0.0) {
      return 0.0;
    }
    const double sum = power(t[0] / most) + power(t[1] / most) + power(t[2] / most);
    return most * std::pow(sum, 1.0 / exponent_);
  }

  Vec3 axes_;
  double exponent_;
  int whole_ = 0;  // the exponent if it is a whole number
  double least_;
  // Points of the surface in the octant of positive coordinates, in rows of kRows, kRows - 1, .. 1.
  std::vector<Vec3> starts_;
};

}  // namespace difmesh::detail
