#include "difmesh/fractions_from_function.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "difmesh/shapes.hpp"
#include "support/function_field.hpp"
#include "support/sphere_overlap.hpp"

using difmesh::batch_of;
using difmesh::fractions_from_function;
using difmesh::FractionsFromFunction;
using difmesh::FractionsFromFunctionOptions;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::Vec3;
using namespace difmesh::test;

namespace {

#ifdef DIFMESH_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

constexpr double kPi = std::numbers::pi;

Vec3 low_corner(const Grid& grid, const Index3& cell) {
  Vec3 low;
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = grid.origin[a] + static_cast<double>(cell[a]) * grid.spacing[a];
  }
  return low;
}

Vec3 plus(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

// A grid around a ball at about 0.
Grid grid_around(double radius, const Vec3& spacing) {
  Grid grid;
  grid.spacing = spacing;
  for (std::size_t a = 0; a < 3; ++a) {
    grid.dims[a] = static_cast<std::int64_t>(std::ceil(2.0 * radius / spacing[a])) + 3;
    grid.origin[a] = -0.5 * static_cast<double>(grid.dims[a]) * spacing[a];
  }
  return grid;
}

// The largest difference from the closed form over all cells.
double worst_sphere_error(const Grid& grid, const FractionsFromFunction& result, const Vec3& centre,
                          double radius) {
  double worst = 0.0;
  const double half_diagonal = 0.5 * distance_between(grid.spacing, {0.0, 0.0, 0.0});
  for_cells(grid, [&](const Index3& cell, std::size_t index) {
    const double r = distance_between(grid.cell_centre(cell), centre);
    double exact = r < radius ? 1.0 : 0.0;
    if (std::abs(r - radius) < 1.001 * half_diagonal) {
      const Vec3 low = low_corner(grid, cell);
      exact = sphere_overlap({centre, radius}, {low, plus(low, grid.spacing)});
    }
    worst = std::max(worst, std::abs(result.fractions[index] - exact));
  });
  return worst;
}

double relative_error(double value, double exact) {
  return std::abs(value / exact - 1.0);
}

}  // namespace

TEST_CASE("every cell of a sphere is exact") {
  const Vec3 centre{0.137, -0.291, 0.0713};
  const std::vector<double> radii =
      kSanitized ? std::vector<double>{3.2, 8.0} : std::vector<double>{3.2, 5.7, 16.0, 64.0};
  for (const double radius : radii) {
    for (const Vec3& spacing : {Vec3{1, 1, 1}, Vec3{1, 2, 5}, Vec3{5, 1, 2}}) {
      for (const bool by_distance : {false, true}) {
        CAPTURE(radius);
        CAPTURE(spacing[2]);
        CAPTURE(by_distance);
        const Grid grid = grid_around(radius, spacing);
        const auto f =
            by_distance ? sphere_by_distance(centre, radius) : sphere_by_square(centre, radius);
        const auto result = fractions_from_function(grid, f);
        CHECK(worst_sphere_error(grid, result, centre, radius) < 2e-10);
        const double volume = 4.0 / 3.0 * kPi * radius * radius * radius;
        CHECK(relative_error(result.report.fraction_volume, volume) < 1e-10);
        CHECK(result.report.unresolved_cells == 0);
        CHECK(result.report.interfacial_cells <= result.report.sampled_cells);
        // VOFI 2.0 takes some 465. In the flattest cells the distance's tip is next to the surface.
        if (!by_distance || radius > 5.0) {
          CHECK(result.report.calls_per_interfacial_cell < 465.0);
        }
        if (radius >= 16.0) {
          CHECK(result.report.calls_per_interfacial_cell < (by_distance ? 200.0 : 120.0));
        }
      }
    }
  }
}

TEST_CASE("spheres of random size and place with random spacings") {
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const int trials = kSanitized ? 10 : 60;
  for (int trial = 0; trial < trials; ++trial) {
    const double radius = std::exp(uniform(std::log(3.2), std::log(12.0)));
    const Vec3 spacing{1.0, std::exp(uniform(-0.7, 0.7)), std::exp(uniform(-0.7, 0.7))};
    const Vec3 centre{uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-0.5, 0.5)};
    CAPTURE(trial);
    const Grid grid = grid_around(radius, spacing);
    const auto result = fractions_from_function(grid, sphere_by_distance(centre, radius));
    CHECK(worst_sphere_error(grid, result, centre, radius) < 1e-9);
  }
}

