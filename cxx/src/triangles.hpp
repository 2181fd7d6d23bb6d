#pragma once
// Marching cubes on the dual grid: connectivity by bits, vertices by number.

#include <cstdint>
#include <vector>

#include "difmesh/mesh.hpp"
#include "dual_grid.hpp"
#include "parallel.hpp"

namespace difmesh::detail {

/// Number of the first triangle of each row of dual cells (named by their lower nodes); the total
/// at the end.
[[nodiscard]] std::vector<std::int64_t> count_triangles(
    const DualGrid& grid, const std::vector<std::int64_t>& vertex_start, Phases& phases);

/// Fills mesh.triangles, in the order of the dual cells.
void connect(const DualGrid& grid, const std::vector<std::int64_t>& vertex_start,
             const std::vector<std::int64_t>& triangle_start, Phases& phases, Mesh& mesh);

/// Volume inside a closed mesh, by the divergence theorem from a level in z near it. Summed in fixed
/// portions.
[[nodiscard]] double enclosed_volume(const Mesh& mesh, double level, Phases& phases);

}  // namespace difmesh::detail
