#pragma once
// What the pieces of a mesh add to the cells of a few rows, and the running sums that turn it into
// fractions.

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/grid.hpp"
#include "sampling/cell_overlaps.hpp"

namespace difmesh::detail {

/// What a column of cells can reveal about a mesh.
struct ColumnFault {
  enum class Kind : std::uint8_t {
    none,
    gap,        ///< the areas over the whole column do not cancel: the mesh is open
    winding,    ///< a cell is covered twice or more, or negatively, where that is refused
    undecided,  ///< or may be
  };
  Kind kind = Kind::none;
  std::int64_t x = 0;  ///< cell in the row; for gaps too, where they show first
  double value = 0.0;  ///< the gap; the share that is covered again, or less what is inverted
};

/// Cells with something in them that should not be there.
struct MarkedCells {
  double sum = 0.0;  ///< over the cells, in cells
  std::int64_t count = 0;
  double largest = 0.0;
  Index3 where{0, 0, 0};  ///< the first cell with the largest
  Index3 low{0, 0, 0};    ///< box of cells low..high
  Index3 high{-1, -1, -1};

  void note(const Index3& from, std::int64_t cells, double share) noexcept;
  void merge(const MarkedCells& other) noexcept;
};

/// Facts gathered while rows are turned into fractions.
struct RowFacts {
  std::int64_t pieces = 0;
  std::int64_t cells_touched = 0;
  std::int64_t full_fractions = 0;  ///< sum of γ over the cells without a piece
  double touched_fractions = 0.0;   ///< and over the others
  double lowest_raw = 0.0;
  double highest_raw = 1.0;
  double largest_gap = 0.0;
  MarkedCells overlaps;
  MarkedCells inverted;
  MarkedCells undecided;

  void merge(const RowFacts& other) noexcept;
};

/// How raw values become fractions.
struct RowRules {
  double sign = 1.0;       ///< -1 for a mesh turned inside out
  double tolerance = 0.0;  ///< for gaps, and where it is refused for covering twice
  double rounding = 0.0;   ///< shares of a cell that are covered twice by rounding alone
  double snap = 0.0;       ///< fractions this close to 0 or 1 become 0 or 1
  Overlaps overlaps = Overlaps::unite;
};

/// One row of cells, as drain() is to fill it.
struct RowOutput {
  Index3 first;  ///< its first cell
  double* fractions;
  CellOverlaps& overlaps;
  RowFacts& facts;
};

/// Sums over the pieces in rows of cells along x. Each row has one slot before the grid, one per
/// cell and one after it.
///
/// Sums are integers, in units of 2^-56 cells: adding integers is associative, so they do not
/// depend on the order of the pieces, and no sum is less accurate for having many terms. Integers
/// that wrap round still end right as long as the last sum is within +-128, more than a hundred
/// sheets of surface on top of each other.
class ColumnSums {
 public:
  ColumnSums(std::int64_t rows, std::int64_t cells_per_row);

  /// Adds a piece with this signed area, in faces of a cell, and this signed volume beyond it in
  /// its cell. \param slot 0: before the grid, 1 + x: in cell x, 1 + cells per row: after the grid
  void add(std::int64_t row, std::int64_t slot, double area, double beyond) noexcept {
    Slot& sums = slots_[static_cast<std::size_t>(row * slots_per_row_ + slot)];
    sums.area += to_units(area);
    sums.beyond += to_units(beyond);
    touched_[static_cast<std::size_t>(row * words_per_row_ + slot / 64)] |= std::uint64_t{1}
                                                                            << (slot % 64);
  }

  /// Turns one row into fractions and clears it. Returns the first fault.
  ColumnFault drain(std::int64_t row, const RowRules& rules, const RowOutput& output);

 private:
  struct Slot {
    std::uint64_t area = 0;
    std::uint64_t beyond = 0;
  };

  static constexpr double kUnit = 0x1p-56;

  static std::uint64_t to_units(double value) noexcept {
    const double scaled = value * (1.0 / kUnit);
    return static_cast<std::uint64_t>(
        static_cast<std::int64_t>(scaled + (scaled < 0 ? -0.5 : 0.5)));
  }
  static double from_units(std::uint64_t units) noexcept {
    return static_cast<double>(static_cast<std::int64_t>(units)) * kUnit;
  }

  class RowWriter;

  std::int64_t cells_;
  std::int64_t slots_per_row_;
  std::int64_t words_per_row_;
  std::vector<Slot> slots_;
  std::vector<std::uint64_t> touched_;  ///< one bit per slot
};

}  // namespace difmesh::detail
