#pragma once
// Marching cubes on the dual grid: connectivity by bits, vertices by number.

#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "difmesh/mesh.hpp"
#include "surface/dual_grid.hpp"

namespace difmesh::detail {

/// What a mesh will hold. Vertices are numbered in the order of their dual edges' ids, triangles in
/// that of the dual cells.
struct MeshCounts {
  std::vector<std::int64_t>
      vertex_start;  ///< first vertex of each row of nodes; the total at the end
  /// First triangle of each portion of rows of dual cells, which are named by their lower nodes
  /// (see rows_per_portion); the total at the end.
  std::vector<std::int64_t> triangle_start;
};
[[nodiscard]] MeshCounts count_mesh(const DualGrid& grid, Phases& phases);

/// Fills mesh.triangles.
void connect(const DualGrid& grid, const MeshCounts& counts, Phases& phases, Mesh& mesh);

}  // namespace difmesh::detail
