#include "difmesh/fractions_from_mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "support/convex_body.hpp"
#include "support/mesh_field.hpp"
#include "support/triangle_meshes.hpp"
#include "support/vec3.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;

#ifdef DIFMESH_SANITIZED
constexpr int kTrials = 40;
constexpr std::int64_t kFinest = 64;
#else
constexpr int kTrials = 400;
constexpr std::int64_t kFinest = 256;
#endif

/// Share of a cell inside a box, axis by axis.
double box_share(const Grid& grid, const Index3& cell, const Vec3& low, const Vec3& high) {
  double share = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double cell_low = low_of(grid, a, cell[a]);
    const double cell_high = low_of(grid, a, cell[a] + 1);
    share *=
        std::max(0.0, std::min(high[a], cell_high) - std::max(low[a], cell_low)) / grid.spacing[a];
  }
  return share;
}

/// Share of a cell inside a convex mesh.
double convex_share(const Grid& grid, const Index3& cell, const TriangleMesh& convex) {
  ConvexBody body(convex);
  for (std::size_t a = 0; a < 3; ++a) {
    const long double spacing = grid.spacing[a];
    const long double low = grid.origin[a] + static_cast<long double>(cell[a]) * spacing;
    body.cut(a, low, -1);
    body.cut(a, low + spacing, 1);
  }
  return static_cast<double>(body.volume() / static_cast<long double>(grid.cell_volume()));
}

void check_against_convex(const Grid& grid, const TriangleMesh& convex, double precision) {
  const FractionsFromMesh result = run(grid, convex);
  CHECK(worst(grid, result.fractions,
              [&](const Index3& cell) { return convex_share(grid, cell, convex); }) < precision);
  CHECK(result.report.largest_gap < 1e-14);
}

TriangleMesh random_tetrahedron(Random& random, const Vec3& centre, double size) {
  std::array<Vec3, 4> corners;
  for (Vec3& corner : corners) {
    corner = add(centre, scaled(random.direction(), size * random.uniform(0.3, 1.0)));
  }
  return tetrahedron_mesh(corners);
}

/// Volume under the plane x + y + z = level in the unit cube.
double corner_share(double level) {
  const auto cube = [](double x) { return x > 0.0 ? x * x * x : 0.0; };
  return (cube(level) - 3 * cube(level - 1) + 3 * cube(level - 2) - cube(level - 3)) / 6.0;
}

}  // namespace

TEST_CASE("a box whose faces lie on grid planes fills its cells exactly") {
  const Grid grid = make_grid({9, 8, 7});
  const Vec3 low{2, 1, 3};
  const Vec3 high{7, 5, 6};
  const FractionsFromMesh result = run(grid, box_mesh(low, high));
  CHECK(worst(grid, result.fractions,
              [&](const Index3& cell) { return box_share(grid, cell, low, high); }) == 0.0);
  CHECK(result.report.fraction_volume == 5.0 * 4.0 * 3.0);
  CHECK(result.report.mesh_volume == doctest::Approx(60.0).epsilon(1e-15));
}

TEST_CASE("boxes anywhere have the closed form") {
  Random random(1);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Grid grid = make_grid({7, 5, 6}, {-1.3, 0.4, 2.0}, {0.1, 0.2, 0.5});
    Vec3 low;
    Vec3 high;
    for (std::size_t a = 0; a < 3; ++a) {
      // Some lie within one cell, some reach out of the grid on either side.
      const auto dim = static_cast<double>(grid.dims[a]);
      const double reach = trial % 2 == 0 ? dim + 4.0 : 1.0;
      const double start = random.uniform(-2.0, dim);
      low[a] = grid.origin[a] + start * grid.spacing[a];
      high[a] = low[a] + random.uniform(0.05, reach) * grid.spacing[a];
    }
    const FractionsFromMesh result = run(grid, box_mesh(low, high));
    REQUIRE(worst(grid, result.fractions,
                  [&](const Index3& cell) { return box_share(grid, cell, low, high); }) < 1e-13);
  }
}

