#include "column_sums.hpp"

#include <algorithm>
#include <cmath>

namespace difmesh::detail {

void RowFacts::merge(const RowFacts& other) noexcept {
  pieces += other.pieces;
  cells_touched += other.cells_touched;
  full_cells += other.full_cells;
  touched_fractions += other.touched_fractions;
  lowest_raw = std::min(lowest_raw, other.lowest_raw);
  highest_raw = std::max(highest_raw, other.highest_raw);
  largest_gap = std::max(largest_gap, other.largest_gap);
}

ColumnSums::ColumnSums(std::int64_t rows, std::int64_t cells_per_row)
    : cells_(cells_per_row),
      slots_per_row_(cells_per_row + 2),
      words_per_row_((slots_per_row_ + 63) / 64),
      slots_(static_cast<std::size_t>(rows * slots_per_row_)),
      touched_(static_cast<std::size_t>(rows * words_per_row_)) {}

/// Writes the cells of one row from low to high x. A point is inside as often as surface lies
/// before it in its column facing back, less the surface facing forth; so areas count negatively.
class ColumnSums::RowWriter {
 public:
  RowWriter(const RowRules& rules, double* fractions, RowFacts& facts)
      : rules_(rules), fractions_(fractions), facts_(facts) {}

  /// Cells without a piece, up to but not including `end`. What lies before them in the column is
  /// bounded by the column's walls alone, and then its area is a whole number.
  void fill_to(std::int64_t end) {
    if (next_ == end) {
      return;
    }
    const double sum = rules_.sign * from_units(running_);
    const double whole = std::nearbyint(sum);
    const double gap = std::abs(sum - whole);
    facts_.largest_gap = std::max(facts_.largest_gap, gap);
    if (gap > rules_.tolerance) {
      note(ColumnFault::Kind::gap, sum - whole);
    } else if (whole != 0.0 && whole != 1.0) {
      note(ColumnFault::Kind::winding, whole);
    } else {
      running_ = to_units(rules_.sign * whole);
    }
    std::fill(fractions_ + next_, fractions_ + end, whole);
    facts_.full_cells += whole == 1.0 ? end - next_ : 0;
    next_ = end;
  }

  /// The next cell, which has pieces.
  void write_touched(const Slot& sums) {
    const double raw = rules_.sign * from_units(running_ - sums.beyond);
    facts_.lowest_raw = std::min(facts_.lowest_raw, raw);
    facts_.highest_raw = std::max(facts_.highest_raw, raw);
    if (raw < -rules_.tolerance || raw > 1.0 + rules_.tolerance) {
      note(ColumnFault::Kind::winding, raw);
    }
    double fraction = raw;
    if (raw <= rules_.snap) {
      fraction = 0.0;
    } else if (raw >= 1.0 - rules_.snap) {
      fraction = 1.0;
    }
    fractions_[next_++] = fraction;
    facts_.touched_fractions += fraction;
    ++facts_.cells_touched;
  }

  void pass(const Slot& sums) {
    running_ -= sums.area;
    total_ -= sums.area;
  }

  /// Over the whole column, before, in and after the grid, areas cancel wherever the mesh is
  /// closed.
  ColumnFault finish() {
    const double gap = from_units(total_);
    facts_.largest_gap = std::max(facts_.largest_gap, std::abs(gap));
    if (std::abs(gap) > rules_.tolerance) {
      return {ColumnFault::Kind::gap, fault_.x, gap};
    }
    return fault_;
  }

 private:
  void note(ColumnFault::Kind kind, double value) {
    if (fault_.kind == ColumnFault::Kind::none) {
      fault_ = {kind, next_, value};
    }
  }

  const RowRules& rules_;
  double* fractions_;
  RowFacts& facts_;
  std::int64_t next_ = 0;      ///< first cell not yet written
  std::uint64_t running_ = 0;  ///< rounded to a whole number wherever it has to be one
  std::uint64_t total_ = 0;    ///< never rounded
  ColumnFault fault_;
};

ColumnFault ColumnSums::drain(std::int64_t row, const RowRules& rules, double* fractions,
                              RowFacts& facts) {
  Slot* slots = slots_.data() + row * slots_per_row_;
  std::uint64_t* touched = touched_.data() + row * words_per_row_;
  RowWriter writer(rules, fractions, facts);
  for (std::int64_t word = 0; word < words_per_row_; ++word) {
    for (std::uint64_t bits = touched[word]; bits != 0; bits &= bits - 1) {
      const std::int64_t slot = word * 64 + std::countr_zero(bits);
      if (slot > 0) {
        writer.fill_to(slot - 1);
        if (slot <= cells_) {
          writer.write_touched(slots[slot]);
        }
      }
      writer.pass(slots[slot]);
      slots[slot] = {};
    }
    touched[word] = 0;
  }
  writer.fill_to(cells_);
  return writer.finish();
}

}  // namespace difmesh::detail
