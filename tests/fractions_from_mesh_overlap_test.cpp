#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "support/box_union.hpp"
#include "support/convex_body.hpp"
#include "support/mesh_field.hpp"
#include "support/triangle_meshes.hpp"
#include "support/vec3.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;

#ifdef DIFMESH_SANITIZED
constexpr int kTrials = 20;
#else
constexpr int kTrials = 150;
#endif

/// Checks all three ways to treat overlaps.
void check_boxes(const Grid& grid, const std::vector<Box>& boxes, double precision) {
  const TriangleMesh mesh = mesh_of(boxes);
  const FractionsFromMesh united = run(grid, mesh);
  double again = 0.0;
  std::int64_t cells = 0;
  REQUIRE(worst(grid, united.fractions, [&](const Index3& cell) {
            const Shares shares = shares_of(grid, cell, boxes);
            again += shares.again;
            cells += shares.again > 1e-11 ? 1 : 0;
            return shares.once;
          }) < precision);
  REQUIRE(united.report.overlap.volume ==
          doctest::Approx(again * grid.cell_volume()).epsilon(1e-9));
  REQUIRE(united.report.overlap.cells == cells);
  REQUIRE(united.report.inverted.cells == 0);
  FractionsFromMeshOptions options;
  options.overlaps = Overlaps::count;
  const FractionsFromMesh counted = run(grid, mesh, options);
  REQUIRE(worst(grid, counted.fractions, [&](const Index3& cell) {
            const Shares shares = shares_of(grid, cell, boxes);
            return shares.once + shares.again;
          }) < precision);
  options.overlaps = Overlaps::refuse;
  if (again > 1e-6) {
    REQUIRE_THROWS_AS((void)run(grid, mesh, options), Error);
  } else if (again == 0.0) {
    REQUIRE(run(grid, mesh, options).fractions == united.fractions);
  }
}

double share_of(const ConvexBody& body, const Grid& grid, const Index3& cell) {
  ConvexBody part = body;
  for (std::size_t a = 0; a < 3; ++a) {
    part.cut(a, static_cast<long double>(low_of(grid, a, cell[a])), -1);
    part.cut(a, static_cast<long double>(low_of(grid, a, cell[a] + 1)), 1);
  }
  return static_cast<double>(part.volume()) / grid.cell_volume();
}

/// A closed mesh round the axis: a prism over the star polygon {5/2}, wound twice round its centre.
TriangleMesh star_prism(double radius, double low, double high) {
  TriangleMesh mesh;
  for (const double z : {low, high}) {
    mesh.positions.push_back({0.0, 0.0, z});
    for (int i = 0; i < 5; ++i) {
      const double angle = 4.0 * std::numbers::pi * i / 5.0 + 0.1;
      mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::uint32_t a = 1 + i;
    const std::uint32_t b = 1 + (i + 1) % 5;
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({6, a + 6, b + 6});
    mesh.triangles.push_back({a, b, b + 6});
    mesh.triangles.push_back({a, b + 6, a + 6});
  }
  return mesh;
}

/// An octahedron, each side cut in n * n, its vertices moved onto a sphere.
TriangleMesh ball_mesh(const Vec3& centre, double radius, int n) {
  TriangleMesh mesh;
  for (unsigned octant = 0; octant < 8; ++octant) {
    const Vec3 s{(octant & 1U) != 0 ? -1.0 : 1.0, (octant & 2U) != 0 ? -1.0 : 1.0,
                 (octant & 4U) != 0 ? -1.0 : 1.0};
    const auto point = [&](int i, int j) {
      // Whole numbers: the same on both sides of an edge.
      const double x = i;
      const double y = j;
      const double z = n - i - j;
      const double length = std::sqrt(x * x + y * y + z * z);
      return Vec3{centre[0] + s[0] * (radius * x / length),
                  centre[1] + s[1] * (radius * y / length),
                  centre[2] + s[2] * (radius * z / length)};
    };
    const bool turn = s[0] * s[1] * s[2] < 0.0;
    const auto add_triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), {a, turn ? c : b, turn ? b : c});
      mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add_triangle(point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < n) {
          add_triangle(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        }
      }
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("two thin boxes that overlap count once whatever the grid") {
  const std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 0.02}}, {{0, 0, 0.015}, {1, 1, 0.035}}};
  for (const std::int64_t n : {1, 2, 5, 18, 24, 64}) {
    CAPTURE(n);
    const double spacing = 1.4 / static_cast<double>(n);
    Grid grid = make_grid({n, n, n}, {-0.17, -0.19, -0.16}, {spacing, spacing, spacing});
    const FractionsFromMesh result = run(grid, mesh_of(boxes));
    CHECK(result.report.fraction_volume == doctest::Approx(0.035).epsilon(1e-12));
    const CoverReport& overlap = result.report.overlap;
    CHECK(overlap.volume == doctest::Approx(0.005).epsilon(1e-12));
    CHECK(overlap.largest > 0.0);
    for (std::size_t a = 0; a < 3; ++a) {
      // Round the overlap, by less than a cell.
      const double low = a == 2 ? 0.015 : 0.0;
      const double high = a == 2 ? 0.02 : 1.0;
      CHECK(overlap.low[a] <= low);
      CHECK(overlap.low[a] > low - spacing);
      CHECK(overlap.high[a] >= high);
      CHECK(overlap.high[a] < high + spacing);
      CHECK(low_of(grid, a, overlap.cell[a]) >= overlap.low[a] - 1e-12);
      CHECK(low_of(grid, a, overlap.cell[a] + 1) <= overlap.high[a] + 1e-12);
    }
    check_boxes(grid, boxes, 1e-12);
  }
}

