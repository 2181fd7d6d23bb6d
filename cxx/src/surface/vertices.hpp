#pragma once
// One vertex for each crossed dual edge.

#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"
#include "difmesh/reconstruct.hpp"
#include "surface/dual_grid.hpp"

namespace difmesh::detail {

/// Fills positions and, as the options ask, normals and edge ids of the mesh. Adds the facts about
/// edges to the report; report.closed becomes false where an edge lies on the end of the dual grid.
void place_vertices(const DualGrid& grid, const Options& options,
                    const std::vector<std::int64_t>& row_start, Phases& phases, Mesh& mesh,
                    Report& report);

}  // namespace difmesh::detail
