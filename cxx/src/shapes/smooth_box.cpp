#include "shapes/smooth_box.hpp"

#include <cstdint>
#include <limits>

namespace difmesh::detail {
namespace {

constexpr std::int64_t kRows = 25;

// Place of the point (i,j) of a triangle of rows.
std::size_t place(std::int64_t i, std::int64_t j) {
  return static_cast<std::size_t>(j * kRows - j * (j - 1) / 2 + i);
}

// sum |x_i / a_i|^p - 1.
class BoxSurface final : public ImplicitSurface {
 public:
  BoxSurface(const Vec3& axes, double exponent) : axes_(axes), exponent_(exponent) {}
  [[nodiscard]] Derivatives derivatives(const Vec3& x) const override {
    Derivatives d{.value = -1.0};
    for (std::size_t a = 0; a < 3; ++a) {
      const double t = std::abs(x[a]) / axes_[a];
      const double second = std::pow(t, exponent_ - 2.0);
      d.value += second * t * t;
      d.gradient[a] = std::copysign(exponent_ * second * t / axes_[a], x[a]);
      d.diagonal[a] = exponent_ * (exponent_ - 1.0) * second / (axes_[a] * axes_[a]);
    }
    return d;
  }

 private:
  Vec3 axes_;
  double exponent_;
};

}  // namespace

SmoothBoxModel::SmoothBoxModel(const Vec3& semi_axes, double exponent)
    : axes_(semi_axes),
      exponent_(exponent),
      whole_(exponent == std::floor(exponent) ? static_cast<int>(exponent) : 0),
      least_(std::min({semi_axes[0], semi_axes[1], semi_axes[2]})) {
  constexpr double kSteps = static_cast<double>(kRows - 1);
  for (std::int64_t j = 0; j < kRows; ++j) {
    for (std::int64_t i = 0; i < kRows - j; ++i) {
      const Vec3 t{static_cast<double>(i) / kSteps, static_cast<double>(j) / kSteps,
                   static_cast<double>(kRows - 1 - i - j) / kSteps};
      const Vec3 direction{axes_[0] * t[0], axes_[1] * t[1], axes_[2] * t[2]};
      starts_.push_back(plus({}, 1.0 / norm(direction), direction));
    }
  }
}

Vec3 SmoothBoxModel::gradient(const Vec3& u) const {
  const double all = norm(u);
  Vec3 g{};
  if (all == 0.0) {
    return g;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const double t = std::abs(u[a]) / axes_[a] / all;
    g[a] = std::copysign(least_ / axes_[a] * std::pow(t, exponent_ - 1.0), u[a]);
  }
  return g;
}

// By symmetry there is a nearest point in the octant of the query. Outside there is just one
// minimum, inside there may be several: all minima over a net of points are tried.
double SmoothBoxModel::distance(const Vec3& u) const {
  const Vec3 query{std::abs(u[0]), std::abs(u[1]), std::abs(u[2])};
  const BoxSurface surface(axes_, exponent_);
  const double size = 2.0 * length(axes_);
  std::vector<double> squared(starts_.size());
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    const Vec3 d = plus(starts_[i], -1.0, query);
    squared[i] = dot(d, d);
  }
  constexpr std::array<std::array<std::int64_t, 2>, 6> kNeighbours{
      {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
  Foot best{.squared_distance = std::numeric_limits<double>::infinity()};
  for (std::int64_t j = 0; j < kRows; ++j) {
    for (std::int64_t i = 0; i < kRows - j; ++i) {
      const bool least = std::all_of(kNeighbours.begin(), kNeighbours.end(), [&](const auto& step) {
        const std::int64_t ni = i + step[0];
        const std::int64_t nj = j + step[1];
        return ni < 0 || nj < 0 || ni + nj >= kRows ||
               squared[place(i, j)] <= squared[place(ni, nj)];
      });
      if (least) {
        const Foot foot = descend(surface, query, starts_[place(i, j)], size);
        best = foot.squared_distance < best.squared_distance ? foot : best;
      }
    }
  }
  return value(u) < 0.0 ? -std::abs(best.offset) : std::abs(best.offset);
}

// The dual norm.
Extent SmoothBoxModel::extent(const Vec3& direction) const {
  const double dual = exponent_ / (exponent_ - 1.0);
  double sum = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    sum += std::pow(axes_[a] * std::abs(direction[a]), dual);
  }
  const double reach = std::pow(sum, 1.0 / dual);
  return {reach, reach};
}

std::optional<double> SmoothBoxModel::volume() const {
  const double g = std::tgamma(1.0 + 1.0 / exponent_);
  return 8.0 * axes_[0] * axes_[1] * axes_[2] * g * g * g / std::tgamma(1.0 + 3.0 / exponent_);
}

}  // namespace difmesh::detail
