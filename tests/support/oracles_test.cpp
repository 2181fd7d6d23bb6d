// The oracles themselves, before anything is judged by them.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "support/algorithm1.hpp"
#include "support/box_clip.hpp"
#include "support/dual_edges.hpp"
#include "support/fractions.hpp"
#include "support/shapes.hpp"
#include "support/sphere_overlap.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::Grid;
using difmesh::Index3;
using difmesh::Vec3;
using namespace difmesh::test;

double inside_volume(const std::vector<double>& fractions, const Grid& grid) {
  return grid.cell_volume() * std::accumulate(fractions.begin(), fractions.end(), 0.0);
}

long double cube(long double x) {
  return x > 0.0L ? x * x * x : 0.0L;
}

/// E19 eq. 11 with its last cube, for a cuboid of sides c and n > 0, alpha from the low corner.
long double eq11(const Vec3& n, const Vec3& c, long double alpha) {
  const long double whole = static_cast<long double>(n[0]) * c[0] +
                            static_cast<long double>(n[1]) * c[1] +
                            static_cast<long double>(n[2]) * c[2];
  long double sum = cube(alpha);
  long double divisor = 6.0L;
  for (std::size_t a = 0; a < 3; ++a) {
    const long double m = static_cast<long double>(n[a]) * c[a];
    sum += cube(alpha - whole + m) - cube(alpha - m);
    divisor *= m;
  }
  return (sum - cube(alpha - whole)) / divisor;
}

/// The edge between the cells [-1,0] and [0,1] along the axis, scaled, with the exact fractions and
/// planes of a half-space; `crossed` is where it meets the edge, from the outer cell's centre on.
CrossedEdge edge_of(const HalfSpace& half_space, const Vec3& spacing, std::size_t axis,
                    double& crossed) {
  std::array<double, 2> fractions{};
  std::array<difmesh::Plane, 2> planes{};
  for (std::size_t side = 0; side < 2; ++side) {
    Vec3 centre{0.0, 0.0, 0.0};
    centre[axis] = (side == 0 ? -0.5 : 0.5) * spacing[axis];
    planes[side] = {half_space.normal, half_space.level - dot(half_space.normal, centre)};
    fractions[side] =
        static_cast<double>(clipped_share(spacing, planes[side].normal, planes[side].offset));
  }
  const std::size_t outer = fractions[0] < fractions[1] ? 0 : 1;
  const double direction = outer == 0 ? 1.0 : -1.0;
  const double place = half_space.level / (half_space.normal[axis] * spacing[axis]);
  crossed = 0.5 + direction * place;
  return {spacing,       static_cast<int>(axis), direction, fractions[outer], fractions[1 - outer],
          planes[outer], planes[1 - outer]};
}

}  // namespace

TEST_CASE("box clip: known cuts of the cube") {
  const Vec3 ones{1.0, 1.0, 1.0};
  CHECK(static_cast<double>(clipped_share(ones, {1, 0, 0}, 0.25)) == doctest::Approx(0.75));
  CHECK(static_cast<double>(clipped_share(ones, {1, 1, 1}, -1.0)) == doctest::Approx(1.0 / 48.0));
  CHECK(static_cast<double>(clipped_share(ones, {1, 1, 1}, 0.0)) == doctest::Approx(0.5));
  CHECK(static_cast<double>(clipped_share(ones, {0, -1, 1}, -0.5)) == doctest::Approx(0.125));
  CHECK(clipped_share(ones, {1, 2, 3}, 3.0) == 1.0L);
  CHECK(clipped_share(ones, {1, 2, 3}, -3.1) == 0.0L);
  CHECK(static_cast<double>(clipped_share(Box{{1, 0, 0}, {3, 2, 4}}, {1, 0, 0}, 1.5)) ==
        doctest::Approx(0.25));
}

TEST_CASE("box clip: agrees with the cubes of E19 eq. 11") {
  Random random(11);
  const Vec3 spacing{1.0, 2.0, 5.0};
  for (int n = 0; n < 2000; ++n) {
    const Vec3 normal{random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), random.uniform(0.1, 1.0)};
    const double half = 0.5 * dot(normal, spacing);
    const double offset = random.uniform(-1.0, 1.0) * half;
    const long double expected =
        eq11(normal, spacing,
             offset + 0.5L * (static_cast<long double>(normal[0]) * spacing[0] +
                              static_cast<long double>(normal[1]) * spacing[1] +
                              static_cast<long double>(normal[2]) * spacing[2]));
    REQUIRE(static_cast<double>(std::abs(clipped_share(spacing, normal, offset) - expected)) <
            1e-15);
  }
}

