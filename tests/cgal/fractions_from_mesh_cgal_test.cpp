// Cross-check with CGAL's corefinement. PMP is under the GPL: for tests only.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/fractions_from_mesh.hpp"
#include "support/mesh_field.hpp"
#include "support/triangle_meshes.hpp"
#include "support/vec3.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;
namespace pmp = CGAL::Polygon_mesh_processing;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

#ifdef DIFMESH_SANITIZED
constexpr std::size_t kCells = 10;
constexpr std::size_t kSlivers = 3;
constexpr int kUnions = 3;
#else
constexpr std::size_t kCells = 220;
constexpr std::size_t kSlivers = 40;
constexpr int kUnions = 30;
#endif
constexpr std::int64_t kGridCells = 32;

SurfaceMesh to_cgal(const TriangleMesh& mesh) {
  SurfaceMesh surface;
  for (const Vec3& p : mesh.positions) {
    surface.add_vertex({p[0], p[1], p[2]});
  }
  for (const Triangle& t : mesh.triangles) {
    surface.add_face(SurfaceMesh::Vertex_index(t[0]), SurfaceMesh::Vertex_index(t[1]),
                     SurfaceMesh::Vertex_index(t[2]));
  }
  return surface;
}

/// The closed part of a surface inside the cells [low, high) and a margin round them.
SurfaceMesh clipped(SurfaceMesh surface, const Grid& grid, const Index3& low, const Index3& high,
                    double margin) {
  Vec3 from;
  Vec3 to;
  for (std::size_t a = 0; a < 3; ++a) {
    from[a] = low_of(grid, a, low[a]) - margin * grid.spacing[a];
    to[a] = low_of(grid, a, high[a]) + margin * grid.spacing[a];
  }
  SurfaceMesh cuboid = to_cgal(box_mesh(from, to));
  SurfaceMesh part;
  REQUIRE(pmp::corefine_and_compute_intersection(surface, cuboid, part));
  return part;
}

double cell_fraction(const SurfaceMesh& surface, const Grid& grid, const Index3& cell) {
  const SurfaceMesh part =
      clipped(surface, grid, cell, {cell[0] + 1, cell[1] + 1, cell[2] + 1}, 0.0);
  REQUIRE(CGAL::is_closed(part));
  return pmp::volume(part) / grid.cell_volume();
}

[[nodiscard]] double fraction_in(const FractionsFromMesh& field, const Grid& grid,
                                 const Index3& cell) {
  return field.fractions[static_cast<std::size_t>(
      (cell[2] * grid.dims[1] + cell[1]) * grid.dims[0] + cell[0])];
}

