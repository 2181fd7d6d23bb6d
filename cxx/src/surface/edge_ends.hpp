#pragma once
// Which nodes of a row are ends of crossed dual edges.

#include <cstdint>

#include "grid/node_bits.hpp"

namespace difmesh::detail {

/// Flags the ends of the crossed edges in a row of nodes: those that differ from a neighbour.
class EdgeEnds {
 public:
  EdgeEnds(const NodeBits& nodes, std::int64_t j, std::int64_t k);

  /// True if there are none, as far as that is known without a look at the bits.
  [[nodiscard]] bool are_none() const { return are_none_; }
  [[nodiscard, gnu::always_inline]] std::uint64_t word(std::int64_t w) const {
    const std::uint64_t here = here_[w];
    const std::uint64_t across =
        ((here ^ south_[w]) | (here ^ north_[w])) | ((here ^ below_[w]) | (here ^ above_[w]));
    const std::uint64_t crossed = nodes_->crossed_x(here_, w);
    const std::uint64_t from_west = w > 0 ? (here_[w - 1] >> 63 ^ here) & 1 : 0;
    return across | crossed | crossed << 1 | from_west;
  }

 private:
  const NodeBits* nodes_;
  const std::uint64_t* here_;
  const std::uint64_t* south_;
  const std::uint64_t* north_;
  const std::uint64_t* below_;
  const std::uint64_t* above_;
  bool are_none_;
};

}  // namespace difmesh::detail