TEST_CASE("totals of ellipsoid and torus at any attitude") {
  for (const std::int64_t cells : {16, 40}) {
    for (const Vec3& turn : {Vec3{0, 0, 0}, Vec3{20, 50, 130}}) {
      CAPTURE(cells);
      CAPTURE(turn[0]);
      difmesh::ShapeOptions shape{.centre = {0.013, 0.021, -0.017}, .rotation_degrees = turn};
      shape.kind = difmesh::ShapeKind::ellipsoid;
      shape.semi_axes = {1.0, 0.71, 0.43};
      const auto ellipsoid =
          fractions_from_function(cube_grid(cells, 1.2), difmesh::make_shape(shape).function());
      CHECK(relative_error(ellipsoid.report.fraction_volume, 4.0 / 3.0 * kPi * 0.71 * 0.43) <
            1e-10);
      shape.kind = difmesh::ShapeKind::torus;
      shape.radius = 0.7;
      shape.tube_radius = 0.31;
      const auto torus =
          fractions_from_function(cube_grid(cells, 1.2), difmesh::make_shape(shape).function());
      CHECK(relative_error(torus.report.fraction_volume, 2.0 * kPi * kPi * 0.7 * 0.31 * 0.31) <
            1e-10);
    }
  }
}

TEST_CASE("genus is converged") {
  const auto f = difmesh::make_shape({.kind = difmesh::ShapeKind::genus}).function();
  // By tanh-sinh quadrature in polar coordinates.
  constexpr double kExact = 5.991015316974869;
  double before = 0.0;
  for (const std::int64_t cells : {13, 24, 37}) {
    const auto result = fractions_from_function(cube_grid(cells, 2.0), f);
    const double volume = result.report.fraction_volume;
    MESSAGE("genus, " << cells << " cells across: relative error " << relative_error(volume, kExact)
                      << ", " << result.report.calls_per_interfacial_cell << " calls per cell");
    CHECK(relative_error(volume, kExact) < (cells == 13 ? 1e-8 : 1e-10));
    CHECK((before == 0.0 || relative_error(volume, before) < 1e-8));
    before = volume;
  }
}

TEST_CASE("a cube with faces off the grid has fractions that are products") {
  const Vec3 half{0.61, 0.53, 0.472};
  const Grid grid = cube_grid(16, 1.0);
  const auto result = fractions_from_function(grid, [&](const Vec3& p) {
    return std::max({std::abs(p[0]) - half[0], std::abs(p[1]) - half[1], std::abs(p[2]) - half[2]});
  });
  for_cells(grid, [&](const Index3& cell, std::size_t index) {
    const Vec3 low = low_corner(grid, cell);
    double exact = 1.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double to = std::min(low[a] + grid.spacing[a], half[a]);
      exact *= std::max(0.0, to - std::max(low[a], -half[a])) / grid.spacing[a];
    }
    CHECK(std::abs(result.fractions[index] - exact) < 1e-9);
  });
}

TEST_CASE("a ball cut by a plane keeps to the tolerance for kinks") {
  const Vec3 centre{0.013, 0.0271, -0.0171};
  const double radius = 0.8131;
  const double cut = 0.1234;
  const Grid grid = cube_grid(kSanitized ? 6 : 12, 1.0);
  const auto result = fractions_from_function(grid, [&](const Vec3& p) {
    return std::max(distance_between(p, centre) - radius, p[0] - cut);
  });
  for_cells(grid, [&](const Index3& cell, std::size_t index) {
    const Vec3 low = low_corner(grid, cell);
    Vec3 high = plus(low, grid.spacing);
    high[0] = std::min(high[0], cut);
    const double left = (high[0] - low[0]) / grid.spacing[0];
    const double exact = left > 0.0 ? left * sphere_overlap({centre, radius}, {low, high}) : 0.0;
    CHECK(std::abs(result.fractions[index] - exact) < 1e-5);
  });
}

