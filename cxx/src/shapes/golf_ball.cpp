#include "shapes/golf_ball.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/position_text.hpp"
#include "difmesh/error.hpp"
#include "shapes/ball_overlap.hpp"

namespace difmesh::detail {
namespace {

std::vector<Vec3> fibonacci_lattice(std::int64_t count) {
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (std::int64_t i = 0; i < count; ++i) {
    const double w = 1.0 - static_cast<double>(2 * i + 1) / static_cast<double>(count);
    const double across = std::sqrt(1.0 - w * w);
    const double angle = turn * static_cast<double>(i);
    directions.push_back({across * std::cos(angle), across * std::sin(angle), w});
  }
  return directions;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

double least_angle(const std::vector<Vec3>& directions) {
  double most = -1.0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      most = std::max(most, dot(directions[i], directions[j]));
    }
  }
  return std::acos(std::min(most, 1.0));
}

double cap_volume(double radius, double height) {
  return std::numbers::pi * height * height * (radius - height / 3.0);
}

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, "golf ball: " + message);
}

void check(const ShapeOptions& options, double sag) {
  const double rim = options.dimple_radius;
  if (options.dimples < 1 || options.dimples > 5000) {
    fail("dimples is " + std::to_string(options.dimples) + "; 1 to 5000 are possible");
  }
  if (!(rim > 0.0 && rim <= 0.5)) {
    fail("dimple_radius is " + rounded_text(rim) + "; it must be greater than 0 and at most 0.5");
  }
  if (!(options.dimple_depth > sag && options.dimple_depth <= sag + rim)) {
    fail("dimple_depth is " + rounded_text(options.dimple_depth) + "; with a dimple_radius of " +
         rounded_text(rim) + " it must be greater than " + rounded_text(sag) + " and at most " +
         rounded_text(sag + rim));
  }
}

}  // namespace

