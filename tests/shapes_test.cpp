#include "difmesh/shapes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/fractions_from_function.hpp"

using difmesh::ErrorCode;
using difmesh::make_shape;
using difmesh::Shape;
using difmesh::ShapeKind;
using difmesh::ShapeOptions;
using difmesh::Vec3;

namespace {

#ifdef DIFMESH_SANITIZED
constexpr int kEffort = 1;
#else
constexpr int kEffort = 5;
#endif

Vec3 plus(const Vec3& a, double s, const Vec3& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 in_box(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_box(1.0);
      const double l = length(v);
      if (l > 0.1 && l < 1.0) {
        return plus({}, 1.0 / l, v);
      }
    }
  }

 private:
  std::mt19937 engine_;
};

std::vector<ShapeOptions> all_shapes() {
  std::vector<ShapeOptions> shapes;
  for (const auto kind : {ShapeKind::sphere, ShapeKind::ellipsoid, ShapeKind::torus,
                          ShapeKind::genus, ShapeKind::smooth_box, ShapeKind::golf_ball}) {
    shapes.push_back({.kind = kind});
  }
  ShapeOptions golf{.kind = ShapeKind::golf_ball, .dimples = 12};
  golf.dimple_radius = 0.42;
  golf.dimple_depth = 0.2;
  shapes.push_back(golf);
  shapes.push_back({.kind = ShapeKind::smooth_box, .semi_axes = {0.7, 1.1, 0.9}, .exponent = 2.7});
  return shapes;
}

// Goes along the gradient onto the surface, by Newton steps of this test's own.
Vec3 onto_surface(const Shape& shape, Vec3 x) {
  for (int i = 0; i < 60; ++i) {
    const Vec3 g = shape.gradient(x);
    x = plus(x, -shape.value(x) / dot(g, g), g);
  }
  return x;
}

// Points of the surface, by bisection between points inside and outside.
std::vector<Vec3> surface_points(const Shape& shape, std::size_t count, Random& random) {
  std::vector<Vec3> points;
  while (points.size() < count) {
    Vec3 inside = random.in_box(2.0);
    if (shape.value(inside) >= 0.0) {
      continue;
    }
    const Vec3 direction = random.direction();
    Vec3 outside = inside;
    while (shape.value(outside) < 0.0) {
      outside = plus(outside, 0.05, direction);
    }
    inside = plus(outside, -0.05, direction);
    for (int i = 0; i < 55; ++i) {
      const Vec3 middle{0.5 * (inside[0] + outside[0]), 0.5 * (inside[1] + outside[1]),
                        0.5 * (inside[2] + outside[2])};
      (shape.value(middle) < 0.0 ? inside : outside) = middle;
    }
    points.push_back(outside);
  }
  return points;
}

double nearest_distance(const std::vector<Vec3>& points, const Vec3& query) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) {
    const Vec3 d = plus(p, -1.0, query);
    least = std::min(least, dot(d, d));
  }
  return std::sqrt(least);
}

ErrorCode code_of(const ShapeOptions& options) {
  try {
    (void)make_shape(options);
  } catch (const difmesh::Error& error) {
    return error.code();
  }
  return ErrorCode{};
}

}  // namespace

TEST_CASE("names of shapes") {
  CHECK(difmesh::shape_names().size() == 6);
  for (const std::string_view name : difmesh::shape_names()) {
    CHECK(difmesh::shape_name(difmesh::shape_kind(name)) == name);
  }
  CHECK(difmesh::shape_kind("smooth-box") == ShapeKind::smooth_box);
  try {
    (void)difmesh::shape_kind("cube");
    FAIL("there is no cube");
  } catch (const difmesh::Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(std::string(error.what()).find("'cube'") != std::string::npos);
    CHECK(std::string(error.what()).find("golf_ball") != std::string::npos);
  }
}