TEST_CASE("a sphere in one cell is found wherever it is") {
  const Grid one{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}};
  const Grid five = cube_grid(5, 2.5);
  for (const double radius : {0.02, 0.1, 0.37}) {
    for (const Vec3& centre : {Vec3{0.5, 0.5, 0.5}, Vec3{0.41, 0.57, 0.6}, Vec3{0.38, 0.38, 0.5},
                               Vec3{0.6, 0.4, 0.38}}) {
      CAPTURE(radius);
      CAPTURE(centre[0]);
      const double exact = 4.0 / 3.0 * kPi * radius * radius * radius;
      FractionsFromFunctionOptions options;
      options.max_calls_per_cell = 2'000'000;
      for (const bool by_distance : {false, true}) {
        // The distance has a cone's tip at the centre, so its tolerance is that for kinks.
        const double tolerance = by_distance ? 1e-5 : 1e-9;
        const auto f =
            by_distance ? sphere_by_distance(centre, radius) : sphere_by_square(centre, radius);
        const auto alone = fractions_from_function(one, f, options);
        CHECK(std::abs(alone.fractions[0] - exact) < tolerance);
        const auto among = fractions_from_function(five, f, options);
        CHECK(std::abs(among.report.fraction_volume - exact) < tolerance);
      }
    }
  }
}

TEST_CASE("a bulge through a face is not missed") {
  // The top of the sphere is in the layer above by less and less; that layer's corners are all
  // outside.
  for (const double height : {0.2, 0.02, 1e-3, 1e-5}) {
    CAPTURE(height);
    const double radius = 3.7;
    const Vec3 centre{0.31, -0.22, 4.0 + height - radius};
    const Grid grid{{10, 10, 10}, {-5, -5, -3}, {1, 1, 1}};
    const auto result = fractions_from_function(grid, sphere_by_distance(centre, radius));
    CHECK(worst_sphere_error(grid, result, centre, radius) < 2e-10);
    double above = 0.0;
    for_cells(grid, [&](const Index3& cell, std::size_t index) {
      above += cell[2] >= 7 ? result.fractions[index] : 0.0;
    });
    const double cap = kPi * height * height * (radius - height / 3.0);
    CHECK(std::abs(above - cap) < 2e-10);
  }
}

TEST_CASE("surfaces tangent to cell faces") {
  const Grid grid = cube_grid(8, 4.0);
  const auto inside = fractions_from_function(grid, sphere_by_distance({0.25, 0.5, 0.0}, 3.0));
  CHECK(worst_sphere_error(grid, inside, {0.25, 0.5, 0.0}, 3.0) < 1e-9);
  const auto on_nodes = fractions_from_function(grid, sphere_by_square({0, 0, 0}, 3.0));
  CHECK(worst_sphere_error(grid, on_nodes, {0, 0, 0}, 3.0) < 1e-9);
  // A torus that touches planes of the grid along circles.
  const auto torus = fractions_from_function(
      cube_grid(kSanitized ? 8 : 16, 1.0),
      [](const Vec3& p) { return std::hypot(std::hypot(p[0], p[1]) - 0.6, p[2]) - 0.25; });
  CHECK(relative_error(torus.report.fraction_volume, 2.0 * kPi * kPi * 0.6 * 0.0625) < 1e-9);
}

TEST_CASE("a thin shell inside one cell") {
  const Grid grid = cube_grid(3, 1.5);
  const Vec3 centre{0.03, 0.02, -0.01};
  FractionsFromFunctionOptions options;
  options.max_calls_per_cell = 2'000'000;
  const double r = 0.3;
  for (const double half : {0.1, 0.05}) {
    CAPTURE(half);
    const double exact = 4.0 / 3.0 * kPi * (std::pow(r + half, 3) - std::pow(r - half, 3));
    const auto kinked = fractions_from_function(
        grid, [&](const Vec3& p) { return std::abs(distance_between(p, centre) - r) - half; },
        options);
    CHECK(std::abs(kinked.fractions[13] - exact) < 1e-7);
    const auto smooth = fractions_from_function(
        grid,
        [&](const Vec3& p) {
          const double d = distance_between(p, centre) - r;
          return d * d - half * half;
        },
        options);
    CHECK(std::abs(smooth.fractions[13] - exact) < 1e-9);
    CHECK(smooth.report.interfacial_cells == 1);
  }
  // Too few calls are said to have been too few.
  options.max_calls_per_cell = 1000;
  const auto rough = fractions_from_function(
      grid, [&](const Vec3& p) { return std::abs(distance_between(p, centre) - r) - 0.05; },
      options);
  CHECK(rough.report.unresolved_cells == 1);
  CHECK(rough.report.largest_error_estimate > 1e-6);
}

