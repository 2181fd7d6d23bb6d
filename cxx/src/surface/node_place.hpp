#pragma once
// Where the nodes of the dual grid lie in the cells that they stand for.

#include "grid/block_field.hpp"

namespace difmesh::detail {

/// A surface's function this near to 0 at a node leaves it inside.
inline constexpr double kOnNode = 1e-12;

/// The cell that a node is the centre of, by its global index, or on whose open or mirrored domain
/// face it lies; and where, from the centre.
struct NodePlace {
  Index3 cell{0, 0, 0};
  Vec3 from_centre{0.0, 0.0, 0.0};
};
[[nodiscard]] inline NodePlace place_of(const BlockField& field, const Index3& node) {
  NodePlace place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t index = node[axis] - 1 + field.block.offset[axis];
    const std::int64_t count = field.grid.dims[axis];
    place.cell[axis] = index;
    if (index < 0 || index >= count) {
      const Side side = field.boundary[2 * axis + (index < 0 ? 0 : 1)];
      if (side == Side::open || side == Side::mirror) {
        place.cell[axis] = index < 0 ? 0 : count - 1;
        place.from_centre[axis] =
            (index < 0 ? -0.5 : 0.5) * field.grid.width(axis, place.cell[axis]);
      }
    }
  }
  return place;
}

/// How much the upper end's surface has to say of a point of the edge: 0 and 1 at the ends, and
/// such between them that the errors of the third order of two neighbours' polynomials cancel.
[[nodiscard]] inline double blend(double share) {
  return share * (share * share - 1.25) / (3.0 * share * share - 3.0 * share - 0.25);
}

}  // namespace difmesh::detail
