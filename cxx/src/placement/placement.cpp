#include "placement/placement.hpp"

namespace difmesh::detail {

const PlacementPart& placement_part(Placement placement) {
  switch (placement) {
    case Placement::midpoint:
      return kMidpoint;
    case Placement::linear:
      return kLinear;
    case Placement::manson:
      return kManson;
    case Placement::plic:
      break;
  }
  return kPlic;
}

}  // namespace difmesh::detail