TEST_CASE("options out of range are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto bad = [](auto change) {
    ShapeOptions options;
    change(options);
    return code_of(options) == ErrorCode::invalid_argument;
  };
  for (const double value : {0.0, -1.0, nan, infinity}) {
    CHECK(bad([&](auto& o) { o.radius = value; }));
    for (const auto kind : {ShapeKind::ellipsoid, ShapeKind::smooth_box}) {
      CHECK(bad([&](auto& o) { o.kind = kind, o.semi_axes[1] = value; }));
    }
    CHECK(bad([&](auto& o) { o.kind = ShapeKind::torus, o.tube_radius = value; }));
    CHECK(bad([&](auto& o) { o.kind = ShapeKind::genus, o.scale = value; }));
    CHECK(bad([&](auto& o) { o.kind = ShapeKind::golf_ball, o.dimple_radius = value; }));
    CHECK(bad([&](auto& o) { o.kind = ShapeKind::golf_ball, o.dimple_depth = value; }));
    CHECK(bad([&](auto& o) { o.kind = ShapeKind::smooth_box, o.exponent = value; }));
  }
  CHECK(bad([&](auto& o) { o.centre[2] = nan; }));
  CHECK(bad([&](auto& o) { o.rotation_degrees[0] = infinity; }));
  CHECK(bad([&](auto& o) { o.kind = ShapeKind::torus, o.tube_radius = o.radius; }));
  CHECK(bad([&](auto& o) { o.kind = ShapeKind::smooth_box, o.exponent = 1.5; }));
  CHECK(bad([&](auto& o) { o.kind = ShapeKind::golf_ball, o.dimples = 0; }));
  CHECK(bad([&](auto& o) { o.kind = ShapeKind::golf_ball, o.dimples = 5001; }));
  // Dimples that meet, and one too shallow to be a dimple.
  CHECK(bad([&](auto& o) { o.kind = ShapeKind::golf_ball, o.dimple_radius = 0.09; }));
  CHECK(bad([&](auto& o) { o.kind = ShapeKind::golf_ball, o.dimple_depth = 0.003; }));
  // Only the options of the kind matter.
  CHECK_FALSE(bad([&](auto& o) { o.kind = ShapeKind::genus, o.radius = -1.0; }));
  const Shape sphere = make_shape({});
  std::vector<Vec3> points(3);
  std::vector<double> values(2);
  CHECK_THROWS_AS(sphere.values(points, values), difmesh::Error);
}

TEST_CASE("functions as they are documented") {
  ShapeOptions genus{.kind = ShapeKind::genus, .scale = 1.5};
  const Shape shape = make_shape(genus);
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random.in_box(2.0);
    const double x = p[0] / 1.5;
    const double y = p[1] / 1.5;
    const double z = p[2] / 1.5;
    const double e19 = 2 * y * (y * y - 3 * x * x) * (1 - z * z) +
                       (x * x + y * y) * (x * x + y * y) - (9 * z * z - 1) * (1 - z * z);
    if (std::abs(z) <= 1.0) {
      CHECK(shape.value(p) == doctest::Approx(e19).epsilon(1e-12));
    } else {
      CHECK(shape.value(p) > 0.0);
    }
  }
  const Shape torus = make_shape({.kind = ShapeKind::torus});
  CHECK(std::abs(torus.value({1.4, 0.0, 0.0})) < 1e-15);
  CHECK(std::abs(torus.value({0.0, -0.6, 0.0})) < 1e-15);
  CHECK(std::abs(torus.value({0.6, 0.8, 0.4})) < 1e-15);
  const Shape box = make_shape({.kind = ShapeKind::smooth_box, .exponent = 4.0});
  const double s = std::pow(0.5, 0.25);
  CHECK(std::abs(box.value({s, 0.8 * s, 0.0})) < 1e-15);
  // Not even far away or at the centre does anything overflow.
  CHECK(std::isfinite(box.value({1e90, -1e80, 3.0})));
  CHECK(box.value({0.0, 0.0, 0.0}) == doctest::Approx(-0.6));
  const Shape golf = make_shape({.kind = ShapeKind::golf_ball, .radius = 2.0});
  // The bottom of dimple 0, on its axis, at the depth asked for.
  const double w = 1.0 - 1.0 / 333.0;
  const Vec3 axis{std::sqrt(1.0 - w * w), 0.0, w};
  CHECK(std::abs(golf.value(plus({}, 2.0 * (1.0 - 0.012), axis))) < 1e-14);
  // Its rim, at the radius asked for.
  const Vec3 across{-axis[2], 0.0, axis[0]};
  const Vec3 rim = plus(plus({}, 2.0 * std::sqrt(1.0 - 0.0064), axis), 2.0 * 0.08, across);
  CHECK(std::abs(golf.value(rim)) < 1e-14);
}

