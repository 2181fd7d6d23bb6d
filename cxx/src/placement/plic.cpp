// E19: the half-full window. Edges are solved in batches by kernels, those at the sides of the
// domain one by one: see surface/window_queue.hpp and planes/window.hpp.

#include "placement/placement.hpp"

namespace difmesh::detail {

const PlacementPart kPlic{true, false, 1, nullptr};

}  // namespace difmesh::detail
