#include "shapes/genus_shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "difmesh/float_environment.hpp"
namespace difmesh::detail {
namespace {

// Of the surface at scale 1. The volume is by tanh-sinh quadrature of the areas of its slices in
// polar coordinates. Along u it reaches farthest at w = 0, where f = f_v = 0 there; along v from
// -t, t the tribonacci constant (t^3 = t^2 + t + 1), to 1, as f = (u^2 + 3w^2 - 2)^2 on the plane v
// = 1.
constexpr double kVolume = 5.991015316974869;
constexpr double kHalfWidth = 1.6109966778660;
constexpr double kLowest = 1.8392867552141612;

class GenusSurface final : public ImplicitSurface {
 public:
  [[nodiscard]] Derivatives derivatives(const Vec3& p) const override {
    const auto [x, y, z] = p;
    const double c = 1.0 - z * z;
    const double cubic = 2.0 * y * (y * y - 3.0 * x * x);
    const double cubic_x = -12.0 * x * y;
    const double cubic_y = 6.0 * (y * y - x * x);
    const double r2 = x * x + y * y;
    const double beyond = std::min(0.0, c);
    const double b2 = GenusModel::kBeyond * beyond * beyond;
    Derivatives d;
    d.value = cubic * c + r2 * r2 - (9.0 * z * z - 1.0) * c + b2 * beyond * beyond;
    d.gradient = {cubic_x * c + 4.0 * r2 * x, cubic_y * c + 4.0 * r2 * y,
                  2.0 * z * (9.0 * z * z - 1.0 - 9.0 * c - cubic) - 8.0 * z * b2 * beyond};
    d.diagonal = {-12.0 * y * c + 4.0 * r2 + 8.0 * x * x, 12.0 * y * c + 4.0 * r2 + 8.0 * y * y,
                  -2.0 * cubic - 20.0 + 108.0 * z * z + 8.0 * b2 * (6.0 * z * z - beyond)};
    d.mixed = {-2.0 * z * cubic_y, -2.0 * z * cubic_x, -12.0 * x * c + 8.0 * x * y};
    return d;
  }
};

PointCloud make_cloud() {
  constexpr double kSpacing = 0.06;
  constexpr double kReach = 1.9;
  constexpr double kHeight = 1.05;
  const GenusSurface surface;
  std::vector<Vec3> points;
  for (double z = -kHeight; z < kHeight; z += kSpacing) {
    for (double y = -kReach; y < kReach; y += kSpacing) {
      for (double x = -kReach; x < kReach; x += kSpacing) {
        const Vec3 p{x, y, z};
        const auto d = surface.derivatives(p);
        if (std::abs(d.value) > 2.0 * kSpacing * length(d.gradient)) {
          continue;
        }
        const Vec3 q = project(surface, p, kReach);
        const bool on_surface = std::abs(surface.derivatives(q).value) < 1e-9;
        if (on_surface && length(plus(p, -1.0, q)) < kSpacing) {
          points.push_back(q);
        }
      }
    }
  }
  return {std::move(points), 2.0 * kSpacing};
}

}  // namespace

Vec3 GenusModel::gradient(const Vec3& u) const {
  const Vec3 p = plus({}, 1.0 / scale_, u);
  return plus({}, 1.0 / scale_, GenusSurface().derivatives(p).gradient);
}

double GenusModel::distance(const Vec3& u) const {
  std::call_once(once_, [&] {
    const DefaultFloatEnvironment environment;
    cloud_ = std::make_unique<const PointCloud>(make_cloud());
  });
  constexpr double kSize = 3.6;
  const Vec3 p = plus({}, 1.0 / scale_, u);
  const double far = std::abs(cloud_->nearest(GenusSurface(), p, kSize).offset);
  return scale_ * (value(u) < 0.0 ? -far : far);
}

// The corners of the box around the shape at rest.
Extent GenusModel::extent(const Vec3& direction) const {
  const double sides = kHalfWidth * std::abs(direction[0]) + std::abs(direction[2]);
  const double up = direction[1] > 0.0 ? direction[1] : -kLowest * direction[1];
  const double down = direction[1] > 0.0 ? kLowest * direction[1] : -direction[1];
  return {scale_ * (sides + down), scale_ * (sides + up)};
}

std::optional<double> GenusModel::volume() const {
  return kVolume * scale_ * scale_ * scale_;
}

}  // namespace difmesh::detail
