#pragma once
// Which triangles have a piece in which cell of a few rows.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace difmesh::detail {

/// A list of triangles for each slot of each row; slots are those of ColumnSums.
class PieceLists {
 public:
  PieceLists(std::int64_t rows, std::int64_t slots_per_row)
      : slots_per_row_(slots_per_row), last_(static_cast<std::size_t>(rows * slots_per_row)) {}

  void add(std::int64_t row, std::int64_t slot, std::uint32_t triangle) {
    const auto place = static_cast<std::size_t>(row * slots_per_row_ + slot);
    std::uint32_t& last = last_[place];
    entries_.push_back({place, triangle, last});
    last = static_cast<std::uint32_t>(entries_.size());
  }

  /// Triangles of a slot, in no particular order; none where no piece was added.
  void append_triangles(std::int64_t row, std::int64_t slot,
                        std::vector<std::uint32_t>& triangles) const {
    std::uint32_t place = last_[static_cast<std::size_t>(row * slots_per_row_ + slot)];
    for (; place != 0; place = entries_[place - 1].before) {
      triangles.push_back(entries_[place - 1].triangle);
    }
  }

  [[nodiscard]] bool has_one(std::int64_t row, std::int64_t slot) const {
    const std::uint32_t last = last_[static_cast<std::size_t>(row * slots_per_row_ + slot)];
    return last != 0 && entries_[last - 1].before == 0;
  }

  void clear() {
    for (const Entry& entry : entries_) {
      last_[entry.place] = 0;
    }
    entries_.clear();
  }

 private:
  struct Entry {
    std::size_t place;  ///< in last_
    std::uint32_t triangle;
    std::uint32_t before;  ///< place + 1 of the entry before in the same slot
  };

  std::int64_t slots_per_row_;
  std::vector<std::uint32_t> last_;  ///< place + 1 of each slot's last entry
  std::vector<Entry> entries_;
};

}  // namespace difmesh::detail