TEST_CASE("planes on cell faces give exact zeros and ones") {
  const Grid grid{{7, 6, 5}, {-3, -2, 1}, {1.0, 0.5, 0.25}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const double at = grid.origin[axis] + 2.0 * grid.spacing[axis];
      const auto result =
          fractions_from_function(grid, [&](const Vec3& p) { return side * (p[axis] - at); });
      for_cells(grid, [&](const Index3& cell, std::size_t index) {
        const bool below = cell[axis] < 2;
        CHECK(result.fractions[index] == (below == (side > 0.0) ? 1.0 : 0.0));
      });
      CHECK(result.report.interfacial_cells == 0);
    }
  }
}

TEST_CASE("tilted planes are exact") {
  const Grid grid = cube_grid(6, 3.0);
  // x + y + z < t cuts the cube [-3,3]^3 in a known volume.
  for (const double t : {-8.2, -3.1, 0.0, 2.5, 7.0}) {
    const auto result =
        fractions_from_function(grid, [&](const Vec3& p) { return p[0] + p[1] + p[2] - t; });
    const auto cube = [](double v) { return v > 0.0 ? v * v * v : 0.0; };
    const double s = t + 9.0;
    const double exact = (cube(s) - 3 * cube(s - 6) + 3 * cube(s - 12)) / 6.0;
    CHECK(std::abs(result.report.fraction_volume - exact) < 1e-12 * 216);
  }
}

TEST_CASE("no surface at all") {
  const Grid grid = cube_grid(4, 1.0);
  const auto empty = fractions_from_function(grid, [](const Vec3&) { return 1.0; });
  CHECK(empty.report.fraction_volume == 0.0);
  CHECK(empty.report.sampled_cells == 0);
  const auto full = fractions_from_function(grid, [](const Vec3& p) { return -9.0 + p[0]; });
  CHECK(full.report.fraction_volume == 8.0);
  CHECK(full.report.lattice_calls == 125);
  const auto zero = fractions_from_function(grid, [](const Vec3&) { return 0.0; });
  CHECK(zero.report.fraction_volume == 0.0);
}

TEST_CASE("tolerance is kept and saves calls") {
  const Vec3 centre{0.137, -0.291, 0.0713};
  const Grid grid = grid_around(5.3, {1, 1, 1});
  double calls = std::numeric_limits<double>::infinity();
  for (const double tolerance : {1e-12, 1e-9, 1e-6, 1e-3}) {
    FractionsFromFunctionOptions options;
    options.tolerance = tolerance;
    const auto result = fractions_from_function(grid, sphere_by_distance(centre, 5.3), options);
    CHECK(worst_sphere_error(grid, result, centre, 5.3) < 2.0 * tolerance);
    CHECK(result.report.calls_per_interfacial_cell < calls);
    calls = result.report.calls_per_interfacial_cell;
  }
}

TEST_CASE("a gradient changes nothing but the certainty") {
  difmesh::ShapeOptions options{.kind = difmesh::ShapeKind::torus, .rotation_degrees = {30, 10, 0}};
  const difmesh::Shape torus = difmesh::make_shape(options);
  const Grid grid = cube_grid(12, 1.6);
  const auto without = fractions_from_function(grid, torus.function());
  FractionsFromFunctionOptions with_gradient;
  with_gradient.gradient = torus.gradient_function();
  const auto with = fractions_from_function(grid, torus.function(), with_gradient);
  CHECK(without.report.gradient_calls == 0);
  CHECK(with.report.gradient_calls >= 9 * with.report.interfacial_cells);
  for (std::size_t i = 0; i < with.fractions.size(); ++i) {
    CHECK(std::abs(with.fractions[i] - without.fractions[i]) < 2e-10);
  }
}

