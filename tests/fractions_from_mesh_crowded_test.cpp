// Parts that overlap in cells that hold hundreds or thousands of triangles.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "sampling/cell_clipper.hpp"
#include "sampling/cell_overlaps.hpp"
#include "sampling/column_sums.hpp"
#include "support/box_union.hpp"
#include "support/mesh_field.hpp"
#include "support/triangle_meshes.hpp"
#include "support/vec3.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;

constexpr double kPi = std::numbers::pi;
#ifdef DIFMESH_SANITIZED
constexpr int kCorners = 60;
#else
constexpr int kCorners = 300;
#endif

struct Ring {
  double radius;
  double z;
};

/// A body round the z axis with regular polygons for cross-sections, its first and last ring a
/// point, where `sides` triangles meet.
/// \param turn of the polygons' first corner
TriangleMesh round_body(int sides, const std::vector<Ring>& rings, double turn = 0.0) {
  const auto n = static_cast<std::uint32_t>(sides);
  const auto count = static_cast<std::uint32_t>(rings.size() - 2);
  TriangleMesh mesh;
  mesh.positions.push_back({0.0, 0.0, rings.front().z});
  for (std::size_t i = 1; i + 1 < rings.size(); ++i) {
    for (int j = 0; j < sides; ++j) {
      const double angle = turn + 2.0 * kPi * j / sides;
      mesh.positions.push_back(
          {rings[i].radius * std::cos(angle), rings[i].radius * std::sin(angle), rings[i].z});
    }
  }
  mesh.positions.push_back({0.0, 0.0, rings.back().z});
  for (std::uint32_t j = 0; j < n; ++j) {
    const std::uint32_t a = 1 + j;
    const std::uint32_t b = 1 + (j + 1) % n;
    mesh.triangles.push_back({0, b, a});
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      mesh.triangles.push_back({a + i * n, b + i * n, b + (i + 1) * n});
      mesh.triangles.push_back({a + i * n, b + (i + 1) * n, a + (i + 1) * n});
    }
    mesh.triangles.push_back({1 + count * n, a + (count - 1) * n, b + (count - 1) * n});
  }
  return mesh;
}

TriangleMesh prism(int sides, double radius, double low, double high, double turn = 0.0) {
  return round_body(sides, {{0.0, low}, {radius, low}, {radius, high}, {0.0, high}}, turn);
}

/// By circles of latitude and longitude.
TriangleMesh globe(const Vec3& centre, int circles) {
  std::vector<Ring> rings;
  for (int i = 0; i <= circles; ++i) {
    rings.push_back({std::sin(kPi * i / circles), -std::cos(kPi * i / circles)});
  }
  TriangleMesh mesh = round_body(2 * circles, rings);
  for (Vec3& p : mesh.positions) {
    p = {p[0] + centre[0], p[1] + centre[1], p[2] + centre[2]};
  }
  return mesh;
}

double area_of_polygon(int sides) {
  return 0.5 * sides * std::sin(2.0 * kPi / sides);
}

/// Of a regular polygon and the same turned by half a side.
double area_of_two_polygons(int sides) {
  const double half = 0.5 * kPi / sides;
  return 2.0 * sides * std::cos(2.0 * half) * std::tan(half);
}

/// Turned about an axis that is none of the grid's.
TriangleMesh turned(TriangleMesh mesh) {
  const auto turn = [&](std::size_t a, std::size_t b, double angle) {
    for (Vec3& p : mesh.positions) {
      const Vec3 q = p;
      p[a] = std::cos(angle) * q[a] - std::sin(angle) * q[b];
      p[b] = std::sin(angle) * q[a] + std::cos(angle) * q[b];
    }
  };
  turn(0, 1, 0.7);
  turn(1, 2, 0.4);
  turn(2, 0, 1.1);
  return mesh;
}

/// The whole mesh in one cell, and in some more.
constexpr std::array<std::int64_t, 4> kCells{1, 2, 3, 9};

Grid grid_with(const TriangleMesh& mesh, std::int64_t cells) {
  if (cells > 1) {
    return grid_around(mesh, cells);
  }
  Grid grid = grid_around(mesh, 1);
  for (std::size_t a = 0; a < 3; ++a) {
    grid.dims[a] = 1;
    grid.origin[a] += 0.6 * grid.spacing[a];
    grid.spacing[a] *= 1.2;
  }
  return grid;
}