TEST_CASE("grids of any shape have the closed form") {
  for (const Index3& dims : {Index3{1, 1, 3000},
                             {1, 3000, 1},
                             {3000, 1, 1},
                             {3, 2, 701},
                             {70000, 3, 2},
                             {37, 211, 5},
                             {2, 2, 2}}) {
    const Grid grid = make_grid(dims, {0.25, -1.0, 3.0}, {0.5, 0.25, 1.0});
    Vec3 low;
    Vec3 high;
    for (std::size_t a = 0; a < 3; ++a) {
      const double extent = static_cast<double>(dims[a]) * grid.spacing[a];
      low[a] = grid.origin[a] + 0.13 * extent;
      high[a] = grid.origin[a] + 0.81 * extent;
    }
    const FractionsFromMesh result = run(grid, box_mesh(low, high));
    CHECK(worst(grid, result.fractions, [&](const Index3& cell) {
            return box_share(grid, cell, low, high);
          }) < 1e-15 * static_cast<double>(std::max({dims[0], dims[1], dims[2]}) + 10));
  }
}

TEST_CASE("a corner tetrahedron has the closed form") {
  for (const double legs : {0.5, 1.0, 2.0, 3.7, 6.25}) {
    const Grid grid = make_grid({7, 7, 7}, {0, 0, 0}, {1, 2, 5});
    const TriangleMesh mesh =
        tetrahedron_mesh({Vec3{0, 0, 0}, {legs, 0, 0}, {0, 2 * legs, 0}, {0, 0, 5 * legs}});
    const FractionsFromMesh result = run(grid, mesh);
    CHECK(worst(grid, result.fractions, [&](const Index3& cell) {
            return corner_share(legs - static_cast<double>(cell[0] + cell[1] + cell[2]));
          }) < 1e-14);
    CHECK(result.report.fraction_volume ==
          doctest::Approx(10.0 * legs * legs * legs / 6.0).epsilon(1e-14));
  }
}

TEST_CASE("random tetrahedra agree with clipping each cell") {
  Random random(2);
  for (int trial = 0; trial < kTrials / 4; ++trial) {
    const Grid grid = make_grid({6, 5, 4}, {0, 0, 0}, {1, 2, 5});
    const Vec3 centre{random.uniform(0, 6), random.uniform(0, 10), random.uniform(0, 20)};
    const double size = std::pow(10.0, random.uniform(-2.0, 1.3));
    check_against_convex(grid, random_tetrahedron(random, centre, size), 1e-13);
  }
}

TEST_CASE("corners and edges and faces on grid nodes and edges and faces") {
  Random random(3);
  const Grid grid = make_grid({5, 5, 5});
  for (int trial = 0; trial < kTrials / 4; ++trial) {
    // Corners on nodes, or in half-cell steps; flat ones are fine too.
    std::array<Vec3, 4> corners;
    for (Vec3& corner : corners) {
      for (double& x : corner) {
        x = std::floor(random.uniform(-1.0, 7.0));
        x = trial % 2 == 0 ? x : 0.5 * x;
      }
    }
    check_against_convex(grid, tetrahedron_mesh(corners), 1e-14);
  }
}

TEST_CASE("a tetrahedron that reaches out of each side") {
  const Grid grid = make_grid({6, 6, 6});
  Random random(4);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double place : {0.1, 5.9}) {
      for (int trial = 0; trial < 4; ++trial) {
        Vec3 centre{3, 3, 3};
        centre[axis] = place;
        check_against_convex(grid, random_tetrahedron(random, centre, 4.0), 1e-13);
      }
    }
  }
}