TEST_CASE("gradients against finite differences") {
  Random random(2);
  for (const ShapeOptions& options : all_shapes()) {
    CAPTURE(difmesh::shape_name(options.kind));
    ShapeOptions turned = options;
    turned.centre = {0.3, -0.2, 0.1};
    turned.rotation_degrees = {33, -72, 105};
    const Shape shape = make_shape(turned);
    int kinks = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = random.in_box(1.7);
      const Vec3 g = shape.gradient(p);
      constexpr double kStep = 1e-5;
      double difference = 0.0;
      for (std::size_t a = 0; a < 3; ++a) {
        Vec3 step{};
        step[a] = 1.0;
        const double slope =
            (shape.value(plus(p, kStep, step)) - shape.value(plus(p, -kStep, step))) /
            (2.0 * kStep);
        difference = std::max(difference, std::abs(slope - g[a]));
      }
      // A difference may straddle a kink of the golf ball's.
      kinks += difference > 1e-6 * (1.0 + length(g)) ? 1 : 0;
    }
    CHECK(kinks <= (options.kind == ShapeKind::golf_ball ? 3 : 0));
  }
}

TEST_CASE("turning and moving a shape") {
  Random random(3);
  const double c = std::cos(25.0 * std::numbers::pi / 180.0);
  const double s = std::sin(25.0 * std::numbers::pi / 180.0);
  for (ShapeOptions options : all_shapes()) {
    CAPTURE(difmesh::shape_name(options.kind));
    const Shape plain = make_shape(options);
    options.centre = {1.0, 2.0, -0.5};
    // About x by 90, then about y by -90 degrees, then about z by 25: (1,0,0) -> (1,0,0) -> (0,0,1)
    // -> (0,0,1), (0,1,0) -> (0,0,1) -> (-1,0,0) -> (-c,-s,0), (0,0,1) -> (0,-1,0) -> (0,-1,0) ->
    // (s,-c,0).
    options.rotation_degrees = {90, -90, 25};
    const Shape moved = make_shape(options);
    for (int i = 0; i < 50; ++i) {
      const Vec3 u = random.in_box(1.5);
      const Vec3 x{1.0 - c * u[1] + s * u[2], 2.0 - s * u[1] - c * u[2], -0.5 + u[0]};
      CHECK(moved.value(x) == doctest::Approx(plain.value(u)).epsilon(1e-12));
      CHECK(std::abs(moved.distance(x) - plain.distance(u)) < 1e-12);
    }
  }
  // Right angles are exact.
  const Shape turned = make_shape({.kind = ShapeKind::ellipsoid, .rotation_degrees = {0, 0, 450}});
  const Shape plain = make_shape({.kind = ShapeKind::ellipsoid});
  CHECK(turned.value({-0.2, 0.3, 0.7}) == plain.value({0.3, 0.2, 0.7}));
}

TEST_CASE("bounds enclose and touch") {
  Random random(4);
  for (const ShapeOptions& options : all_shapes()) {
    for (const bool turned : {false, true}) {
      CAPTURE(difmesh::shape_name(options.kind));
      CAPTURE(turned);
      ShapeOptions placed = options;
      placed.centre = {0.1, 0.2, -0.3};
      placed.rotation_degrees = turned ? Vec3{15, 35, 60} : Vec3{0, 0, 0};
      const Shape shape = make_shape(placed);
      const auto bounds = shape.bounds();
      const auto points = surface_points(shape, 4000, random);
      for (std::size_t a = 0; a < 3; ++a) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vec3& p : points) {
          low = std::min(low, p[a]);
          high = std::max(high, p[a]);
        }
        CHECK(low >= bounds.low[a] - 1e-12);
        CHECK(high <= bounds.high[a] + 1e-12);
        if (options.kind == ShapeKind::genus && turned) {
          continue;
        }
        const double slack = options.kind == ShapeKind::golf_ball ? 0.2 : 0.03;
        CHECK(low <= bounds.low[a] + slack);
        CHECK(high >= bounds.high[a] - slack);
      }
    }
  }
  // The extremes of the genus: the surface touches the planes there.
  const Shape genus = make_shape({.kind = ShapeKind::genus});
  const auto bounds = genus.bounds();
  CHECK(std::abs(genus.value({0.0, bounds.low[1], 0.0})) < 1e-12);
  CHECK(std::abs(genus.value({0.0, 0.0, bounds.high[2]})) < 1e-15);
  CHECK(std::abs(genus.value({std::sqrt(0.5), bounds.high[1], std::sqrt(0.5)})) < 1e-14);
  double least = std::numeric_limits<double>::infinity();
  for (double y = 0.8; y < 0.9; y += 1e-6) {
    least = std::min(least, genus.value({bounds.high[0], y, 0.0}));
  }
  CHECK(std::abs(least) < 1e-10);
}

