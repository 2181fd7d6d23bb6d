#pragma once
// Moves vertices from where the window puts them to the curved surfaces of the cells.

#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "curved/surface_table.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"
#include "surface/dual_grid.hpp"

namespace difmesh::detail {

/// \pre the vertices are placed by the window: see place_vertices()
/// \return how many of those on edges that the block owns were moved
std::int64_t curve_vertices(const SurfaceTable& table, const DualGrid& grid, const Options& options,
                            const std::vector<std::int64_t>& row_start, Phases& phases, Mesh& mesh);

}  // namespace difmesh::detail