/// Checks the volumes of the union, and what overlaps, in cells of all sizes.
void check_union(const TriangleMesh& mesh, double whole, double again) {
  for (const std::int64_t cells : kCells) {
    CAPTURE(cells);
    const Grid grid = grid_with(mesh, cells);
    const FractionsFromMeshReport report = run(grid, mesh).report;
    const double precision = 1e-12 * std::max(whole, grid.cell_volume());
    CHECK(std::abs(report.fraction_volume - whole) < precision);
    CHECK(std::abs(report.overlap.volume - again) < precision);
    CHECK(report.undecided.volume == 0.0);
    FractionsFromMeshOptions options;
    options.overlaps = Overlaps::refuse;
    if (again > 0.0) {
      CHECK_THROWS_WITH_AS((void)run(grid, mesh, options), doctest::Contains("overlap"), Error);
    } else {
      CHECK(std::abs(run(grid, mesh, options).report.fraction_volume - whole) < precision);
    }
  }
}

/// Prisms in each other, a thousandth apart, and the volumes that they cover once and again.
struct Shells {
  TriangleMesh mesh;
  double whole = 0.0;
  double again = 0.0;
};
Shells close_shells() {
  constexpr int kShells = 8;
  constexpr double kStep = 1e-3;
  const double one = area_of_polygon(12);
  Shells shells;
  for (int k = 0; k < kShells; ++k) {
    const double radius = 1.0 - k * kStep;
    shells.mesh.append(prism(12, radius, k * kStep, 1.0 + k * kStep));
    // Each reaches out of those round it by one step.
    shells.whole += one * radius * radius * (k > 0 ? kStep : 1.0);
    shells.again += one * radius * radius * (k > 0 ? 1.0 - kStep : 0.0);
  }
  return shells;
}

}  // namespace

TEST_CASE("prisms of many sides in one cell have the closed form of their union") {
  const double one = area_of_polygon(kCorners);
  const double both = area_of_two_polygons(kCorners);
  TriangleMesh mesh = prism(kCorners, 1.0, 0.0, 1.0);
  mesh.append(prism(kCorners, 1.0, 0.5, 1.5, kPi / kCorners));
  check_union(mesh, one + 0.5 * both, 0.5 * (2.0 * one - both));
  check_union(turned(mesh), one + 0.5 * both, 0.5 * (2.0 * one - both));
}

TEST_CASE("caps of many triangles that overlap by a millionth are found in cells of any size") {
  const double one = area_of_polygon(kCorners);
  const double common = 2.0 * one - area_of_two_polygons(kCorners);
  TriangleMesh mesh = prism(kCorners, 1.0, 0.0, 1.0);
  mesh.append(prism(kCorners, 1.0, 1.0 - 1e-6, 2.0, kPi / kCorners));
  check_union(turned(mesh), (2.0 + 1e-6) * one - 1e-6 * common, 1e-6 * common);
}

TEST_CASE("tips of many triangles that overlap are found in cells of any size") {
  const double one = area_of_polygon(kCorners);
  for (const double depth : {0.0, 0.01}) {
    CAPTURE(depth);
    TriangleMesh mesh = round_body(kCorners, {{0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}});
    mesh.append(round_body(kCorners, {{0.0, 1.0 - depth}, {1.0, 2.0 - depth}, {0.0, 3.0 - depth}}));
    const double common = 2.0 / 3.0 * one * std::pow(0.5 * depth, 3.0);
    check_union(mesh, 4.0 / 3.0 * one - common, common);
    if (depth > 0.0) {
      check_union(turned(mesh), 4.0 / 3.0 * one - common, common);
    }
  }
}

TEST_CASE("eight shells close upon each other have the closed form of their union") {
  const Shells shells = close_shells();
  check_union(turned(shells.mesh), shells.whole, shells.again);
}

