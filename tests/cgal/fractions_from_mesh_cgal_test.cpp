// Cross-check with CGAL's corefinement. PMP is under the GPL: for tests only.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>

#include <algorithm>
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
constexpr int kCells = 10;
#else
constexpr int kCells = 220;
#endif
constexpr std::int64_t kReach = 2;  // cells on each side of the one in the middle of a window
constexpr double kMargin = 0.37;    // of a cell, round a window

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

bool near(const Index3& a, const Index3& b) {
  return std::abs(a[0] - b[0]) <= kReach && std::abs(a[1] - b[1]) <= kReach &&
         std::abs(a[2] - b[2]) <= kReach;
}

/// Clips whole meshes only to windows of some cells, and the windows to the cells.
void check_mesh(const TriangleMesh& mesh, std::uint64_t seed) {
  const Grid grid = grid_around(mesh, 30);
  const FractionsFromMesh result = run(grid, mesh);
  const SurfaceMesh surface = to_cgal(mesh);
  REQUIRE(surface.number_of_faces() == mesh.triangles.size());
  Random random(seed);
  std::vector<Index3> cells = interfacial_cells(grid, result.fractions, random);
  double worst_difference = 0.0;
  for (int checked = 0; checked < kCells && !cells.empty();) {
    const Index3 middle = cells.back();
    const SurfaceMesh window =
        clipped(surface, grid, {middle[0] - kReach, middle[1] - kReach, middle[2] - kReach},
                {middle[0] + kReach + 1, middle[1] + kReach + 1, middle[2] + kReach + 1}, kMargin);
    const auto rest = std::partition(cells.begin(), cells.end(),
                                     [&](const Index3& cell) { return !near(cell, middle); });
    for (auto cell = rest; cell != cells.end() && checked < kCells; ++cell, ++checked) {
      const std::int64_t row = (*cell)[2] * grid.dims[1] + (*cell)[1];
      const double ours =
          result.fractions[static_cast<std::size_t>(row * grid.dims[0] + (*cell)[0])];
      worst_difference =
          std::max(worst_difference, std::abs(ours - cell_fraction(window, grid, *cell)));
    }
    cells.erase(rest, cells.end());
  }
  MESSAGE("largest difference: " << worst_difference);
  CHECK(worst_difference < 1e-11);
}

}  // namespace

TEST_CASE("fractions agree with corefinement in random cells") {
  std::uint64_t seed = 1;
  for (const SharedMesh& shared : kSharedMeshes) {
    CAPTURE(std::string(shared.file));
    if (const auto mesh = shared_mesh(shared.file)) {
      check_mesh(*mesh, seed++);
    }
  }
}
