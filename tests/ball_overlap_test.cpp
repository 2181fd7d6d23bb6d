#include "shapes/ball_overlap.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "difmesh/fractions_from_function.hpp"
#include "support/sphere_overlap.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::Vec3;
using difmesh::detail::Ball;
using difmesh::detail::ball_overlap;
using namespace difmesh::test;

#ifdef DIFMESH_SANITIZED
constexpr int kTrials = 200;
#else
constexpr int kTrials = 2000;
#endif

/// A box of about size 1 near a point.
Box box_near(Random& random, const Vec3& point) {
  Box box;
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = point[a] - random.uniform(0.0, 1.0);
    box.high[a] = box.low[a] + random.uniform(0.3, 1.0);
  }
  return box;
}

double volume_of(const Box& box) {
  const Vec3 size = subtract(box.high, box.low);
  return size[0] * size[1] * size[2];
}

/// Two spheres that meet at right angles or so, and a point of the circle in which they do.
struct Lens {
  std::array<Ball, 2> balls;
  Vec3 middle{};  ///< of that circle
  Vec3 on_rim{};
};

Lens random_lens(Random& random, double radius) {
  Lens lens;
  const Vec3 axis = random.direction();
  Vec3 across = random.direction();
  across = unit(subtract(across, scaled(axis, dot(across, axis))));
  const double rim = radius * random.uniform(0.1, 0.7);
  const double first = std::sqrt(radius * radius - rim * rim);
  const double second = rim * random.uniform(-0.5, 4.0);
  const Vec3 middle = scaled(random.direction(), 3.0);
  lens.middle = middle;
  lens.balls[0] = {subtract(middle, scaled(axis, first)), radius};
  lens.balls[1] = {add(middle, scaled(axis, second)), std::hypot(rim, second)};
  lens.on_rim = add(middle, scaled(across, rim));
  return lens;
}

}  // namespace

TEST_CASE("overlap of a box and one ball is that of the closed form") {
  Random random(31);
  double worst = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double radius = std::exp(random.uniform(-1.5, 5.0));
    const Vec3 centre = scaled(random.direction(), 2.0);
    const Vec3 on_sphere = add(centre, scaled(random.direction(), radius));
    const Box box = box_near(random, on_sphere);
    const std::array<Ball, 1> ball{{{centre, radius}}};
    const double found = ball_overlap(box.low, box.high, ball) / volume_of(box);
    worst = std::max(worst, std::abs(found - sphere_overlap({centre, radius}, box)));
  }
  MESSAGE("largest difference: " << worst);
  CHECK(worst < 2e-11);
}

TEST_CASE("a box round two balls holds their lens") {
  Random random(32);
  double worst = 0.0;
  for (int trial = 0; trial < kTrials / 20; ++trial) {
    const Lens lens = random_lens(random, 1.0);
    const auto& [a, b] = lens.balls;
    const double apart = length(subtract(b.centre, a.centre));
    const double r = a.radius;
    const double s = b.radius;
    // Caps of both, over the plane of the rim.
    const double exact = std::numbers::pi * (r + s - apart) * (r + s - apart) *
                         (apart * apart + 2 * apart * (r + s) - 3 * (r - s) * (r - s)) /
                         (12 * apart);
    const Vec3 reach{2, 2, 2};
    const Box box{subtract(lens.middle, reach), add(lens.middle, reach)};
    worst = std::max(worst, std::abs(ball_overlap(box.low, box.high, lens.balls) - exact));
  }
  MESSAGE("largest difference: " << worst);
  CHECK(worst < 1e-9);  // of a box of 64
}

TEST_CASE("overlaps of parts of a box add up and turn with the axes") {
  Random random(33);
  double worst_sum = 0.0;
  double worst_turn = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Lens lens = random_lens(random, std::exp(random.uniform(-0.5, 5.0)));
    const Box box = box_near(random, lens.on_rim);
    const double whole = ball_overlap(box.low, box.high, lens.balls);
    const double volume = volume_of(box);
    REQUIRE(whole >= -1e-12 * volume);
    REQUIRE(whole <= (1.0 + 1e-12) * volume);
    double sum = 0.0;
    for (unsigned part = 0; part < 8; ++part) {
      Box half = box;
      for (std::size_t a = 0; a < 3; ++a) {
        const double middle = box.low[a] + 0.37 * (box.high[a] - box.low[a]);
        ((part >> a & 1U) != 0 ? half.low : half.high)[a] = middle;
      }
      sum += ball_overlap(half.low, half.high, lens.balls);
    }
    worst_sum = std::max(worst_sum, std::abs(sum - whole) / volume);
    // Slices across another axis are another computation.
    const auto turned = [](const Vec3& p) { return Vec3{p[1], p[2], p[0]}; };
    const auto& [a, b] = lens.balls;
    const std::array<Ball, 2> balls{{{turned(b.centre), b.radius}, {turned(a.centre), a.radius}}};
    const double other = ball_overlap(turned(box.low), turned(box.high), balls);
    worst_turn = std::max(worst_turn, std::abs(other - whole) / volume);
  }
  MESSAGE("largest differences: " << worst_sum << ", " << worst_turn);
  CHECK(worst_sum < 2e-11);
  CHECK(worst_turn < 2e-11);
}

TEST_CASE("overlaps on faces and edges and corners of the box") {
  // The rim touches, or lies in, a face; axes are parallel to the box's.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 apart{0, 0, 0};
    apart[axis] = 1.0;
    const std::array<Ball, 2> balls{{{{0, 0, 0}, 1.0}, {apart, 1.0}}};
    const double lens = std::numbers::pi * 5.0 / 12.0;
    Vec3 low{-2, -2, -2};
    CHECK(ball_overlap(low, {2, 2, 2}, balls) == doctest::Approx(lens).epsilon(1e-12));
    low[axis] = 0.5;
    CHECK(ball_overlap(low, {2, 2, 2}, balls) == doctest::Approx(lens / 2).epsilon(1e-12));
    const double rim = std::sqrt(0.75);
    const std::size_t other = (axis + 1) % 3;
    low[other] = 0.0;
    CHECK(ball_overlap(low, {2, 2, 2}, balls) == doctest::Approx(lens / 4).epsilon(1e-12));
    low[other] = rim;
    CHECK(std::abs(ball_overlap(low, {2, 2, 2}, balls)) < 1e-12);
    low[other] = -rim;
    CHECK(ball_overlap(low, {2, 2, 2}, balls) == doctest::Approx(lens / 2).epsilon(1e-12));
  }
  const std::array<Ball, 1> ball{{{{0, 0, 0}, 1.0}}};
  const double eighth = std::numbers::pi / 6.0;
  CHECK(ball_overlap({0, 0, 0}, {1, 1, 1}, ball) == doctest::Approx(eighth).epsilon(1e-12));
  CHECK(ball_overlap({0, 0, 0}, {0.5, 0.5, 0.5}, ball) == doctest::Approx(0.125).epsilon(1e-13));
  CHECK(ball_overlap({1, 1, 1}, {2, 2, 2}, ball) == 0.0);
}
