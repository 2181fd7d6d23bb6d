#pragma once
/// \file mesh_field.hpp
/// What the tests of fractions_from_mesh() share.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "difmesh/fractions_from_mesh.hpp"
#include "support/triangle_meshes.hpp"

namespace difmesh::test {

[[nodiscard]] inline Grid make_grid(const Index3& dims, const Vec3& origin = {0, 0, 0},
                                    const Vec3& spacing = {1, 1, 1}) {
  Grid grid;
  grid.dims = dims;
  grid.origin = origin;
  grid.spacing = spacing;
  return grid;
}

[[nodiscard]] inline FractionsFromMesh run(const Grid& grid, const TriangleMesh& mesh,
                                           const FractionsFromMeshOptions& options = {}) {
  return fractions_from_mesh(grid, mesh.positions, mesh.triangles, options);
}

[[nodiscard]] inline double low_of(const Grid& grid, std::size_t axis, std::int64_t index) {
  return grid.origin[axis] + static_cast<double>(index) * grid.spacing[axis];
}

/// Calls check(cell, fraction) for all cells.
template <class Check>
void for_cells(const Grid& grid, const Array<double>& fractions, const Check& check) {
  REQUIRE(fractions.size() == static_cast<std::size_t>(grid.cell_count()));
  std::size_t n = 0;
  for (std::int64_t k = 0; k < grid.dims[2]; ++k) {
    for (std::int64_t j = 0; j < grid.dims[1]; ++j) {
      for (std::int64_t i = 0; i < grid.dims[0]; ++i) {
        check(Index3{i, j, k}, fractions[n++]);
      }
    }
  }
}

/// Largest distance of the fractions from what expected(cell) says.
template <class Expected>
[[nodiscard]] double worst(const Grid& grid, const Array<double>& fractions,
                           const Expected& expected) {
  double largest = 0.0;
  for_cells(grid, fractions, [&](const Index3& cell, double fraction) {
    largest = std::max(largest, std::abs(fraction - static_cast<double>(expected(cell))));
  });
  return largest;
}

struct SharedMesh {
  const char* file;
  double volume;
};
inline constexpr std::array<SharedMesh, 4> kSharedMeshes = {
    {{"bunny00_75k.off", 0.1992055537},
     {"golfball_openscad_45k.off", 3.704174810},
     {"fandisk_cgal.off", 0.1403603163},
     {"knot1_genus1.off", 0.09517472677}}};

[[nodiscard]] inline std::optional<TriangleMesh> shared_mesh(const std::string& file) {
  auto mesh = read_off(std::string(DIFMESH_SHARED_DATA) + "/" + file);
  if (!mesh) {
    MESSAGE("skipped: " << file << " is not in " << DIFMESH_SHARED_DATA);
  }
  return mesh;
}

/// A grid round a mesh with this many cells along its longest side, and a margin.
[[nodiscard]] inline Grid grid_around(const TriangleMesh& mesh, std::int64_t cells) {
  const auto [low, high] = corners_of_box_round(mesh);
  const Vec3 size = subtract(high, low);
  const double spacing = *std::max_element(size.begin(), size.end()) / static_cast<double>(cells);
  Grid grid;
  for (std::size_t a = 0; a < 3; ++a) {
    grid.spacing[a] = spacing;
    grid.dims[a] = static_cast<std::int64_t>(std::ceil(size[a] / spacing)) + 2;
    grid.origin[a] = low[a] - 0.7 * spacing;
  }
  return grid;
}

}  // namespace difmesh::test
