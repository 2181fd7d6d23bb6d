#pragma once
// The rule for columns of heights, for one column and for as many as a vector has lanes.
//
// A column is consistent if its cells, from the material's end on, are full ones first, then
// interfacial ones, then empty ones, at least one full and one empty. Only such columns have a
// height. See lanes.hpp about what may be called here.

#include "lanes/lanes.hpp"
#include "planes/kernels.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

// Cells of a column.
constexpr int kColumn = 2 * kColumnReach + 1;

// What fills cells, as signs of integers, which need no masks: negative where a cell is full, and
// where it is not empty.
template <class I>
struct Filled {
  I full;
  I some;
};

/// Of cells whose values are told by their places, integers in the same order; so are the limits.
template <class I, class Integer>
[[gnu::always_inline]] inline Filled<I> filled(const I& places, Integer least_full,
                                               Integer most_empty) {
  return {(I{} + (least_full - 1)) - places, (I{} + most_empty) - places};
}

// The three ways to be inconsistent: negative where it is so.

/// The material's end is not full.
template <class I>
[[gnu::always_inline]] inline I wrong_start(const Filled<I>& first) {
  return ~first.full;
}
/// From a cell to the next, full cells do not come before all others, or empty ones after all.
template <class I>
[[gnu::always_inline]] inline I wrong_order(const Filled<I>& cell, const Filled<I>& next) {
  return (next.full & ~cell.full) | (next.some & ~cell.some);
}
/// The other end is not empty.
template <class I>
[[gnu::always_inline]] inline I wrong_end(const Filled<I>& last) {
  return last.some;
}

/// Goes through columns cell by cell, from the material's end on.
template <class I>
struct ColumnCheck {
  I wrong{};  ///< negative where one of the columns so far is inconsistent
  Filled<I> last{};

  /// \param n the cell's number in its column, from 0
  [[gnu::always_inline]] void add(int n, const Filled<I>& cell) {
    wrong |= n == 0 ? wrong_start(cell) : wrong_order(last, cell);
    last = cell;
  }
  [[gnu::always_inline]] void end() { wrong |= wrong_end(last); }
};

// Heights: sums of the cells from both ends to the middle, the same from either side.
static_assert(kColumnReach == 4);

/// \param pairs of cells as far from the one end as from the other, from the ends on
template <class Pairs, class R>
[[gnu::always_inline]] inline R height_of_pairs(const Pairs& pairs, const R& middle) {
  return ((pairs[0] + pairs[2]) + (pairs[1] + pairs[3])) + middle;
}
template <class R>
[[gnu::always_inline]] inline R height_of(const R (&cells)[kColumn]) {
  const R pairs[4] = {cells[0] + cells[8], cells[1] + cells[7], cells[2] + cells[6],
                      cells[3] + cells[5]};
  return height_of_pairs(pairs, cells[4]);
}

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