TEST_CASE("boxes anywhere have the closed form of their union") {
  Random random(11);
  for (int trial = 0; trial < kTrials; ++trial) {
    CAPTURE(trial);
    const Grid grid = trial % 3 == 0 ? make_grid({1, 1, 1}, {0, 0, 0}, {2, 3, 4})
                                     : make_grid({4, 3, 4}, {-0.3, 0.1, 0.2}, {0.5, 1.0, 0.9});
    std::vector<Box> boxes(static_cast<std::size_t>(2 + trial % 4));
    for (Box& box : boxes) {
      for (std::size_t a = 0; a < 3; ++a) {
        const double extent = static_cast<double>(grid.dims[a]) * grid.spacing[a];
        double low = grid.origin[a] + random.uniform(-0.2, 0.9) * extent;
        double size = random.uniform(0.01, 0.9) * extent;
        if (trial % 2 == 0) {
          // Faces on each other, on faces of cells, and out of the grid.
          low = grid.origin[a] + std::floor(random.uniform(-1, 8)) * extent / 8.0;
          size = std::floor(random.uniform(1, 6)) * extent / 8.0;
        }
        box.low[a] = low;
        box.high[a] = low + size;
      }
    }
    check_boxes(grid, boxes, 1e-12);
  }
}

TEST_CASE("a box and a tetrahedron that cross have the closed form of their union") {
  Random random(12);
  for (int trial = 0; trial < kTrials / 2; ++trial) {
    CAPTURE(trial);
    const std::int64_t n = 1 + trial % 4;
    const double spacing = 3.0 / static_cast<double>(n);
    const Grid grid = make_grid({n, n, n}, {0, 0, 0}, {spacing, spacing, spacing});
    std::array<Vec3, 4> corners;
    for (Vec3& corner : corners) {
      corner = {random.uniform(0, 3), random.uniform(0, 3), random.uniform(0, 3)};
    }
    const Box box{{random.uniform(0, 1.5), random.uniform(0, 1.5), random.uniform(0, 1.5)},
                  {random.uniform(1.6, 3), random.uniform(1.6, 3), random.uniform(1.6, 3)}};
    TriangleMesh mesh = tetrahedron_mesh(corners);
    const ConvexBody tetrahedron(mesh);
    const ConvexBody cuboid(box_mesh(box.low, box.high));
    ConvexBody common(mesh);
    for (std::size_t a = 0; a < 3; ++a) {
      common.cut(a, box.low[a], -1);
      common.cut(a, box.high[a], 1);
    }
    mesh.append(box_mesh(box.low, box.high));
    const FractionsFromMesh result = run(grid, mesh);
    CHECK(worst(grid, result.fractions, [&](const Index3& cell) {
            return share_of(tetrahedron, grid, cell) + share_of(cuboid, grid, cell) -
                   share_of(common, grid, cell);
          }) < 1e-12);
    CHECK(result.report.overlap.volume ==
          doctest::Approx(static_cast<double>(common.volume())).epsilon(1e-9));
  }
}