TEST_CASE("f is called within the grid and by one thread if so wished") {
  const Grid grid{{5, 1, 3}, {-1.0, 2.0, 0.5}, {0.3, 1.4, 0.7}};
  std::atomic<bool> outside = false;
  std::atomic<bool> elsewhere = false;
  std::int64_t points_seen = 0;
  const auto caller = std::this_thread::get_id();
  FractionsFromFunctionOptions options;
  options.threads = 1;
  const auto result = fractions_from_function(
      grid,
      [&](std::span<const Vec3> points, std::span<double> values) {
        elsewhere = elsewhere || std::this_thread::get_id() != caller;
        points_seen += static_cast<std::int64_t>(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
          for (std::size_t a = 0; a < 3; ++a) {
            const double u = (points[i][a] - grid.origin[a]) / grid.spacing[a];
            outside = outside || u < -1e-12 || u > static_cast<double>(grid.dims[a]) + 1e-12;
          }
          values[i] = distance_between(points[i], {-0.2, 2.5, 1.6}) - 0.6;
        }
      },
      options);
  CHECK_FALSE(outside.load());
  CHECK_FALSE(elsewhere.load());
  CHECK(points_seen == result.report.function_calls);
  CHECK(worst_sphere_error(grid, result, {-0.2, 2.5, 1.6}, 0.6) < 1e-9);
}

TEST_CASE("mirrored and swapped axes give the same fractions") {
  const difmesh::Shape shape = difmesh::make_shape(
      {.kind = difmesh::ShapeKind::ellipsoid, .rotation_degrees = {25, 40, 70}});
  const Grid grid{{9, 10, 11}, {-1.1, -1.05, -1.2}, {0.25, 0.22, 0.21}};
  const auto plain = fractions_from_function(grid, shape.function());
  const auto at = [&](const Index3& cell) {
    return plain.fractions[static_cast<std::size_t>(
        (cell[2] * grid.dims[1] + cell[1]) * grid.dims[0] + cell[0])];
  };
  // x -> y -> z -> x.
  const Grid turned{{grid.dims[2], grid.dims[0], grid.dims[1]},
                    {grid.origin[2], grid.origin[0], grid.origin[1]},
                    {grid.spacing[2], grid.spacing[0], grid.spacing[1]}};
  const auto cycled = fractions_from_function(turned, [&](const Vec3& p) {
    return shape.value({p[1], p[2], p[0]});
  });
  for_cells(turned, [&](const Index3& cell, std::size_t index) {
    CHECK(std::abs(cycled.fractions[index] - at({cell[1], cell[2], cell[0]})) < 2e-10);
  });
  Grid flipped = grid;
  flipped.origin[1] = -(grid.origin[1] + static_cast<double>(grid.dims[1]) * grid.spacing[1]);
  const auto mirrored = fractions_from_function(flipped, [&](const Vec3& p) {
    return shape.value({p[0], -p[1], p[2]});
  });
  const auto complement =
      fractions_from_function(grid, [&](const Vec3& p) { return -shape.value(p); });
  for_cells(grid, [&](const Index3& cell, std::size_t index) {
    CHECK(std::abs(mirrored.fractions[index] - at({cell[0], grid.dims[1] - 1 - cell[1], cell[2]})) <
          2e-10);
    CHECK(std::abs(complement.fractions[index] + plain.fractions[index] - 1.0) < 2e-10);
  });
}

TEST_CASE("films between the samples of cells are found across any axis") {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Grid grid{{6, 7, 8}, {-1.0, -0.9, -1.1}, {0.25, 0.3, 0.2}};
    // A tenth of a cell to each side of what lies between a face and the middle of a cell.
    const double middle = grid.origin[axis] + 3.25 * grid.spacing[axis];
    const double half = 0.1 * grid.spacing[axis];
    const auto film = batch_of([=](const Vec3& p) {
      const double away = p[axis] - middle;
      return away * away - half * half;
    });
    const auto result = fractions_from_function(grid, film);
    for_cells(grid, [&](const Index3& cell, std::size_t index) {
      CHECK(std::abs(result.fractions[index] - (cell[axis] == 3 ? 0.2 : 0.0)) < 1e-9);
    });
  }
}
