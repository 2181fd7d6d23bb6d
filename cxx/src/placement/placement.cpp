#include "placement/placement.hpp"

#include <algorithm>

#include "difmesh/block.hpp"
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
    case Placement::curved:
      return kCurved;
    case Placement::plic:
      break;
  }
  return kPlic;
}

std::int64_t layers_read(const Options& options) {
  const PlacementPart& placement = placement_part(options.placement);
  const bool with_planes = placement.by_planes || options.vertex_normals;
  const std::int64_t by_planes =
      placement.reach + (with_planes ? stencil_reach(options.normals) : 0);
  return placement.by_surfaces ? std::max(by_planes, kCurvedGhostLayers) : by_planes;
}

}  // namespace difmesh::detail