TEST_CASE("what lies within one cell is found by its winding number") {
  const Grid grid = make_grid({1, 1, 1});
  const auto fraction = [&](const TriangleMesh& mesh) { return run(grid, mesh).fractions[0]; };
  const TriangleMesh outer = box_mesh({0.1, 0.1, 0.1}, {0.7, 0.8, 0.9});
  const TriangleMesh inner = box_mesh({0.2, 0.2, 0.2}, {0.5, 0.5, 0.5});
  TriangleMesh filled = outer;
  filled.append(inner);
  CHECK(fraction(filled) == doctest::Approx(0.6 * 0.7 * 0.8).epsilon(1e-13));
  CHECK(run(grid, filled).report.overlap.volume == doctest::Approx(0.027).epsilon(1e-12));
  TriangleMesh hollow = outer;
  hollow.append(inner.reversed());
  CHECK(fraction(hollow) == doctest::Approx(0.6 * 0.7 * 0.8 - 0.027).epsilon(1e-13));
  CHECK(run(grid, hollow).report.overlap.cells == 0);
  TriangleMesh twice = outer;
  twice.append(outer);
  twice.append(outer);
  CHECK(fraction(twice) == doctest::Approx(0.6 * 0.7 * 0.8).epsilon(1e-13));
  CHECK(run(grid, twice).report.overlap.volume ==
        doctest::Approx(2 * 0.6 * 0.7 * 0.8).epsilon(1e-13));
  // Vertices moved a little, so that nothing matches, and one sheet hides in the other.
  TriangleMesh nearly = outer;
  nearly.append(box_mesh({0.1 + 1e-6, 0.1 + 1e-6, 0.1 + 1e-6}, {0.7, 0.8, 0.9}));
  CHECK(fraction(nearly) == doctest::Approx(0.6 * 0.7 * 0.8).epsilon(1e-13));
}

TEST_CASE("a cavity that reaches through its wall leaves a pocket that is outside") {
  const Grid grid = make_grid({8, 8, 8});
  TriangleMesh mesh = box_mesh({1.1, 1.1, 1.1}, {6.9, 6.9, 6.9});
  mesh.append(box_mesh({2.5, 2.5, 2.5}, {6.901, 4.5, 4.5}).reversed());
  const FractionsFromMesh result = run(grid, mesh);
  const double body = 5.8 * 5.8 * 5.8 - 4.4 * 2.0 * 2.0;
  CHECK(result.report.fraction_volume == doctest::Approx(body).epsilon(1e-12));
  CHECK(result.report.inverted.volume == doctest::Approx(0.001 * 4.0).epsilon(1e-9));
  CHECK(result.report.inverted.cells == 9);
  FractionsFromMeshOptions options;
  options.overlaps = Overlaps::refuse;
  CHECK_THROWS_AS((void)run(grid, mesh, options), Error);
}

TEST_CASE("a part that cuts itself counts once") {
  // Area of the pentagram {5/2} with circumradius 1 and of the pentagon in it.
  const double inner_radius = std::cos(0.4 * std::numbers::pi) / std::cos(0.2 * std::numbers::pi);
  const double star = 5.0 * inner_radius * std::sin(0.2 * std::numbers::pi);
  const double pentagon = 2.5 * inner_radius * inner_radius * std::sin(0.4 * std::numbers::pi);
  for (const std::int64_t n : {1, 3, 7, 20}) {
    CAPTURE(n);
    const double spacing = 2.6 / static_cast<double>(n);
    const Grid grid = make_grid({n, n, n}, {-1.3, -1.27, -1.2}, {spacing, spacing, spacing});
    for (std::size_t turn = 0; turn < 3; ++turn) {
      TriangleMesh mesh = star_prism(1.0, -0.3, 0.4);
      for (Vec3& p : mesh.positions) {
        p = {p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]};
      }
      const FractionsFromMesh result = run(grid, mesh);
      CHECK(result.report.fraction_volume == doctest::Approx(0.7 * star).epsilon(1e-12));
      CHECK(result.report.overlap.volume == doctest::Approx(0.7 * pentagon).epsilon(1e-11));
    }
  }
}

