#include "placement/placement.hpp"

#include "planes/normal_stencil.hpp"

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

std::int64_t ghost_layers(const Options& options) {
  const PlacementPart& placement = placement_part(options.placement);
  const bool with_planes = placement.by_planes || options.vertex_normals;
  return placement.reach + (with_planes ? stencil_reach(options.normals) : 0);
}

}  // namespace difmesh::detail