TEST_CASE("shapes: gradients are those of the functions") {
  Random random(12);
  const auto check = [&](const auto& shape, double size) {
    for (int n = 0; n < 100; ++n) {
      const Vec3 p{random.uniform(-size, size), random.uniform(-size, size),
                   random.uniform(-size, size)};
      const Vec3 g = shape.gradient(p);
      for (std::size_t a = 0; a < 3; ++a) {
        const double h = 1e-4 * size;
        Vec3 low = p;
        Vec3 high = p;
        low[a] -= h;
        high[a] += h;
        const double difference = (shape.value(high) - shape.value(low)) / (2.0 * h);
        REQUIRE(std::abs(difference - g[a]) <= 1e-6 * (1.0 + length(g)));
      }
    }
  };
  check(Sphere{{0.1, 0.2, 0.3}, 1.5}, 2.0);
  check(Ellipsoid{{0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}}, 3.0);
  check(Genus{{0.1, 0.2, 0.3}, 2.0}, 3.0);
  check(HalfSpace{{1.0, 2.0, -3.0}, 0.4}, 3.0);
}

TEST_CASE("shapes: the closest point is on the surface and straight below") {
  Random random(13);
  const Ellipsoid ellipsoid{{0.1, 0.2, 0.3}, {3.0, 4.0, 5.0}};
  for (int n = 0; n < 200; ++n) {
    const Vec3 direction = random.direction();
    Vec3 foot = ellipsoid.centre;
    for (std::size_t a = 0; a < 3; ++a) {
      foot[a] += ellipsoid.half_axes[a] * direction[a];
    }
    const double height = random.uniform(-0.2, 0.2);
    const Vec3 p = add(foot, scaled(unit(ellipsoid.gradient(foot)), height));
    REQUIRE(length(subtract(closest_point(ellipsoid, p), foot)) < 1e-13);
    REQUIRE(std::abs(distance(ellipsoid, p) - std::abs(height)) < 1e-13);
  }
}

TEST_CASE("ball and box: halves and caps and corners") {
  const Sphere ball{{0, 0, 0}, 1.0};
  const double volume = 4.0 / 3.0 * std::numbers::pi;
  CHECK(64.0 * sphere_overlap(ball, {{-2, -2, -2}, {2, 2, 2}}) ==
        doctest::Approx(volume).epsilon(1e-15));
  CHECK(sphere_overlap(ball, {{0, 0, 0}, {1, 1, 1}}) == doctest::Approx(volume / 8).epsilon(1e-15));
  // A cap, cut off by each of the six planes.
  const double cap = std::numbers::pi * 0.3 * 0.3 * (3.0 - 0.3) / 3.0;
  for (std::size_t a = 0; a < 3; ++a) {
    Box box{{-2, -2, -2}, {2, 2, 2}};
    box.low[a] = 0.7;
    CHECK(16.0 * 1.3 * sphere_overlap(ball, box) == doctest::Approx(cap).epsilon(1e-14));
    box.low[a] = -2.0;
    box.high[a] = -0.7;
    CHECK(16.0 * 1.3 * sphere_overlap(ball, box) == doctest::Approx(cap).epsilon(1e-14));
  }
  // The corner opposite the centre is just on the sphere.
  const double side = 1.0 / std::sqrt(3.0);
  CHECK(sphere_overlap(ball, {{0, 0, 0}, {side, side, side}}) == doctest::Approx(1.0));
}

TEST_CASE("fractions: the quadrature agrees with the closed form of ball and box") {
  const Sphere sphere{{0.123, -0.37, 0.71}, 8.0};
  for (const Vec3& spacing : {Vec3{1.0, 1.0, 1.0}, Vec3{0.5, 1.0, 2.5}}) {
    Grid grid;
    for (std::size_t a = 0; a < 3; ++a) {
      grid.dims[a] = static_cast<std::int64_t>(20.0 / spacing[a]);
      grid.spacing[a] = spacing[a];
      grid.origin[a] = -10.0;
    }
    const std::vector<double> fractions = cell_fractions(sphere, grid);
    double worst = 0.0;
    for (std::int64_t k = 0; k < grid.dims[2]; ++k) {
      for (std::int64_t j = 0; j < grid.dims[1]; ++j) {
        for (std::int64_t i = 0; i < grid.dims[0]; ++i) {
          const double exact = sphere_overlap(sphere, cell_box(grid, {i, j, k}, {1, 1, 1}));
          worst = std::max(worst, std::abs(fractions[element({i, j, k}, grid.dims)] - exact));
        }
      }
    }
    CHECK(worst < 1e-10);
    const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(sphere.radius, 3.0);
    CHECK(inside_volume(fractions, grid) == doctest::Approx(ball).epsilon(1e-12));
  }
}

