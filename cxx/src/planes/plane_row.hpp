#pragma once
// Planes of the flagged cells of one row.

#include <cstdint>

#include "grid/node_bits.hpp"
#include "planes/unit_plane.hpp"

namespace difmesh::detail {

/// Planes of one row, for a walk along it.
class PlaneRow {
 public:
  PlaneRow() = default;
  /// \param flags words of bits: the cells that have planes
  PlaneRow(const std::uint64_t* flags, const UnitPlane* planes) : flags_(flags), planes_(planes) {}

  /// Must be called for words 0, 1, 2 … in turn.
  void enter_word(std::int64_t w) {
    planes_ += in_word_;
    word_ = flags_[w];
    in_word_ = word_ != 0 ? count_bits(word_) : 0;
  }
  /// \pre the node at this bit of the word has a plane
  [[nodiscard]] const UnitPlane& at(int bit) const {
    return planes_[count_bits(word_ & below(bit))];
  }
  /// \pre the first node of the next word has a plane
  [[nodiscard]] const UnitPlane& first_of_next() const { return planes_[in_word_]; }

 private:
  const std::uint64_t* flags_ = nullptr;
  const UnitPlane* planes_ = nullptr;
  std::uint64_t word_ = 0;
  std::int64_t in_word_ = 0;
};

}  // namespace difmesh::detail