TEST_CASE("a hollow box and a second component inside it") {
  const Grid grid = make_grid({10, 10, 10}, {-0.2, -0.3, -0.4}, {0.5, 0.6, 0.7});
  const std::array<Vec3, 6> c{
      {{0.3, 0.4, 0.5}, {4.1, 5.2, 5.7}, {1.1, 1.2, 1.3}, {3.3, 4.4, 5.5}, {2, 2, 2}, {3, 3, 3}}};
  TriangleMesh mesh = box_mesh(c[0], c[1]);
  mesh.append(box_mesh(c[2], c[3]).reversed());
  mesh.append(box_mesh(c[4], c[5]));
  const FractionsFromMesh result = run(grid, mesh);
  CHECK(worst(grid, result.fractions, [&](const Index3& cell) {
          return box_share(grid, cell, c[0], c[1]) - box_share(grid, cell, c[2], c[3]) +
                 box_share(grid, cell, c[4], c[5]);
        }) < 1e-14);
}

TEST_CASE("components side by side that share a face or an edge") {
  const Grid grid = make_grid({6, 6, 6});
  TriangleMesh mesh = box_mesh({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5});
  mesh.append(box_mesh({2.5, 1.5, 1.5}, {3.5, 2.5, 2.5}));
  mesh.append(box_mesh({3.5, 2.5, 1.5}, {4.5, 3.5, 2.5}));
  const FractionsFromMesh result = run(grid, mesh);
  CHECK(worst(grid, result.fractions, [&](const Index3& cell) {
          return box_share(grid, cell, {1.5, 1.5, 1.5}, {3.5, 2.5, 2.5}) +
                 box_share(grid, cell, {3.5, 2.5, 1.5}, {4.5, 3.5, 2.5});
        }) < 1e-15);
}

TEST_CASE("a mesh beside the grid gives 0 and one round it 1") {
  const Grid grid = make_grid({4, 5, 6});
  Random random(5);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double shift : {-50.0, 50.0}) {
      Vec3 centre{2, 2.5, 3};
      centre[axis] += shift;
      const FractionsFromMesh beside = run(grid, random_tetrahedron(random, centre, 40.0));
      CHECK(worst(grid, beside.fractions, [](const Index3&) { return 0.0; }) == 0.0);
      CHECK(beside.report.cells_touched == 0);
    }
  }
  const TriangleMesh round =
      tetrahedron_mesh({Vec3{-300, -310, -320}, {900, -5, 1}, {2, 800, -3}, {1, 2, 700}});
  const FractionsFromMesh inside = run(grid, round);
  CHECK(worst(grid, inside.fractions, [](const Index3&) { return 1.0; }) == 0.0);
  CHECK(inside.report.fraction_volume == 4.0 * 5.0 * 6.0);
}

TEST_CASE("one cell takes a whole mesh") {
  const TriangleMesh mesh =
      tetrahedron_mesh({Vec3{0.1, 0.2, 0.3}, {0.9, 0.25, 0.2}, {0.3, 0.8, 0.4}, {0.35, 0.4, 0.95}});
  const FractionsFromMesh result = run(make_grid({1, 1, 1}), mesh);
  CHECK(result.fractions[0] == doctest::Approx(result.report.mesh_volume).epsilon(1e-14));
  CHECK(result.report.pieces == 4);
  CHECK(result.report.cells_touched == 1);
}

TEST_CASE("a very flat body and a distant one keep their volume") {
  const Grid grid = make_grid({40, 40, 40}, {1000.0, -2000.0, 500.0}, {0.1, 0.1, 0.1});
  const Vec3 low{1000.55, -1999.45, 502.00001};
  const Vec3 high{1003.25, -1997.15, 502.00002};
  const FractionsFromMesh result = run(grid, box_mesh(low, high));
  const Vec3 size = subtract(high, low);
  CHECK(result.report.fraction_volume ==
        doctest::Approx(size[0] * size[1] * size[2]).epsilon(1e-12));
  CHECK(result.report.fraction_volume == doctest::Approx(result.report.mesh_volume).epsilon(1e-9));
}