TEST_CASE("fractions: the volume of a shape does not depend on the grid") {
  const auto volume_on = [](const auto& shape, const Vec3& half_size, std::int64_t cells) {
    Grid grid;
    for (std::size_t a = 0; a < 3; ++a) {
      grid.dims[a] = cells + static_cast<std::int64_t>(a);
      grid.spacing[a] = 2.0 * half_size[a] / static_cast<double>(grid.dims[a]);
      grid.origin[a] = -half_size[a];
    }
    return inside_volume(cell_fractions(shape, grid), grid);
  };
  const Ellipsoid ellipsoid{{0.01, 0.02, 0.03}, {1.0, 2.0, 1.5}};
  const double whole = 4.0 / 3.0 * std::numbers::pi * 3.0;
  CHECK(volume_on(ellipsoid, {2.1, 2.1, 2.1}, 19) == doctest::Approx(whole).epsilon(1e-11));
  const Genus genus{{0.01, 0.02, 0.03}, 1.0};
  const double coarse = volume_on(genus, {2.0, 2.0, 1.2}, 24);
  CHECK(volume_on(genus, {2.0, 2.0, 1.2}, 37) == doctest::Approx(coarse).epsilon(1e-8));
  CHECK(coarse > 1.0);
}

TEST_CASE("algorithm 1: a half-space is met exactly from every start") {
  Random random(14);
  int crossed_edges = 0;
  for (int n = 0; n < 1000; ++n) {
    const Vec3 spacing = n % 2 == 0 ? Vec3{1.0, 1.0, 1.0} : Vec3{1.0, 2.0, 5.0};
    const HalfSpace half_space{random.direction(), random.uniform(-1.0, 1.0)};
    double crossed = 0.0;
    const CrossedEdge edge = edge_of(half_space, spacing, static_cast<std::size_t>(n % 3), crossed);
    if (!(edge.outer_fraction < 0.5 && edge.inner_fraction >= 0.5)) {
      continue;
    }
    ++crossed_edges;
    REQUIRE(window_fraction(edge, 0.0) == doctest::Approx(edge.outer_fraction).epsilon(1e-14));
    REQUIRE(window_fraction(edge, 1.0) == doctest::Approx(edge.inner_fraction).epsilon(1e-14));
    for (const Guess guess : {Guess::mid_edge, Guess::linear, Guess::manson}) {
      const auto found =
          algorithm1(edge, initial_guess(guess, edge.outer_fraction, edge.inner_fraction));
      REQUIRE(found.converged);
      REQUIRE(std::abs(found.mu - crossed) < 1e-12);
    }
  }
  CHECK(crossed_edges > 200);
}

TEST_CASE("algorithm 1: Manson's guess is exact for lines in two dimensions") {
  Random random(15);
  int crossed_edges = 0;
  for (int n = 0; n < 1000; ++n) {
    const double slope = random.uniform(-3.0, 3.0);
    const HalfSpace half_space{unit({1.0, slope, 0.0}), random.uniform(-0.6, 0.6)};
    double crossed = 0.0;
    const CrossedEdge edge = edge_of(half_space, {1.0, 1.0, 1.0}, 0, crossed);
    if (!(edge.outer_fraction < 0.5 && edge.inner_fraction >= 0.5)) {
      continue;
    }
    // Closer to the edge than 45 degrees, a line can leave the two cells by their far sides and one
    // of them pure. Then the pair of fractions does not tell the line.
    const bool both_cut = edge.outer_fraction > 0.0 && edge.inner_fraction < 1.0;
    if (std::abs(slope) > 1.0 && !both_cut) {
      continue;
    }
    ++crossed_edges;
    CAPTURE(edge.outer_fraction);
    CAPTURE(edge.inner_fraction);
    const double mu = initial_guess(Guess::manson, edge.outer_fraction, edge.inner_fraction);
    CHECK(std::abs(mu - crossed) < 1e-9);
  }
  CHECK(crossed_edges > 200);
}

TEST_CASE("dual edges: a name holds the lower node and the axis") {
  const Index3 dims{5, 7, 9};
  const auto name = [&](std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t axis) {
    return static_cast<std::uint64_t>(3 * (((k + 1) * 9 + (j + 1)) * 7 + (i + 1)) + axis);
  };
  CHECK(dual_edge(name(-1, 7, 3, 2), dims).node == Index3{-1, 7, 3});
  CHECK(dual_edge(name(-1, 7, 3, 2), dims).axis == 2);
  CHECK(dual_edge(name(4, 0, 8, 1), dims).upper() == Index3{4, 1, 8});
}
