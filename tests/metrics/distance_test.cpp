#include "difmesh/metrics/distance.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "metrics/surfaces.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;
using doctest::Approx;

double sphere(const Vec3& p) {
  return length(p) - 1.0;
}

/// The facet points of a triangle that is cut into m² parts.
std::int64_t points_of(std::int64_t m) {
  return (2 * m + 1) * (2 * m + 2) / 2 - 3 + m * m;
}

/// The rectangle [0,2] x [0,1] in the plane z = 0: a net of 2 n² triangles on the left half, two
/// triangles on the right one.
TriangleMesh uneven_plate(std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      mesh.positions.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n, 0.0});
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {Vec3{1, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 1, 0}, Vec3{1, 1, 0}}) {
    mesh.positions.push_back(p);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  return mesh;
}

}  // namespace

TEST_CASE("an icosahedron in a sphere has its closed-form distances") {
  const Distance d = distance_of(icosahedron(), sphere);
  const double edge = 1.0 / std::sin(0.4 * std::numbers::pi);
  const double phi = std::numbers::phi;
  const double at_middle = 1.0 - 0.5 * edge * phi;
  const double at_centroid = 1.0 - edge * phi * phi / (2.0 * std::sqrt(3.0));
  CHECK(d.vertices.points == 12);
  CHECK(d.vertices.maximum <= 3e-16);
  CHECK(d.facets.points == 80);
  CHECK(d.facets.maximum == Approx(at_centroid).epsilon(1e-14));
  CHECK(d.facets.lowest == Approx(-at_centroid).epsilon(1e-14));
  CHECK(d.facets.highest == Approx(-at_middle).epsilon(1e-14));
  // The rule with 9/20 for the centroid and 2/15 for each middle of an edge; the corners add 0.
  const double mean = 0.45 * at_centroid + 0.4 * at_middle;
  CHECK(d.facets.mean == Approx(mean).epsilon(1e-14));
  CHECK(d.facets.signed_mean == Approx(-mean).epsilon(1e-14));
  CHECK(d.facets.rms ==
        Approx(std::sqrt(0.45 * at_centroid * at_centroid + 0.4 * at_middle * at_middle))
            .epsilon(1e-14));
  CHECK(d.area == Approx(5.0 * std::sqrt(3.0) * edge * edge).epsilon(1e-14));
  CHECK(d.reach == Approx(edge / (2.0 * std::sqrt(3.0))).epsilon(1e-14));
  CHECK(d.has_sign);
  CHECK(length(d.facets.maximum_position) == Approx(1.0 - at_centroid).epsilon(1e-14));
}

TEST_CASE("the facets of icospheres lie as deep as their sagitta says") {
  double last = 0.0;
  for (const int levels : {2, 3, 4}) {
    const TriangleMesh mesh = icosphere(levels);
    const Distance d = distance_of(mesh, sphere);
    CHECK(d.vertices.maximum <= 3e-16);
    // Every point of a facet is at least as far out as the foot of its plane, 1 - cos of the
    // angular radius of its corners, and the centroid of the largest is nearly there.
    double deepest = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 sum = add(add(mesh.positions[a], mesh.positions[b]), mesh.positions[c]);
      deepest = std::max(deepest, 1.0 - length(sum) / 3.0);
    }
    CHECK(d.facets.maximum == Approx(deepest).epsilon(1e-12));
    CHECK(d.facets.highest < 0.0);
    // A paraboloid over a triangle: distances fall as the square of the edges.
    if (last > 0.0) {
      CHECK(last / d.facets.rms == Approx(4.0).epsilon(0.02));
    }
    last = d.facets.rms;
  }
}