TEST_CASE("volumes against totals of fractions") {
  for (const ShapeOptions& options : all_shapes()) {
    CAPTURE(difmesh::shape_name(options.kind));
    ShapeOptions turned = options;
    turned.rotation_degrees = {11, 23, 37};
    const Shape shape = make_shape(turned);
    REQUIRE(shape.volume().has_value());
    const auto bounds = shape.bounds();
    difmesh::Grid grid;
    constexpr double kMargin = 0.01;
    const bool golf = options.kind == ShapeKind::golf_ball;
    if (golf && options.dimples > 100 && kEffort == 1) {
      continue;
    }
    const std::int64_t cells = golf ? 10 + kEffort : 4 * kEffort;
    for (std::size_t a = 0; a < 3; ++a) {
      grid.dims[a] = cells;
      grid.origin[a] = bounds.low[a] - kMargin;
      grid.spacing[a] =
          (bounds.high[a] - bounds.low[a] + 2.0 * kMargin) / static_cast<double>(cells);
    }
    difmesh::FractionsFromFunctionOptions settings;
    settings.kink_tolerance = golf ? 1e-4 : 1e-6;
    const auto result = difmesh::fractions_from_function(grid, shape.function(), settings);
    const double error = std::abs(result.report.fraction_volume / *shape.volume() - 1.0);
    MESSAGE(difmesh::shape_name(options.kind)
            << ": relative difference " << error << ", " << result.report.calls_per_interfacial_cell
            << " calls per cell");
    // At exponents that are not even the function is not smooth on the planes of symmetry.
    const bool rough = options.exponent != 8.0 || kEffort == 1;
    CHECK(error < (golf ? 1e-5 : (rough ? 1e-7 : 2e-10)));
  }
}

TEST_CASE("cells that rims cross keep the volume as no quadrature does") {
  ShapeOptions options{
      .kind = ShapeKind::golf_ball, .radius = 1.3, .dimples = kEffort > 1 ? 12 : 5};
  options.centre = {0.013, -0.021, 0.037};
  options.rotation_degrees = {10, 20, 30};
  options.dimple_radius = 0.18;
  options.dimple_depth = 0.06;
  const Shape ball = make_shape(options);
  const std::int64_t cells = kEffort > 1 ? 18 : 8;
  const double spacing = 2.8 / static_cast<double>(cells);
  const difmesh::Grid grid{{cells, cells + 3, 2 * cells},
                           {-1.4, -1.41, -1.4},
                           {spacing, spacing * 0.92, spacing * 0.51}};
  difmesh::FractionsFromFunctionOptions settings;
  const auto sharp = difmesh::fractions_from_shape(grid, ball, settings);
  CHECK(std::abs(sharp.report.fraction_volume / *ball.volume() - 1.0) < 1e-10);
  CHECK(sharp.report.unresolved_cells == 0);
  const auto blunt = difmesh::fractions_from_function(grid, ball.function(), settings);
  double worst = 0.0;
  for (std::size_t i = 0; i < sharp.fractions.size(); ++i) {
    worst = std::max(worst, std::abs(sharp.fractions[i] - blunt.fractions[i]));
  }
  // Quadrature does not see rims that cut off no more than a corner of a cell.
  CHECK(worst < 1e-4);
  CHECK(worst > 1e-12);  // or nothing was done another way
  CHECK(4 * sharp.report.function_calls < blunt.report.function_calls);
  settings.threads = 1;
  CHECK(difmesh::fractions_from_shape(grid, ball, settings).fractions == sharp.fractions);
}

