// The curved surfaces of the cells (curved/surface_table.hpp), and where these have nothing to say,
// the half-full window.

#include "placement/placement.hpp"

namespace difmesh::detail {

const PlacementPart kCurved{true, true, 1, nullptr};

}  // namespace difmesh::detail