DirectionIndex::DirectionIndex(std::vector<Vec3> directions) : directions_(std::move(directions)) {
  constexpr double kMostSide = 20.0;
  side_ = static_cast<std::size_t>(std::clamp(
      std::ceil(std::sqrt(static_cast<double>(directions_.size()) / 6.0)), 1.0, kMostSide));
  std::vector<double> angles(directions_.size());
  for (std::size_t bin = 0; bin < 6 * side_ * side_; ++bin) {
    first_.push_back(static_cast<std::uint32_t>(candidates_.size()));
    const Vec3 middle = place_in_bin(bin, 0.5, 0.5);
    double reach = 0.0;
    for (const double a : {0.0, 1.0}) {
      reach = std::max(reach, angle_between(middle, place_in_bin(bin, a, 0.0)));
      reach = std::max(reach, angle_between(middle, place_in_bin(bin, a, 1.0)));
    }
    for (std::size_t i = 0; i < angles.size(); ++i) {
      angles[i] = angle_between(middle, directions_[i]);
    }
    // What is nearest to any point of the bin is at most twice its reach farther from its middle
    // than what is nearest to that.
    constexpr double kSlack = 1e-6;
    const double farthest = *std::min_element(angles.begin(), angles.end()) + 2.0 * reach + kSlack;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (angles[i] <= farthest) {
        candidates_.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  first_.push_back(static_cast<std::uint32_t>(candidates_.size()));
}

std::size_t DirectionIndex::bin_of(const Vec3& u) const {
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a) {
    axis = std::abs(u[a]) > std::abs(u[axis]) ? a : axis;
  }
  const double scale = u[axis] == 0.0 ? 0.0 : 0.5 / std::abs(u[axis]);
  const auto index = [&](double v) {
    const double share = (0.5 + scale * v) * static_cast<double>(side_);
    return std::min(side_ - 1, static_cast<std::size_t>(std::max(0.0, share)));
  };
  const std::size_t face = 2 * axis + (u[axis] < 0.0 ? 1 : 0);
  return (face * side_ + index(u[(axis + 1) % 3])) * side_ + index(u[(axis + 2) % 3]);
}

// The unit vector to a place in a bin, a and b in [0,1].
Vec3 DirectionIndex::place_in_bin(std::size_t bin, double a, double b) const {
  const std::size_t face = bin / (side_ * side_);
  const auto coordinate = [&](std::size_t index, double share) {
    return 2.0 * (static_cast<double>(index) + share) / static_cast<double>(side_) - 1.0;
  };
  Vec3 u;
  u[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
  u[(face / 2 + 1) % 3] = coordinate(bin / side_ % side_, a);
  u[(face / 2 + 2) % 3] = coordinate(bin % side_, b);
  return plus({}, 1.0 / length(u), u);
}

const Vec3& DirectionIndex::nearest(const Vec3& u) const {
  const std::size_t bin = bin_of(u);
  std::uint32_t best = candidates_[first_[bin]];
  double most = dot(directions_[best], u);
  for (std::uint32_t i = first_[bin] + 1; i < first_[bin + 1]; ++i) {
    const double cosine = dot(directions_[candidates_[i]], u);
    if (cosine > most) {
      most = cosine;
      best = candidates_[i];
    }
  }
  return directions_[best];
}

// In units of R: with the rim's plane at height h = 1 - sag and the dimple's bottom k below it, the
// ball taken away has its centre e above the plane, where e^2 + rim^2 = (e + k)^2.
GolfBallModel::GolfBallModel(const ShapeOptions& options) : radius_(options.radius) {
  const double rim = options.dimple_radius;
  const double height = rim < 1.0 ? std::sqrt(1.0 - rim * rim) : 0.0;
  const double sag = rim * rim / (1.0 + height);
  check(options, sag);
  const double below = options.dimple_depth - sag;
  const double above = (rim - below) * (rim + below) / (2.0 * below);
  const double ball = above + below;
  const double centre = height + above;
  dimples_ = DirectionIndex(fibonacci_lattice(options.dimples));
  // Seen from the middle, a dimple may be wider below its rim.
  const bool wider = centre * centre - ball * ball < centre * height;
  const double half_angle = wider ? std::asin(ball / centre) : std::asin(rim);
  const double separation = least_angle(dimples_.directions());
  if (options.dimples > 1 && 2.0 * half_angle > separation) {
    fail("dimples of radius " + rounded_text(rim) + " and depth " +
         rounded_text(options.dimple_depth) + " meet: each takes up an angle of " +
         rounded_text(2.0 * half_angle) + ", but with " + std::to_string(options.dimples) +
         " of them the closest axes are only " + rounded_text(separation) + " apart");
  }
  rim_radius_ = rim * radius_;
  rim_height_ = height * radius_;
  dimple_radius_ = ball * radius_;
  dimple_centre_ = centre * radius_;
}

double GolfBallModel::value(const Vec3& u) const {
  const double hole = dimple_radius_ - length(plus(u, -dimple_centre_, dimples_.nearest(u)));
  return std::max(length(u) - radius_, hole);
}

Vec3 GolfBallModel::gradient(const Vec3& u) const {
  const Vec3 offset = plus(u, -dimple_centre_, dimples_.nearest(u));
  const double from_centre = length(offset);
  const double from_middle = length(u);
  if (dimple_radius_ - from_centre > from_middle - radius_) {
    return plus({}, from_centre > 0.0 ? -1.0 / from_centre : 0.0, offset);
  }
  return plus({}, from_middle > 0.0 ? 1.0 / from_middle : 0.0, u);
}

// Inside, the solid's complement is a union, so f is exact. Outside, the nearest point is on the
// ball, or on the dimple if the foot on its ball is one on its cap, or else on the rim.
double GolfBallModel::distance(const Vec3& u) const {
  const double f = value(u);
  const double from_middle = length(u);
  const Vec3& axis = dimples_.nearest(u);
  const double height = dot(u, axis);
  if (f <= 0.0 || (from_middle >= radius_ && height * radius_ <= rim_height_ * from_middle)) {
    return f <= 0.0 ? f : from_middle - radius_;
  }
  const Vec3 centre = plus({}, dimple_centre_, axis);
  const Vec3 offset = plus(u, -1.0, centre);
  const double from_centre = length(offset);
  if (from_centre > 0.0 && from_centre < dimple_radius_) {
    const Vec3 foot = plus(centre, dimple_radius_ / from_centre, offset);
    if (dot(foot, axis) <= rim_height_) {
      return dimple_radius_ - from_centre;
    }
  }
  const double across = length(plus(u, -height, axis));
  return std::hypot(across - rim_radius_, height - rim_height_);
}

std::optional<double> GolfBallModel::volume() const {
  const double lens = cap_volume(radius_, radius_ - rim_height_) +
                      cap_volume(dimple_radius_, dimple_radius_ - (dimple_centre_ - rim_height_));
  return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_ -
         static_cast<double>(dimples_.directions().size()) * lens;
}

bool GolfBallModel::rim_within(const Vec3& u, double reach) const {
  const double square = dot(u, u);
  if (std::abs(std::sqrt(square) - radius_) > reach) {
    return false;  // rims are on the sphere
  }
  const auto& axes = dimples_.directions();
  return std::any_of(axes.begin(), axes.end(), [&](const Vec3& axis) {
    const double height = dot(u, axis);
    const double across = std::sqrt(std::max(0.0, square - height * height));
    return std::hypot(across - rim_radius_, height - rim_height_) <= reach;
  });
}

std::optional<double> GolfBallModel::known_fraction(const Frame& frame, const Vec3& low,
                                                    const Vec3& size) const {
  const Vec3 high = plus(low, 1.0, size);
  const Vec3 u = frame.to_local(plus(low, 0.5, size));
  constexpr double kRounding = 1e-9;
  const double reach = (0.5 + kRounding) * length(size);
  if (!rim_within(u, reach)) {
    return std::nullopt;
  }
  std::array<Ball, 2> balls{{{frame.centre(), radius_}, {{}, dimple_radius_}}};
  double volume = ball_overlap(low, high, {balls.data(), 1});
  for (const Vec3& axis : dimples_.directions()) {
    const Vec3 centre = plus({}, dimple_centre_, axis);
    if (length(plus(u, -1.0, centre)) < dimple_radius_ + reach) {
      balls[1].centre = frame.to_space(centre);
      volume -= ball_overlap(low, high, balls);
    }
  }
  return volume / (size[0] * size[1] * size[2]);
}

}  // namespace difmesh::detail
