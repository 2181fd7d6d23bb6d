#pragma once
// The cells around one, wherever they lie.

#include <array>
#include <cstddef>
#include <cstdint>

#include "grid/block_field.hpp"

namespace difmesh::detail {

/// The cells at up to kReach steps from one along all axes, by their indices in memory or what
/// stands beyond the sides.
template <std::int64_t kReach>
class CellsAround {
 public:
  /// \param reach at most kReach: what is further away is not there
  CellsAround(const BlockField& field, const Index3& cell, std::int64_t reach = kReach)
      : field_(field) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      resolved_[axis].fill(kMissing);
      for (std::int64_t step = -reach; step <= reach; ++step) {
        const auto at = static_cast<std::size_t>(step + kReach);
        resolved_[axis][at] = field.axes[axis].resolve(cell[axis] + step);
        const bool is_in_memory = is_cell(resolved_[axis][at]);
        offsets_[axis][at] =
            is_in_memory ? (resolved_[axis][at] - field.axes[axis].low) * field.view.strides[axis]
                         : 0;
        is_inside_ = is_inside_ && is_in_memory;
      }
    }
  }
  [[nodiscard]] bool is_there(std::size_t axis, std::int64_t step) const {
    return at(axis, step) != kMissing;
  }
  /// Along all axes.
  [[nodiscard]] bool is_there(const Index3& steps) const {
    return is_there(0, steps[0]) && is_there(1, steps[1]) && is_there(2, steps[2]);
  }
  /// \pre is_there(steps)
  [[nodiscard]] double fraction(const Index3& steps) const {
    if (!is_inside_) {
      return field_.fraction({at(0, steps[0]), at(1, steps[1]), at(2, steps[2])});
    }
    const std::int64_t offset =
        offset_of(0, steps[0]) + offset_of(1, steps[1]) + offset_of(2, steps[2]);
    return with_scalar(field_.view.type, [&](auto type) {
      return fraction_of(static_cast<const decltype(type)*>(field_.view.data)[offset]);
    });
  }

 private:
  [[nodiscard]] std::int64_t at(std::size_t axis, std::int64_t step) const {
    return resolved_[axis][static_cast<std::size_t>(step + kReach)];
  }
  [[nodiscard]] std::int64_t offset_of(std::size_t axis, std::int64_t step) const {
    return offsets_[axis][static_cast<std::size_t>(step + kReach)];
  }
  const BlockField& field_;
  bool is_inside_ = true;  // all within reach are cells in memory
  std::array<std::array<std::int64_t, std::size_t{2 * kReach + 1}>, 3> resolved_;
  std::array<std::array<std::int64_t, std::size_t{2 * kReach + 1}>, 3> offsets_;
};

}  // namespace difmesh::detail