TEST_CASE("the shared meshes keep their volume and need no clamping") {
  for (const SharedMesh& shared : kSharedMeshes) {
    const auto mesh = shared_mesh(shared.file);
    for (std::int64_t cells = 64; mesh && cells <= kFinest; cells *= 2) {
      CAPTURE(std::string(shared.file));
      CAPTURE(cells);
      const Grid grid = grid_around(*mesh, cells);
      const FractionsFromMesh result = run(grid, *mesh);
      const FractionsFromMeshReport& report = result.report;
      CHECK(report.mesh_volume == doctest::Approx(shared.volume).epsilon(1e-9));
      CHECK(report.fraction_volume == doctest::Approx(report.mesh_volume).epsilon(1e-12));
      CHECK(report.lowest_raw >= -1e-12);
      CHECK(report.highest_raw <= 1.0 + 1e-12);
      CHECK(report.largest_gap <= 1e-14);
      long double sum = 0;
      std::int64_t pure = 0;
      for (const double fraction : result.fractions) {
        sum += fraction;
        pure += fraction == 0.0 || fraction == 1.0 ? 1 : 0;
      }
      CHECK(static_cast<double>(sum) * grid.cell_volume() ==
            doctest::Approx(report.fraction_volume).epsilon(1e-14));
      CHECK(pure >= grid.cell_count() - report.cells_touched);
    }
  }
}

TEST_CASE("turning the axes of the shared meshes turns the field") {
  for (const SharedMesh& shared : kSharedMeshes) {
    const auto mesh = shared_mesh(shared.file);
    if (!mesh) {
      continue;
    }
    CAPTURE(std::string(shared.file));
    // Other axes mean other columns and another order of clipping: another computation.
    const Grid grid = grid_around(*mesh, 64);
    Grid turned = grid;
    TriangleMesh turned_mesh = *mesh;
    for (std::size_t a = 0; a < 3; ++a) {
      turned.dims[a] = grid.dims[(a + 1) % 3];
      turned.origin[a] = grid.origin[(a + 1) % 3];
      turned.spacing[a] = grid.spacing[(a + 1) % 3];
    }
    for (std::size_t v = 0; v < mesh->positions.size(); ++v) {
      const Vec3& p = mesh->positions[v];
      turned_mesh.positions[v] = {p[1], p[2], p[0]};
    }
    const FractionsFromMesh straight = run(grid, *mesh);
    const FractionsFromMesh other = run(turned, turned_mesh);
    CHECK(worst(turned, other.fractions, [&](const Index3& cell) {
            const std::int64_t i = cell[2];
            const std::int64_t j = cell[0];
            const std::int64_t k = cell[1];
            return straight
                .fractions[static_cast<std::size_t>((k * grid.dims[1] + j) * grid.dims[0] + i)];
          }) < 1e-13);
  }
}

TEST_CASE("a cell holds the mean of its eight parts") {
  const auto mesh = shared_mesh("golfball_openscad_45k.off");
  if (!mesh) {
    return;
  }
  const Grid coarse = grid_around(*mesh, 32);
  Grid fine = coarse;
  for (std::size_t a = 0; a < 3; ++a) {
    fine.dims[a] *= 2;
    fine.spacing[a] *= 0.5;
  }
  const FractionsFromMesh parts = run(fine, *mesh);
  std::vector<double> means(static_cast<std::size_t>(coarse.cell_count()), 0.0);
  for_cells(fine, parts.fractions, [&](const Index3& cell, double fraction) {
    const std::int64_t row = cell[2] / 2 * coarse.dims[1] + cell[1] / 2;
    means[static_cast<std::size_t>(row * coarse.dims[0] + cell[0] / 2)] += fraction / 8.0;
  });
  const FractionsFromMesh whole = run(coarse, *mesh);
  CHECK(worst(coarse, whole.fractions, [&](const Index3& cell) {
          return means[static_cast<std::size_t>(
              (cell[2] * coarse.dims[1] + cell[1]) * coarse.dims[0] + cell[0])];
        }) < 1e-13);
}

