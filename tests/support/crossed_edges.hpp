#pragma once
/// \file crossed_edges.hpp
/// The dual edges under the vertices of a reconstruction, as Algorithm 1 sees them.

#include <cstdint>
#include <span>
#include <vector>

#include "difmesh/grid.hpp"
#include "difmesh/options.hpp"
#include "support/algorithm1.hpp"

namespace difmesh::test {

/// The crossed edge of each name, with the library's planes of its two cells. A cell without
/// gradient has its plane across the edge.
/// \param fractions one per cell in [0,1], x fastest \param edge_ids as of Mesh::edge_ids; both
///   ends of each edge lie within the grid
[[nodiscard]] std::vector<CrossedEdge> crossed_edges(std::span<const double> fractions,
                                                     const Grid& grid, const Options& options,
                                                     std::span<const std::uint64_t> edge_ids);

/// Where a vertex stands on its edge: 0 at the outer cell's centre, 1 at the inner one's.
[[nodiscard]] double share_along(const CrossedEdge& edge, std::uint64_t edge_id, const Grid& grid,
                                 const Vec3& position);

}  // namespace difmesh::test
