#include "sampling/box_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace difmesh::detail {
namespace {

// A circle with this slope and second derivative at 0 becomes vertical at this distance.
double reach_of_circle(double slope, double second) {
  const double stretch = std::sqrt(1.0 + slope * slope);
  const double radius = stretch * stretch * stretch / std::abs(second);
  const double reach = radius * (1.0 - std::abs(slope) / stretch);
  return reach == reach ? reach : std::numeric_limits<double>::infinity();
}

}  // namespace

// A level line of f as a height over x; `aspect` is the side of the box along the height over that
// along x, because circles are meant in space.
double BoxModel::Derivatives::reach(double aspect) const {
  const double slope = x / h;
  const double second = (xx - 2.0 * slope * xh + slope * slope * hh) / h;
  return reach_of_circle(aspect * slope, aspect * second);
}

BoxModel::BoxModel(const SampledBox& box, const GraphAxes& axes) {
  const std::array<std::size_t, 3> step{kSampleStep[axes.along], kSampleStep[axes.across],
                                        kSampleStep[axes.height]};
  for (std::size_t i = 0; i < 27; ++i) {
    sample_[i] = box.f[i % 3 * step[0] + i / 3 % 3 * step[1] + i / 9 * step[2]];
  }
  side_ = {box.size[axes.along], box.size[axes.across], box.size[axes.height]};
  coefficient_ = sample_;
  for (const std::size_t stride : kSampleStep) {
    for (std::size_t line = 0; line < 9; ++line) {
      const std::size_t start =
          stride == 1 ? 3 * line : (stride == 3 ? line % 3 + line / 3 * 9 : line);
      double& c0 = coefficient_[start];
      double& c1 = coefficient_[start + stride];
      double& c2 = coefficient_[start + 2 * stride];
      const double bend = c0 - 2.0 * c1 + c2;
      c1 = 2.0 * (c1 - c0) - bend;
      c2 = 2.0 * bend;
    }
  }
}

std::array<double, 9> BoxModel::slice(double along) const {
  std::array<double, 9> c;
  for (std::size_t i = 0; i < 9; ++i) {
    c[i] =
        coefficient_[3 * i] + along * (coefficient_[3 * i + 1] + along * coefficient_[3 * i + 2]);
  }
  return c;
}

// Of the model at the middle of a plane of samples, by central differences.
BoxModel::Derivatives BoxModel::derivatives(std::size_t centre, std::size_t x,
                                            std::size_t h) const {
  const double* v = sample_.data() + centre;
  const double *up = v + h, *down = v - h;
  return {.x = v[x] - *(v - x),
          .h = *up - *down,
          .xx = 4.0 * (v[x] - 2.0 * *v + *(v - x)),
          .xh = up[x] - down[x] - *(up - x) + *(down - x),
          .hh = 4.0 * (*up - 2.0 * *v + *down)};
}

double BoxModel::surface_reach(std::size_t direction) const {
  constexpr std::size_t kCentre = 13;
  return derivatives(kCentre, kSampleStep[direction], kSampleStep[2])
      .reach(side_[2] / side_[direction]);
}

double BoxModel::cut_reach(std::size_t face) const {
  const std::size_t centre = 4 + 2 * face * kSampleStep[2];
  return derivatives(centre, kSampleStep[0], kSampleStep[1]).reach(side_[1] / side_[0]);
}

ParabolaRoot parabola_root(double c0, double c1, double c2, bool rising) {
  const double sign = rising ? 1.0 : -1.0;
  c0 *= sign;
  c1 *= sign;
  c2 *= sign;
  const double slope = std::sqrt(std::max(0.0, c1 * c1 - 4.0 * c0 * c2));
  const double t = c1 >= 0.0 ? -2.0 * c0 / (c1 + slope) : (slope - c1) / (2.0 * c2);
  return {t, sign * slope};
}

}  // namespace difmesh::detail