TEST_CASE("means over the facets are exact integrals for cubics however finely they are cut") {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3});
  const auto cubic = [](const Vec3& p) {
    return 1.0 + p[0] * p[0] * p[0] + p[0] * p[1] * p[2] - 2.0 * p[1] * p[2] * p[2] + p[2];
  };
  // Integrals over x = 0 and 1, y = 0 and 2, z = 0 and 3, term by term.
  const double on_x = 2 * 6.0 + 6.0 + 0.5 * 4 * 0.5 * 9 - 2 * (2 * 0.5 * 4 * 9) + 2 * 2 * 4.5;
  const double on_y = 2 * 3.0 + 2 * 0.25 * 3 + 2 * 0.5 * 4.5 - 2 * 2 * 9 + 2 * 4.5;
  const double on_z = 2 * 2.0 + 2 * 0.25 * 2 + 3 * 0.5 * 2 - 2 * 9 * 2 + 3 * 2;
  for (const double spacing : {0.0, 4.0, 1.0, 0.7, 0.3, 0.1}) {
    CAPTURE(spacing);
    DistanceOptions options;
    options.facet_spacing = spacing;
    const Distance d = distance_of(box, cubic, options);
    CHECK(d.area == Approx(22.0).epsilon(1e-14));
    CHECK(d.facets.signed_mean == Approx((on_x + on_y + on_z) / 22.0).epsilon(1e-13));
  }
}

TEST_CASE("the root mean square over the facets is an integral too") {
  // One right triangle below the plane z = x + 2 y; d² is of second degree.
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const Distance d = distance_of(mesh, [](const Vec3& p) { return p[0] + 2.0 * p[1]; });
  // ∫x² = ∫y² = 1/12 and ∫xy = 1/24 over an area of 1/2.
  CHECK(d.facets.rms == Approx(std::sqrt((1.0 / 12 + 4.0 / 12 + 4.0 / 24) / 0.5)).epsilon(1e-14));
  CHECK(d.facets.mean == Approx(1.0).epsilon(1e-14));
  CHECK(d.vertices.rms == Approx(std::sqrt(5.0 / 3.0)).epsilon(1e-14));
}

TEST_CASE("facet points are as close as asked for") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  std::vector<Vec3> points;
  DistanceOptions options;
  options.threads = 1;
  const std::vector<std::pair<double, std::int64_t>> cases{{0.8, 1}, {0.7, 2}, {0.3, 3}, {0.1, 8}};
  for (const auto& one : cases) {
    const double spacing = one.first;
    const std::int64_t parts = one.second;
    CAPTURE(spacing);
    points.clear();
    options.facet_spacing = spacing;
    const Distance d = distance_of(
        mesh,
        [&](const Vec3& p) {
          points.push_back(p);
          return 1.0;
        },
        options);
    CHECK(d.facets.points == points_of(parts));
    CHECK(static_cast<std::int64_t>(points.size()) == points_of(parts) + 3);
    CHECK(d.facets.mean == Approx(1.0).epsilon(1e-14));
    CHECK(d.facets.rms == Approx(1.0).epsilon(1e-14));
    // What reach promises, at places that are no facet points.
    Random random(7);
    for (int n = 0; n < 2000; ++n) {
      double x = random.uniform();
      double y = random.uniform();
      if (x + y > 1.0) {
        x = 1.0 - x;
        y = 1.0 - y;
      }
      double nearest = 2.0;
      for (const Vec3& p : points) {
        nearest = std::min(nearest, std::hypot(p[0] - x, p[1] - y, p[2]));
      }
      CHECK(nearest <= d.reach);
    }
  }
}

TEST_CASE("a coarse mesh cannot hide behind vertices that lie on the shape") {
  // A cylinder of radius 1 as a prism with eight sides: all vertices are on it.
  TriangleMesh prism;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const double angle = 0.25 * std::numbers::pi * i;
    prism.positions.push_back({std::cos(angle), std::sin(angle), 0.0});
    prism.positions.push_back({std::cos(angle), std::sin(angle), 1.0});
  }
  for (std::uint32_t i = 0; i < 16; i += 2) {
    const std::uint32_t next = (i + 2) % 16;
    prism.triangles.push_back({i, next, next + 1});
    prism.triangles.push_back({i, next + 1, i + 1});
  }
  const Distance d = distance_of(prism, [](const Vec3& p) { return std::hypot(p[0], p[1]) - 1.0; });
  CHECK(d.vertices.maximum <= 3e-16);
  // The middles of edges across the axis are where the sagitta is.
  CHECK(d.facets.maximum == Approx(1.0 - std::cos(std::numbers::pi / 8)).epsilon(1e-13));
}