TEST_CASE("parts that touch or overlap by rounding are one") {
  for (const double overlap : {1e-5, 1e-9, 1e-15, 0.0, -1e-15, -1e-9}) {
    CAPTURE(overlap);
    const std::vector<Box> boxes{{{0.5, 0.6, 0.7}, {2.3 + overlap, 3.0, 3.0}},
                                 {{2.3, 0.6, 0.7}, {3.5, 3.0, 3.0}},
                                 {{0.5, 0.6, 3.0 - overlap}, {1.5, 3.0, 3.3}}};
    check_boxes(make_grid({4, 4, 4}), boxes, 1e-12);
  }
}

TEST_CASE("the union of a cell is the mean of those of its parts") {
  TriangleMesh mesh = ball_mesh({0.1, 0.0, 0.05}, 1.0, 12);
  mesh.append(ball_mesh({0.9, 0.3, -0.2}, 0.8, 9));
  mesh.append(ball_mesh({0.4, -0.7, 0.3}, 0.7, 7));
  const Grid coarse = make_grid({5, 5, 5}, {-1.1, -1.6, -1.3}, {0.6, 0.6, 0.6});
  Grid fine = coarse;
  for (std::size_t a = 0; a < 3; ++a) {
    fine.dims[a] *= 3;
    fine.spacing[a] /= 3.0;
  }
  const FractionsFromMesh parts = run(fine, mesh);
  std::vector<double> means(125, 0.0);
  for_cells(fine, parts.fractions, [&](const Index3& cell, double fraction) {
    means[static_cast<std::size_t>((cell[2] / 3 * 5 + cell[1] / 3) * 5 + cell[0] / 3)] +=
        fraction / 27.0;
  });
  const FractionsFromMesh whole = run(coarse, mesh);
  CHECK(worst(coarse, whole.fractions, [&](const Index3& cell) {
          return means[static_cast<std::size_t>((cell[2] * 5 + cell[1]) * 5 + cell[0])];
        }) < 1e-12);
  CHECK(whole.report.overlap.volume == doctest::Approx(parts.report.overlap.volume).epsilon(1e-11));
  CHECK(whole.report.fraction_volume + whole.report.overlap.volume ==
        doctest::Approx(whole.report.mesh_volume).epsilon(1e-12));
}

TEST_CASE("two balls have the volume of their union") {
  // Inscribed meshes fall short of the balls by r^2 over the square of the number of edges.
  const double d = 0.9;
  const double lens = std::numbers::pi * (4.0 + d) * (2.0 - d) * (2.0 - d) / 12.0;
  const auto off = [&](int n) {
    TriangleMesh mesh = ball_mesh({0, 0, 0}, 1.0, n);
    mesh.append(ball_mesh({0.54, 0.0, 0.72}, 1.0, n));
    const Grid grid = grid_around(mesh, 20);
    return 8.0 / 3.0 * std::numbers::pi - lens - run(grid, mesh).report.fraction_volume;
  };
  const double coarse = off(16);
  const double fine = off(32);
  CHECK(coarse > 0.0);
  CHECK(coarse < 0.05);
  CHECK(coarse / fine == doctest::Approx(4.0).epsilon(0.05));
}

TEST_CASE("threads and the order of triangles do not change a bit of a union") {
  TriangleMesh mesh = ball_mesh({0.1, 0.0, 0.05}, 1.0, 12);
  mesh.append(ball_mesh({0.9, 0.3, -0.2}, 0.8, 9));
  mesh.append(ball_mesh({0.1, 0.0, 0.05}, 1.0, 12));
  const Grid grid = grid_around(mesh, 24);
  FractionsFromMeshOptions options;
  options.threads = 1;
  const FractionsFromMesh serial = run(grid, mesh, options);
  CHECK(serial.report.overlap.cells > 100);
  std::mt19937 engine(6);
  for (const int threads : {2, 3, 7}) {
    options.threads = threads;
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), engine);
    const FractionsFromMesh parallel = run(grid, mesh, options);
    CHECK(parallel.fractions == serial.fractions);
    CHECK(parallel.report.overlap.volume == serial.report.overlap.volume);
    CHECK(parallel.report.overlap.cell == serial.report.overlap.cell);
  }
}
