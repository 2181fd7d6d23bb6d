#include "shapes/ball_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sampling/gauss_legendre.hpp"
#include "shapes/shape_body.hpp"

namespace difmesh::detail {
namespace {

/// A few numbers strictly between two ends; others are dropped.
template <std::size_t capacity>
class Cuts {
 public:
  Cuts(double low, double high) : low_(low), high_(high) { values_[count_++] = low; }

  void add(double value) {
    // False for NaN as well.
    if (value > low_ && value < high_) {
      values_[count_++] = value;
    }
  }
  /// centre -+ root of the square, if there is one; twice the same where it is 0.
  void add_pair(double centre, double square) {
    if (square >= 0.0) {
      add(centre - std::sqrt(square));
      add(centre + std::sqrt(square));
    }
  }
  /// Ascending, both ends included.
  [[nodiscard]] std::span<const double> sorted() {
    values_[count_++] = high_;
    std::sort(values_.begin() + 1, values_.begin() + static_cast<std::ptrdiff_t>(count_) - 1);
    return {values_.data(), count_};
  }

 private:
  double low_;
  double high_;
  std::size_t count_ = 0;
  std::array<double, capacity + 2> values_;
};

struct Disc {
  double x = 0.0;
  double y = 0.0;
  double square = 0.0;  ///< of the radius

  /// Half the length of the chord at x; NaN outside.
  [[nodiscard]] double half_chord(double at) const {
    return std::sqrt(square - (at - x) * (at - x));
  }
  /// Integral of the half chord; from and to within the disc but for rounding.
  [[nodiscard]] double half_area(double from, double to) const {
    const double a = from - x;
    const double b = to - x;
    const double at_a = std::sqrt(std::max(0.0, square - a * a));
    const double at_b = std::sqrt(std::max(0.0, square - b * b));
    const double chord = (b - a) * (b - a) + (at_b - at_a) * (at_b - at_a);
    if (chord < square) {
      // A trapezium and the segment over the chord. In the form below, r^2 cancels.
      const double angle = 2.0 * std::asin(std::sqrt(0.25 * chord / square));
      return 0.5 * ((b - a) * (at_a + at_b) + square * less_sine(angle));
    }
    return 0.5 *
           (b * at_b - a * at_a + square * std::atan2(b * at_a - a * at_b, a * b + at_a * at_b));
  }

 private:
  /// angle - sin(angle), for angles of less than 1.1.
  static double less_sine(double angle) {
    const double u = angle * angle;
    double sum = 0.0;
    for (double n = 17.0; n > 2.0; n -= 2.0) {
      sum = (1.0 - sum) * u / (n * (n - 1.0));
    }
    return angle * sum;
  }
};

struct Rectangle {
  std::array<double, 2> x{};
  std::array<double, 2> y{};
};

using DiscCuts = Cuts<14>;

/// Where two circles meet.
void add_meeting(const Disc& a, const Disc& b, DiscCuts& cuts) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double along = 0.5 * (1.0 + (a.square - b.square) / square);
  cuts.add_pair(a.x + along * dx, (a.square / square - along * along) * dy * dy);
}

/// Area over [from, to] below the lowest of the upper arcs and sides and above the highest of the
/// lower ones; which these are does not change in between.
double strip_area(const Rectangle& rectangle, std::span<const Disc> discs, double from, double to) {
  const double middle = 0.5 * (from + to);
  const double length = to - from;
  double low = 0.0;
  double high = rectangle.y[1] - rectangle.y[0];
  double below_low = 0.0;
  double below_high = high * length;
  for (const Disc& disc : discs) {
    const double half = disc.half_chord(middle);
    if (!(half > 0.0)) {
      return 0.0;
    }
    const double centre = disc.y - rectangle.y[0];
    if (centre + half < high) {
      high = centre + half;
      below_high = centre * length + disc.half_area(from, to);
    }
    if (centre - half > low) {
      low = centre - half;
      below_low = centre * length - disc.half_area(from, to);
    }
  }
  return high > low ? below_high - below_low : 0.0;
}

double slice_area(const Rectangle& rectangle, std::span<const Disc> discs) {
  DiscCuts cuts(rectangle.x[0], rectangle.x[1]);
  for (const Disc& disc : discs) {
    cuts.add_pair(disc.x, disc.square);
    for (const double y : rectangle.y) {
      cuts.add_pair(disc.x, disc.square - (y - disc.y) * (y - disc.y));
    }
  }
  if (discs.size() == 2) {
    add_meeting(discs[0], discs[1], cuts);
  }
  const std::span<const double> x = cuts.sorted();
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    area += strip_area(rectangle, discs, x[i], x[i + 1]);
  }
  return area;
}

using SliceCuts = Cuts<48>;