TEST_CASE("a coarse grid in whose cells whole dimples lie keeps the volume") {
  const Shape ball = make_shape({.kind = ShapeKind::golf_ball});
  for (const std::int64_t cells : {1, 2, 5}) {
    const double spacing = 2.2 / static_cast<double>(cells);
    const difmesh::Grid grid{
        {cells, cells, cells}, {-1.1, -1.1, -1.1}, {spacing, spacing, spacing}};
    const auto field = difmesh::fractions_from_shape(grid, ball);
    CHECK(std::abs(field.report.fraction_volume / *ball.volume() - 1.0) < 1e-8);
  }
}

TEST_CASE("shapes without rims have the fractions of their functions") {
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::torus, ShapeKind::smooth_box}) {
    const Shape shape = make_shape({.kind = kind, .rotation_degrees = {5, 6, 7}});
    const difmesh::Grid grid{{9, 8, 7}, {-1.5, -1.5, -1.5}, {0.34, 0.38, 0.43}};
    CHECK(difmesh::fractions_from_shape(grid, shape).fractions ==
          difmesh::fractions_from_function(grid, shape.function()).fractions);
  }
}

TEST_CASE("distances against a dense cloud of surface points") {
  Random random(5);
  for (const ShapeOptions& options : all_shapes()) {
    CAPTURE(difmesh::shape_name(options.kind));
    const Shape shape = make_shape(options);
    const auto cloud = surface_points(shape, static_cast<std::size_t>(10000 * kEffort), random);
    for (int i = 0; i < 12 * kEffort; ++i) {
      const Vec3 p = random.in_box(i % 3 == 0 ? 3.0 : 1.3);
      const double d = shape.distance(p);
      const double by_cloud = nearest_distance(cloud, p);
      CAPTURE(p[0]);
      CAPTURE(p[1]);
      CAPTURE(p[2]);
      CHECK((d < 0.0) == (shape.value(p) < 0.0));
      // No point of the surface is nearer, and one is about as near.
      CHECK(std::abs(d) <= by_cloud + 1e-12);
      CHECK(std::abs(d) >= by_cloud - (kEffort > 1 ? 0.04 : 0.08));
    }
  }
}

TEST_CASE("distances along normals are exact") {
  Random random(6);
  for (const ShapeOptions& options : all_shapes()) {
    CAPTURE(difmesh::shape_name(options.kind));
    const Shape shape = make_shape(options);
    // How far from the surface the foot stays the nearest point.
    const bool golf = options.kind == ShapeKind::golf_ball;
    const bool convex = options.kind == ShapeKind::sphere || options.kind == ShapeKind::ellipsoid ||
                        options.kind == ShapeKind::smooth_box;
    const double inward = options.kind == ShapeKind::smooth_box ? 0.01 : 0.04;
    const double outward = convex ? 1.0 : 0.04;
    for (const Vec3& start :
         surface_points(shape, static_cast<std::size_t>(40 * kEffort), random)) {
      const Vec3 foot = golf ? start : onto_surface(shape, start);
      const Vec3 g = shape.gradient(foot);
      const Vec3 normal = plus({}, 1.0 / length(g), g);
      for (const double share : {-1.0, -0.3, -1e-9, 1e-9, 0.1, 1.0}) {
        const double t = share * (share < 0.0 ? inward : outward);
        if (golf && (t > 0.0 || -t > 0.001)) {
          continue;  // next to rims the nearest point is another one
        }
        CHECK(std::abs(shape.distance(plus(foot, t, normal)) - t) < 1e-12);
      }
    }
  }
}

