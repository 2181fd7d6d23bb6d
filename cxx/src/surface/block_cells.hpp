#pragma once
// Which nodes of a block are cells of their own, and which of these are outermost ones.

#include <cstdint>

#include "grid/block_field.hpp"
#include "grid/node_bits.hpp"

namespace difmesh::detail {

/// The cells of a block that are cells of their own, by local index: 1 to last, the next block's
/// first layer included. The outermost ones are 1, dims and last.
struct BlockCells {
  Index3 dims;
  Index3 last;

  explicit BlockCells(const BlockField& field);
  [[nodiscard]] bool is_row(std::int64_t j, std::int64_t k) const {
    return j >= 1 && k >= 1 && j <= last[1] && k <= last[2];
  }
  /// True if the row is the block's own, not a next block's. \pre is_row(j, k)
  [[nodiscard]] bool is_own_row(std::int64_t j, std::int64_t k) const {
    return j <= dims[1] && k <= dims[2];
  }
  /// True if all cells of the row are outermost ones.
  [[nodiscard]] bool is_outermost(std::int64_t j, std::int64_t k) const {
    return j == 1 || k == 1 || j >= dims[1] || k >= dims[2];
  }
  /// Bits of the cells between the outermost ones.
  [[nodiscard]] std::uint64_t inner(std::int64_t w) const {
    return NodeBits::range(w, 2, dims[0] - 1);
  }
};

}  // namespace difmesh::detail
