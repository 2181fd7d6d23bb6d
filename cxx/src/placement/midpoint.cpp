#include "placement/placement.hpp"

namespace difmesh::detail {
namespace {

double midpoint_position(double, double) {
  return 0.5;
}

}  // namespace

const PlacementPart kMidpoint{false, false, 1, place_each<midpoint_position>};

}  // namespace difmesh::detail