TEST_CASE("what is undecided bounds what is wrong and is refused") {
  const Shells shells = close_shells();
  const double scale = 0.2 * 0.2 * 0.2;
  std::vector<std::uint64_t> names;
  TriangleMesh cell = turned(shells.mesh);
  for (Vec3& p : cell.positions) {
    p = {0.5 + 0.2 * p[0], 0.5 + 0.2 * p[1], 0.5 + 0.2 * p[2]};
    names.push_back(names.size());
  }
  detail::Workers workers(1);
  const detail::SheetFacts facts = detail::sheet_facts(cell.positions, cell.triangles, workers);
  const detail::NamedMesh mesh{cell.positions, names, cell.triangles, facts};
  const auto fill = [&](std::int64_t steps, Overlaps rule, detail::RowFacts& row) {
    detail::ColumnSums sums(1, 1);
    detail::PieceLists lists(1, 3);
    detail::CellClipper clipper({0, 1, 0, 1}, 1, sums, lists);
    for (std::uint32_t t = 0; t < cell.triangles.size(); ++t) {
      const Triangle& corners = cell.triangles[t];
      clipper.add_triangle(t, cell.positions[corners[0]], cell.positions[corners[1]],
                           cell.positions[corners[2]]);
    }
    detail::CellOverlaps overlaps(mesh, 1.0, steps);
    overlaps.begin_block({0, 1, 0, 1}, lists);
    detail::RowRules rules;
    rules.tolerance = 1e-9;
    rules.rounding = 1e-12;
    rules.overlaps = rule;
    double fraction = -1.0;
    const auto fault = sums.drain(0, rules, {{0, 0, 0}, &fraction, overlaps, row});
    return std::pair(fraction, fault.kind);
  };
  for (const std::int64_t steps : {0, 100, 1000, 10000, 1000000}) {
    CAPTURE(steps);
    detail::RowFacts row;
    const auto [fraction, fault] = fill(steps, Overlaps::unite, row);
    CHECK(fault == detail::ColumnFault::Kind::none);
    CHECK(std::abs(fraction - shells.whole * scale) <= row.undecided.largest + 1e-12);
    CHECK(std::abs(row.overlaps.sum - shells.again * scale) <= row.undecided.sum + 1e-12);
    if (steps == 0 || steps == 1000000) {
      CHECK(row.undecided.count == (steps == 0 ? 1 : 0));
    }
    detail::RowFacts refused;
    const auto kind = fill(steps, Overlaps::refuse, refused).second;
    CHECK(kind ==
          (steps == 0 ? detail::ColumnFault::Kind::undecided : detail::ColumnFault::Kind::winding));
  }
}

TEST_CASE("forty boxes in one cell have the closed form of their union") {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Box> boxes(40);
  for (Box& box : boxes) {
    for (std::size_t a = 0; a < 3; ++a) {
      box.low[a] = 0.7 * uniform(engine);
      box.high[a] = box.low[a] + 0.05 + 0.25 * uniform(engine);
    }
  }
  const TriangleMesh mesh = mesh_of(boxes);
  const Shares shares = shares_of(make_grid({1, 1, 1}), {0, 0, 0}, boxes);
  check_union(mesh, shares.once, shares.again);
  check_union(turned(mesh), shares.once, shares.again);
}

TEST_CASE("the union of globes does not depend on the cells") {
  for (const Vec3& shift : {Vec3{0.02, 0.005, 0.007}, Vec3{0.4, 0.5, 0.3}, Vec3{0.0, 0.0, 1.99}}) {
    CAPTURE(shift[2]);
    TriangleMesh mesh = globe({0.0, 0.0, 0.0}, 20);
    mesh.append(globe(shift, 20));
    // Small cells hold few triangles.
    const FractionsFromMeshReport fine = run(grid_around(mesh, 40), mesh).report;
    CHECK(fine.overlap.volume > 0.0);
    check_union(mesh, fine.fraction_volume, fine.overlap.volume);
  }
}

TEST_CASE("globes in one cell have the volume of the union of balls") {
  // Inscribed meshes fall short by the square of the length of their edges.
  const double d = 0.9;
  const double lens = kPi * (4.0 + d) * (2.0 - d) * (2.0 - d) / 12.0;
  const auto off = [&](int circles) {
    TriangleMesh mesh = globe({0.0, 0.0, 0.0}, circles);
    mesh.append(globe({0.54, 0.0, 0.72}, circles));
    return 8.0 / 3.0 * kPi - lens - run(grid_with(mesh, 1), mesh).report.fraction_volume;
  };
  const double coarse = off(16);
  CHECK(coarse > 0.0);
  CHECK(coarse < 0.15);
  CHECK(coarse / off(32) == doctest::Approx(4.0).epsilon(0.05));
}
