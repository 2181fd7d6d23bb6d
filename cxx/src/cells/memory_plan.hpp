#pragma once
// What a reconstruction will need of memory, asked for before the field is read: a pass over a
// field whose surface cannot be kept may take minutes.

#include <atomic>
#include <cstdint>
#include <limits>

#include "grid/block_field.hpp"

namespace difmesh::detail {

/// \throw OutOfMemory if what is needed whatever the field holds cannot be had, Error too_large if
/// no machine has it. Both name the cells.
void check_memory(const BlockField& field);

/// Counts the planes that interfacial cells along open sides will need, and throws when there will
/// be no memory for them. Thread safety: add() may be called concurrently.
class LayerPlanes {
 public:
  /// Limits nothing.
  LayerPlanes() = default;
  /// Limits nothing either where there is memory for a plane in each of these cells.
  /// \param wanted whether such planes will be made
  LayerPlanes(const BlockField& field, bool wanted);

  [[nodiscard]] bool is_limited() const { return limit_ != kNoLimit; }
  /// True for rows of the block's cells, counted from 0, in a layer along an open side in y or z.
  [[nodiscard]] bool has_row(std::int64_t j, std::int64_t k) const;
  /// \throw OutOfMemory
  void add(std::int64_t planes);

 private:
  static constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

  const BlockField* field_ = nullptr;
  std::int64_t limit_ = kNoLimit;
  std::atomic<std::int64_t> planes_ = 0;
};

/// What a phase was about to make when it ran out of memory. \throw OutOfMemory
[[noreturn]] void fail_memory(const BlockField& field, const char* what);

}  // namespace difmesh::detail