TEST_CASE("triangles that are large against the others get more points") {
  const TriangleMesh plate = uneven_plate(16);
  // A hump of height 0.1 over the right half, away from corners, middles and centroids there.
  const Vec3 top{1.62, 0.22, 0.0};
  const auto hump = [&](const Vec3& p) { return std::max(0.0, 0.1 - length(subtract(p, top))); };
  const Distance d = distance_of(plate, hump);
  CHECK(d.vertices.maximum == 0.0);
  CHECK(d.facets.maximum > 0.0);
  CHECK(d.facets.maximum + d.reach >= 0.1);
  CHECK(d.facets.maximum_index == 2 * 16 * 16);
  CHECK(hump(d.facets.maximum_position) == d.facets.maximum);
  const double rms = std::sqrt((512 * 2.0 / 256 + 2 * 2.0) / 514);
  const auto m = static_cast<std::int64_t>(std::ceil(std::sqrt(2.0) / (2.0 * rms)));
  CHECK(m > 1);
  CHECK(d.facets.points == 512 * 4 + 2 * points_of(m));

  DistanceOptions fine;
  fine.facet_spacing = 0.01;
  const Distance finer = distance_of(plate, hump, fine);
  CHECK(finer.facets.maximum == Approx(0.1).epsilon(0.06));
  CHECK(finer.facets.maximum + finer.reach >= 0.1);
  // A cone of height h and base radius h holds π h³ / 3.
  CHECK(finer.facets.mean == Approx(std::numbers::pi * 1e-3 / 3.0 / 2.0).epsilon(0.01));
}

TEST_CASE("vertices in no triangle are not measured") {
  TriangleMesh mesh{{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}}, {{1, 2, 3}}};
  const Distance d = distance_of(mesh, [](const Vec3& p) { return p[2] - 0.5; });
  CHECK(d.vertices.points == 3);
  CHECK(d.vertices.lowest == -0.5);
  CHECK(d.vertices.highest == -0.5);
  CHECK(d.vertices.rms == Approx(0.5).epsilon(1e-15));
  CHECK(d.vertices.maximum_index == 1);
}

TEST_CASE("triangles without area count for the extremes and not for the means") {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 8}, {0, 0, 4}},
                    {{0, 1, 2}, {0, 3, 4}, {1, 1, 2}, {0, 0, 0}}};
  const Distance d = distance_of(mesh, [](const Vec3& p) { return p[2]; });
  CHECK(d.area == Approx(0.5).epsilon(1e-15));
  CHECK(d.facets.rms == 0.0);
  CHECK(d.facets.maximum > 4.0);
  CHECK(d.facets.maximum_index == 1);
}

TEST_CASE("the place of the maximum is the first one") {
  const TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 1});
  const Distance d = distance_of(box, [](const Vec3& p) { return p[0]; });
  CHECK(d.vertices.maximum == 1.0);
  CHECK(d.vertices.maximum_index == 0);
  CHECK(d.vertices.maximum_position == Vec3{-1, -1, -1});
  CHECK(d.vertices.lowest == -1.0);
  CHECK(d.vertices.highest == 1.0);
  CHECK(d.vertices.signed_mean == 0.0);
}

TEST_CASE("units scale and the sizes of numbers do not matter") {
  // Powers of two: every digit must be the same.
  const TriangleMesh mesh = icosphere(2);
  const Distance unit_sized = distance_of(mesh, sphere);
  for (const int exponent : {-900, -20, 20, 900}) {
    CAPTURE(exponent);
    const double factor = std::ldexp(1.0, exponent);
    TriangleMesh copy = mesh;
    for (Vec3& p : copy.positions) {
      p = scaled(p, factor);
    }
    const auto shape = [&](const Vec3& p) { return factor * sphere(scaled(p, 1.0 / factor)); };
    const Distance d = distance_of(copy, shape);
    CHECK(d.facets.rms == factor * unit_sized.facets.rms);
    CHECK(d.facets.mean == factor * unit_sized.facets.mean);
    CHECK(d.facets.lowest == factor * unit_sized.facets.lowest);
    CHECK(d.facets.maximum_index == unit_sized.facets.maximum_index);
    CHECK(d.facets.points == unit_sized.facets.points);
    CHECK(d.reach == factor * unit_sized.reach);
  }
}
