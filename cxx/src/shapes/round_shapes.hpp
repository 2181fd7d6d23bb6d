#pragma once
// Sphere, ellipsoid and torus.

#include <cmath>
#include <numbers>
#include <optional>

#include "shapes/shape_body.hpp"

namespace difmesh::detail {

/// f = (|u|^2 - r^2) / 2r: smooth everywhere, with a gradient of 1 on the surface.
class SphereModel {
 public:
  explicit SphereModel(double radius) : radius_(radius) {}
  [[nodiscard]] double value(const Vec3& u) const {
    return (dot(u, u) - radius_ * radius_) * (0.5 / radius_);
  }
  [[nodiscard]] Vec3 gradient(const Vec3& u) const { return plus({}, 1.0 / radius_, u); }
  [[nodiscard]] double distance(const Vec3& u) const { return length(u) - radius_; }
  [[nodiscard]] Extent extent(const Vec3&) const { return {radius_, radius_}; }
  [[nodiscard]] std::optional<double> volume() const {
    return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_;
  }

 private:
  double radius_;
};

/// f = (sum (u_i / a_i)^2 - 1) c / 2, c the least semi-axis: a gradient of at most about 1 on the
/// surface.
class EllipsoidModel {
 public:
  explicit EllipsoidModel(const Vec3& semi_axes);
  [[nodiscard]] double value(const Vec3& u) const {
    return half_ *
           (weight_[0] * u[0] * u[0] + weight_[1] * u[1] * u[1] + weight_[2] * u[2] * u[2] - 1.0);
  }
  [[nodiscard]] Vec3 gradient(const Vec3& u) const {
    const double s = 2.0 * half_;
    return {s * weight_[0] * u[0], s * weight_[1] * u[1], s * weight_[2] * u[2]};
  }
  [[nodiscard]] double distance(const Vec3& u) const;
  [[nodiscard]] Extent extent(const Vec3& direction) const;
  [[nodiscard]] std::optional<double> volume() const {
    return 4.0 / 3.0 * std::numbers::pi * axes_[0] * axes_[1] * axes_[2];
  }

 private:
  Vec3 axes_;
  Vec3 weight_;
  double half_;
};

/// f = ((sqrt(u^2 + v^2) - R)^2 + w^2 - r^2) / 2r: smooth but on the w axis, which is outside.
class TorusModel {
 public:
  TorusModel(double radius, double tube_radius) : radius_(radius), tube_(tube_radius) {}
  [[nodiscard]] double value(const Vec3& u) const {
    const double d = std::sqrt(u[0] * u[0] + u[1] * u[1]) - radius_;
    return (d * d + u[2] * u[2] - tube_ * tube_) * (0.5 / tube_);
  }
  [[nodiscard]] Vec3 gradient(const Vec3& u) const {
    const double rho = std::sqrt(u[0] * u[0] + u[1] * u[1]);
    const double share = rho > 0.0 ? (rho - radius_) / (rho * tube_) : 0.0;
    return {share * u[0], share * u[1], u[2] / tube_};
  }
  [[nodiscard]] double distance(const Vec3& u) const {
    return std::hypot(std::hypot(u[0], u[1]) - radius_, u[2]) - tube_;
  }
  [[nodiscard]] Extent extent(const Vec3& direction) const {
    const double reach = radius_ * std::hypot(direction[0], direction[1]) + tube_;
    return {reach, reach};
  }
  [[nodiscard]] std::optional<double> volume() const {
    return 2.0 * std::numbers::pi * std::numbers::pi * radius_ * tube_ * tube_;
  }

 private:
  double radius_;
  double tube_;
};

}  // namespace difmesh::detail