/// Where a sphere begins, touches a face of the box, or meets an edge along z.
void add_sphere(const Ball& ball, const Rectangle& rectangle, SliceCuts& cuts) {
  const double z = ball.centre[2];
  const double square = ball.radius * ball.radius;
  cuts.add_pair(z, square);
  for (const double x : rectangle.x) {
    const double rest = square - (x - ball.centre[0]) * (x - ball.centre[0]);
    cuts.add_pair(z, rest);
    for (const double y : rectangle.y) {
      cuts.add_pair(z, rest - (y - ball.centre[1]) * (y - ball.centre[1]));
    }
  }
  for (const double y : rectangle.y) {
    cuts.add_pair(z, square - (y - ball.centre[1]) * (y - ball.centre[1]));
  }
}

/// Where the circle in which two spheres meet begins, or meets a face of the box.
void add_rim(const Ball& a, const Ball& b, const Rectangle& rectangle, SliceCuts& cuts) {
  const Vec3 offset = plus(b.centre, -1.0, a.centre);
  const double apart = length(offset);
  const double along = 0.5 * (apart + (a.radius - b.radius) * (a.radius + b.radius) / apart);
  const double square = a.radius * a.radius - along * along;
  const Vec3 n = plus({}, 1.0 / apart, offset);
  const Vec3 middle = plus(a.centre, along, n);
  cuts.add_pair(middle[2], square * (1.0 - n[2] * n[2]));
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    // In the circle's plane the face is a line at a distance from its centre.
    const double steepness = 1.0 - n[axis] * n[axis];
    for (const double face : axis == 0 ? rectangle.x : rectangle.y) {
      const double away = (face - middle[axis]) / steepness;
      const double rest = square - away * away * steepness;
      const double across = n[1 - axis];  // of the line's direction, its share along z
      cuts.add_pair(middle[2] - away * n[axis] * n[2], rest * across * across / steepness);
    }
  }
}

/// Integrates slices between two cuts, where the area is smooth but for powers 3/2 at the ends.
class SliceIntegral {
 public:
  SliceIntegral(const Rectangle& rectangle, double height, std::span<const Ball> balls)
      : rectangle_(rectangle),
        balls_(balls),
        box_((rectangle.x[1] - rectangle.x[0]) * (rectangle.y[1] - rectangle.y[0]) * height) {}

  [[nodiscard]] double between(double low, double high, int halvings = 0) const {
    // Of the box. The rule's error is a coefficient of twice the degree of those looked at.
    constexpr double kSmooth = 1e-10;
    constexpr int kMostHalvings = 12;
    const GaussRule& rule = gauss_rule(kMaxGaussNodes);
    const double length = high - low;
    std::array<double, kMaxGaussNodes> values;
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      // This turns powers 3/2 at the ends into polynomials.
      const double t = rule.node[i];
      values[i] = 6.0 * t * (1.0 - t) * area(low + length * t * t * (3.0 - 2.0 * t));
      sum += rule.weight[i] * values[i];
    }
    double top = 0.0;
    for (std::size_t degree = 0; degree < 2; ++degree) {
      double coefficient = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        coefficient += rule.top[degree][i] * values[i];
      }
      top = std::max(top, std::abs(coefficient));
    }
    if (top * length <= kSmooth * box_ || halvings == kMostHalvings) {
      return sum * length;
    }
    const double middle = 0.5 * (low + high);
    return between(low, middle, halvings + 1) + between(middle, high, halvings + 1);
  }

 private:
  [[nodiscard]] double area(double z) const {
    std::array<Disc, 2> discs;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const Ball& ball = balls_[i];
      const double dz = z - ball.centre[2];
      discs[i] = {ball.centre[0], ball.centre[1], (ball.radius - dz) * (ball.radius + dz)};
      if (!(discs[i].square > 0.0)) {
        return 0.0;
      }
    }
    return slice_area(rectangle_, {discs.data(), balls_.size()});
  }

  const Rectangle& rectangle_;
  std::span<const Ball> balls_;
  double box_;  // its volume
};

}  // namespace

double ball_overlap(const Vec3& low, const Vec3& high, std::span<const Ball> balls) {
  const Rectangle rectangle{{low[0], high[0]}, {low[1], high[1]}};
  SliceCuts cuts(low[2], high[2]);
  for (const Ball& ball : balls) {
    add_sphere(ball, rectangle, cuts);
  }
  if (balls.size() == 2) {
    add_rim(balls[0], balls[1], rectangle, cuts);
  }
  const SliceIntegral integral(rectangle, high[2] - low[2], balls);
  const std::span<const double> z = cuts.sorted();
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    if (z[i + 1] > z[i]) {
      volume += integral.between(z[i], z[i + 1]);
    }
  }
  return volume;
}

}  // namespace difmesh::detail