TEST_CASE("shifting by whole cells shifts the field") {
  for (const SharedMesh& shared : kSharedMeshes) {
    const auto mesh = shared_mesh(shared.file);
    if (!mesh) {
      continue;
    }
    CAPTURE(std::string(shared.file));
    const Index3 shift{7, 3, 11};
    Grid grid = grid_around(*mesh, 64);
    TriangleMesh moved = *mesh;
    for (std::size_t a = 0; a < 3; ++a) {
      grid.dims[a] += shift[a];
      for (Vec3& p : moved.positions) {
        p[a] += static_cast<double>(shift[a]) * grid.spacing[a];
      }
    }
    const FractionsFromMesh before = run(grid, *mesh);
    const FractionsFromMesh after = run(grid, moved);
    CHECK(worst(grid, after.fractions, [&](const Index3& cell) {
            const std::int64_t i = cell[0] - shift[0];
            const std::int64_t j = cell[1] - shift[1];
            const std::int64_t k = cell[2] - shift[2];
            const bool within = i >= 0 && j >= 0 && k >= 0;
            return within ? before.fractions[static_cast<std::size_t>(
                                (k * grid.dims[1] + j) * grid.dims[0] + i)]
                          : 0.0;
          }) < 1e-12);
  }
}

TEST_CASE("threads and the order of the triangles do not change a bit") {
  const auto mesh = shared_mesh("knot1_genus1.off");
  if (!mesh) {
    return;
  }
  Grid grid = grid_around(*mesh, 96);
  FractionsFromMeshOptions options;
  options.threads = 1;
  const FractionsFromMesh serial = run(grid, *mesh, options);
  for (const int threads : {2, 3, 7}) {
    options.threads = threads;
    const FractionsFromMesh parallel = run(grid, *mesh, options);
    CHECK(parallel.fractions == serial.fractions);
    CHECK(parallel.report.fraction_volume == serial.report.fraction_volume);
    CHECK(parallel.report.mesh_volume == serial.report.mesh_volume);
    CHECK(parallel.report.pieces == serial.report.pieces);
    CHECK(parallel.report.largest_gap == serial.report.largest_gap);
  }
  TriangleMesh shuffled = *mesh;
  std::mt19937 engine(6);
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), engine);
  CHECK(run(grid, shuffled, options).fractions == serial.fractions);
}

TEST_CASE("triangles that share no vertices are matched by position") {
  const TriangleMesh mesh = box_mesh({0.5, 0.25, 0.0}, {2.5, 2.25, 2.0});
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) {
      soup.positions.push_back(mesh.positions[v]);
      // 0 and -0 are one place.
      soup.positions.back()[2] = soup.positions.size() % 2 == 0 && mesh.positions[v][2] == 0.0
                                     ? -0.0
                                     : mesh.positions[v][2];
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const Grid grid = make_grid({4, 4, 4});
  CHECK(run(grid, soup).fractions == run(grid, mesh).fractions);
}

TEST_CASE("degenerate triangles add nothing") {
  TriangleMesh mesh = box_mesh({0.5, 0.25, 0.5}, {2.5, 2.25, 2.5});
  const Grid grid = make_grid({4, 4, 4});
  const FractionsFromMesh plain = run(grid, mesh);
  mesh.triangles.push_back({3, 3, 3});
  mesh.triangles.push_back({0, 7, 0});
  // There and back again.
  mesh.triangles.push_back({0, 3, 5});
  mesh.triangles.push_back({0, 5, 3});
  CHECK(worst(grid, run(grid, mesh).fractions, [&](const Index3& cell) {
          return plain.fractions[static_cast<std::size_t>((cell[2] * 4 + cell[1]) * 4 + cell[0])];
        }) < 1e-15);
}
