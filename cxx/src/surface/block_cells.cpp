#include "surface/block_cells.hpp"

namespace difmesh::detail {

BlockCells::BlockCells(const BlockField& field) : dims(field.block.dims) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The node after the block is a cell unless it lies on or beyond a side of the domain.
    const std::int64_t end = field.block.offset[axis] + field.block.dims[axis];
    const bool goes_on =
        end < field.grid.dims[axis] || field.boundary[2 * axis + 1] == Side::periodic;
    last[axis] = field.block.dims[axis] + (goes_on ? 1 : 0);
  }
}

}  // namespace difmesh::detail