/// Cells that the surface cuts, in random order.
std::vector<Index3> interfacial_cells(const Grid& grid, const Array<double>& fractions,
                                      Random& random) {
  std::vector<Index3> cells;
  for_cells(grid, fractions, [&](const Index3& cell, double fraction) {
    if (fraction > 0.0 && fraction < 1.0) {
      cells.push_back(cell);
    }
  });
  for (std::size_t i = cells.size(); i > 1; --i) {
    std::swap(cells[i - 1],
              cells[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  return cells;
}

/// Height of a triangle over its longest edge, relative to that edge.
double flatness(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = subtract(b, a);
  const Vec3 v = subtract(c, a);
  const Vec3 w = subtract(c, b);
  const double longest = std::max({dot(u, u), dot(v, v), dot(w, w)});
  return std::sqrt(std::max(0.0, dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v))) / longest;
}

/// Cells with the centroids of slivers, flattest first; none for meshes without slivers.
std::vector<Index3> sliver_cells(const Grid& grid, const TriangleMesh& mesh) {
  constexpr double kSliver = 1e-3;
  std::vector<std::pair<double, Index3>> found;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3& b = mesh.positions[t[1]];
    const Vec3& c = mesh.positions[t[2]];
    const double flat = flatness(a, b, c);
    if (flat < kSliver) {
      Index3 cell;
      for (std::size_t i = 0; i < 3; ++i) {
        cell[i] = static_cast<std::int64_t>(
            std::floor(((a[i] + b[i] + c[i]) / 3.0 - grid.origin[i]) / grid.spacing[i]));
      }
      found.emplace_back(flat, cell);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<Index3> cells;
  for (const auto& [flat, cell] : found) {
    if (std::find(cells.begin(), cells.end(), cell) == cells.end() && cells.size() < kSlivers) {
      cells.push_back(cell);
    }
  }
  return cells;
}

/// The largest difference over the cells. Whole meshes are clipped only to windows of some cells,
/// and the windows to the cells.
double worst_difference(const SurfaceMesh& surface, const Grid& grid,
                        const FractionsFromMesh& field, std::vector<Index3> cells) {
  constexpr std::int64_t kWindow = 8;
  constexpr double kMargin = 0.37;  // of a cell, round a window
  const auto window_of = [](const Index3& cell) {
    return Index3{cell[0] / kWindow, cell[1] / kWindow, cell[2] / kWindow};
  };
  double worst = 0.0;
  while (!cells.empty()) {
    const Index3 window = window_of(cells.back());
    Index3 low;
    Index3 high;
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = window[a] * kWindow;
      high[a] = low[a] + kWindow;
    }
    const SurfaceMesh part = clipped(surface, grid, low, high, kMargin);
    const auto here = std::partition(cells.begin(), cells.end(),
                                     [&](const Index3& cell) { return window_of(cell) != window; });
    for (auto cell = here; cell != cells.end(); ++cell) {
      worst = std::max(
          worst, std::abs(fraction_in(field, grid, *cell) - cell_fraction(part, grid, *cell)));
    }
    cells.erase(here, cells.end());
  }
  return worst;
}

void check_mesh(const SharedMesh& shared, const TriangleMesh& mesh, std::uint64_t seed) {
  Grid grid = grid_around(mesh, kGridCells - 2);
  grid.dims = {kGridCells, kGridCells, kGridCells};
  const FractionsFromMesh field = run(grid, mesh);
  const SurfaceMesh surface = to_cgal(mesh);
  REQUIRE(surface.number_of_faces() == mesh.triangles.size());
  Random random(seed);
  std::vector<Index3> cells = interfacial_cells(grid, field.fractions, random);
  REQUIRE(cells.size() >= kCells);
  cells.resize(kCells);
  const double worst = worst_difference(surface, grid, field, cells);
  const std::vector<Index3> slivers = sliver_cells(grid, mesh);
  const double worst_sliver = worst_difference(surface, grid, field, slivers);
  MESSAGE(std::string(shared.file)
          << ": largest difference " << worst << " in " << cells.size() << " random cells, "
          << worst_sliver << " in " << slivers.size() << " with slivers");
  CHECK(worst < 1e-11);
  CHECK(worst_sliver < 1e-11);
  CHECK(slivers.empty() == (std::string(shared.file) != "golfball_openscad_45k.off"));
}

}  // namespace

TEST_CASE("fractions agree with corefinement in random cells") {
  std::uint64_t seed = 1;
  for (const SharedMesh& shared : kSharedMeshes) {
    CAPTURE(std::string(shared.file));
    if (const auto mesh = shared_mesh(shared.file)) {
      check_mesh(shared, *mesh, seed++);
    }
  }
}

TEST_CASE("unions of tetrahedra agree with those of CGAL in each cell") {
  Random random(31);
  int crossing = 0;
  for (int trial = 0; trial < kUnions; ++trial) {
    CAPTURE(trial);
    const std::int64_t n = 1 + trial % 3;
    const double spacing = 3.0 / static_cast<double>(n);
    const Grid grid = make_grid({n, n, n}, {-1.5, -1.5, -1.5}, {spacing, spacing, spacing});
    TriangleMesh both;
    std::array<SurfaceMesh, 2> parts;
    for (SurfaceMesh& part : parts) {
      std::array<Vec3, 4> corners;
      for (Vec3& corner : corners) {
        corner = scaled(random.direction(), random.uniform(0.8, 1.45));
      }
      const TriangleMesh mesh = tetrahedron_mesh(corners);
      both.append(mesh);
      part = to_cgal(mesh);
    }
    SurfaceMesh united;
    REQUIRE(pmp::corefine_and_compute_union(parts[0], parts[1], united));
    const FractionsFromMesh result = run(grid, both);
    crossing += result.report.overlap.cells > 0 ? 1 : 0;
    CHECK(result.report.fraction_volume == doctest::Approx(pmp::volume(united)).epsilon(1e-12));
    CHECK(worst(grid, result.fractions,
                [&](const Index3& cell) { return cell_fraction(united, grid, cell); }) < 1e-11);
  }
  CHECK(crossing > kUnions / 2);
}
