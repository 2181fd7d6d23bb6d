#include "placement/placement.hpp"

namespace difmesh::detail {

const PlacementPart kMidpoint{false, [](double, double) { return 0.5; }};

}  // namespace difmesh::detail