TEST_CASE("distances of ellipsoids at centre and axes and planes") {
  const Vec3 e{1.3, 0.9, 0.4};
  const Shape shape = make_shape({.kind = ShapeKind::ellipsoid, .semi_axes = e});
  CHECK(shape.distance({0, 0, 0}) == -0.4);
  // On the long axis, the nearest point leaves the axis where |x| < (a^2 - c^2) / a.
  const auto on_long_axis = [&](double x) {
    const double limit = (e[0] * e[0] - e[2] * e[2]) / e[0];
    if (std::abs(x) >= limit) {
      return std::abs(x) - e[0];
    }
    const double foot = e[0] * e[0] * x / (e[0] * e[0] - e[2] * e[2]);
    const double height = e[2] * std::sqrt(1.0 - foot * foot / (e[0] * e[0]));
    return -std::hypot(foot - x, height);
  };
  for (const double x : {0.0, 1e-300, 1e-12, 0.3, 1.17, 1.18, 1.2, 1.3, 4.0}) {
    CAPTURE(x);
    CHECK(std::abs(shape.distance({x, 0, 0}) - on_long_axis(x)) < 2e-15);
    // Next to the axis nothing changes suddenly.
    for (const double aside : {1e-300, 1e-160, 1e-20, 1e-14}) {
      CHECK(std::abs(shape.distance({x, 0, aside}) - on_long_axis(x)) < 3e-14);
      CHECK(std::abs(shape.distance({x, aside, -aside}) - on_long_axis(x)) < 3e-14);
    }
  }
  CHECK(shape.distance({0, 0, 0.1}) == doctest::Approx(-0.3).epsilon(1e-15));
  CHECK(shape.distance({0, 0, 7.4}) == doctest::Approx(7.0).epsilon(1e-15));
  // All axes equal, two equal, and flat as a coin.
  const Shape sphere = make_shape({.kind = ShapeKind::ellipsoid, .semi_axes = {0.5, 0.5, 0.5}});
  CHECK(sphere.distance({0, 0, 0}) == -0.5);
  CHECK(sphere.distance({0.3, 0.4, 1.2}) == doctest::Approx(0.8).epsilon(1e-15));
  const Shape spindle = make_shape({.kind = ShapeKind::ellipsoid, .semi_axes = {2.0, 0.5, 0.5}});
  CHECK(spindle.distance({0, 0.0, 0.2}) == doctest::Approx(-0.3).epsilon(1e-15));
  const Shape coin = make_shape({.kind = ShapeKind::ellipsoid, .semi_axes = {1.0, 1.0, 1e-6}});
  CHECK(coin.distance({0.3, 0.4, 0.25}) == doctest::Approx(0.25).epsilon(1e-5));
  CHECK(coin.distance({2.0, 0, 0}) == doctest::Approx(1.0).epsilon(1e-14));
}

TEST_CASE("distances of a golf ball in closed form") {
  ShapeOptions options{.kind = ShapeKind::golf_ball, .dimples = 1};
  options.dimple_radius = 0.4;
  options.dimple_depth = 0.2;
  const Shape ball = make_shape(options);
  // One dimple at the top: its axis is w = 0 for a lattice of one, along u.
  const Vec3 axis{1.0, 0.0, 0.0};
  const double h = std::sqrt(1.0 - 0.16);
  CHECK(std::abs(ball.value(plus({}, 0.8, axis))) < 1e-15);
  CHECK(ball.distance(plus({}, 0.85, axis)) == doctest::Approx(0.05).epsilon(1e-13));
  CHECK(ball.distance({-1.5, 0, 0}) == doctest::Approx(0.5).epsilon(1e-15));
  // From far along the axis the rim is nearest.
  CHECK(ball.distance(plus({}, 5.0, axis)) ==
        doctest::Approx(std::hypot(5.0 - h, 0.4)).epsilon(1e-14));
  CHECK(ball.distance({h + 0.3, 0.3, 0.0}) == doctest::Approx(std::hypot(0.3, 0.1)).epsilon(1e-13));
  const double lens = 4.0 / 3.0 * std::numbers::pi - *ball.volume();
  // Cap of the ball plus cap of the ball taken away, by their base radius and heights.
  const auto cap = [](double height) {
    return std::numbers::pi * height * (3.0 * 0.16 + height * height) / 6.0;
  };
  CHECK(lens == doctest::Approx(cap(1.0 - h) + cap(0.2 - (1.0 - h))).epsilon(1e-13));
}

TEST_CASE("shapes are cheap to copy and outlive their makers") {
  difmesh::FunctionBatch f;
  difmesh::GradientBatch g;
  {
    const Shape shape = make_shape({.radius = 2.0});
    const Shape copy = shape;
    CHECK(copy.options().radius == 2.0);
    f = copy.function();
    g = copy.gradient_function();
  }
  const std::array<Vec3, 2> points{Vec3{0, 0, 2}, Vec3{0, 3, 0}};
  std::array<double, 2> values{};
  std::array<Vec3, 2> gradients{};
  f(points, values);
  g(points, gradients);
  CHECK(values[0] == 0.0);
  CHECK(values[1] == doctest::Approx(1.25));
  CHECK(gradients[1][1] == doctest::Approx(1.5));
}
