#pragma once
// The surface of genus 2 of Evrard et al. (2019), eq. 15.

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>

#include "shapes/nearest_point.hpp"
#include "shapes/shape_body.hpp"

namespace difmesh::detail {

/// At scale 1: f = 2v(v^2 - 3u^2)(1 - w^2) + (u^2 + v^2)^2 - (9w^2 - 1)(1 - w^2) + (27/16) max(0,
/// w^2 - 1)^4.
///
/// Without the last term, which the paper does not have, f would be negative again for |w| > 1.9.
/// With c = w^2 - 1 > 0 and r^2 = u^2 + v^2, f >= r^4 - 2 c r^3 + 9c^2 + 8c + (27/16) c^4, and r^4
/// - 2 c r^3 >= -(27/16) c^4; so now it is positive. The surface, all in |w| <= 1, is the same.
class GenusModel {
 public:
  explicit GenusModel(double scale) : scale_(scale) {}

  [[nodiscard]] double value(const Vec3& u) const {
    const double x = u[0] / scale_;
    const double y = u[1] / scale_;
    const double z2 = u[2] * u[2] / (scale_ * scale_);
    const double r2 = x * x + y * y;
    const double c = 1.0 - z2;
    const double beyond = std::min(0.0, c) * std::min(0.0, c);
    return 2.0 * y * (y * y - 3.0 * x * x) * c + r2 * r2 - (9.0 * z2 - 1.0) * c +
           kBeyond * beyond * beyond;
  }
  [[nodiscard]] Vec3 gradient(const Vec3& u) const;
  [[nodiscard]] double distance(const Vec3& u) const;
  [[nodiscard]] Extent extent(const Vec3& direction) const;
  [[nodiscard]] std::optional<double> volume() const;

  static constexpr double kBeyond = 27.0 / 16.0;

 private:
  double scale_;
  // Made by the first call that wants a distance.
  mutable std::once_flag once_;
  mutable std::unique_ptr<const PointCloud> cloud_;
};

}  // namespace difmesh::detail
