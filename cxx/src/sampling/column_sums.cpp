#include "sampling/column_sums.hpp"

#include <algorithm>
#include <cmath>

namespace difmesh::detail {

void MarkedCells::note(const Index3& from, std::int64_t cells, double share) noexcept {
  const Index3 to{from[0] + cells - 1, from[1], from[2]};
  merge({share * static_cast<double>(cells), cells, share, from, from, to});
}

void MarkedCells::merge(const MarkedCells& other) noexcept {
  if (other.count == 0) {
    return;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = count == 0 ? other.low[a] : std::min(low[a], other.low[a]);
    high[a] = std::max(high[a], other.high[a]);
  }
  if (other.largest > largest) {
    largest = other.largest;
    where = other.where;
  }
  sum += other.sum;
  count += other.count;
}

void RowFacts::merge(const RowFacts& other) noexcept {
  pieces += other.pieces;
  cells_touched += other.cells_touched;
  full_fractions += other.full_fractions;
  touched_fractions += other.touched_fractions;
  lowest_raw = std::min(lowest_raw, other.lowest_raw);
  highest_raw = std::max(highest_raw, other.highest_raw);
  largest_gap = std::max(largest_gap, other.largest_gap);
  overlaps.merge(other.overlaps);
  inverted.merge(other.inverted);
  undecided.merge(other.undecided);
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
  RowWriter(std::int64_t row, const RowRules& rules, const RowOutput& output)
      : row_(row), rules_(rules), out_(output) {}

  /// Cells without a piece, up to but not including `end`. What lies before them in the column is
  /// bounded by the column's walls alone, and then its area is a whole number.
  void fill_to(std::int64_t end) {
    if (next_ == end) {
      return;
    }
    const double sum = rules_.sign * from_units(running_);
    const double whole = std::nearbyint(sum);
    const double gap = std::abs(sum - whole);
    out_.facts.largest_gap = std::max(out_.facts.largest_gap, gap);
    if (gap > rules_.tolerance) {
      note(ColumnFault::Kind::gap, sum - whole);
    } else {
      running_ = to_units(rules_.sign * whole);
    }
    double fraction = whole;
    if (whole != 0.0 && whole != 1.0) {
      note_raw(whole);
      fraction = settle(end - next_, whole, from_sum(1.0, whole));
    }
    std::fill(out_.fractions + next_, out_.fractions + end, fraction);
    out_.facts.full_fractions += static_cast<std::int64_t>(fraction) * (end - next_);
    next_ = end;
    run_first_ = end + 1;
    base_ = whole;
  }

  /// The next cell, which has pieces.
  void write_touched(const Slot& sums) {
    const double raw = rules_.sign * from_units(running_ - sums.beyond);
    note_raw(raw);
    const bool within = raw >= -rules_.rounding && raw <= 1.0 + rules_.rounding;
    double fraction = raw;
    if (!out_.overlaps.is_plain(row_, next_ + 1)) {
      fraction = settle(1, raw, out_.overlaps.resolve({row_, run_first_, next_ + 1, base_}));
    } else if (!within) {
      fraction = settle(1, raw, from_sum(1.0, raw));
    }
    fraction = snapped(fraction);
    out_.fractions[next_++] = fraction;
    out_.facts.touched_fractions += fraction;
    ++out_.facts.cells_touched;
  }

  void pass(const Slot& sums) {
    running_ -= sums.area;
    total_ -= sums.area;
  }

  /// Over the whole column, before, in and after the grid, areas cancel wherever the mesh is
  /// closed.
  ColumnFault finish() {
    const double gap = from_units(total_);
    out_.facts.largest_gap = std::max(out_.facts.largest_gap, std::abs(gap));
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
  void note_raw(double raw) {
    out_.facts.lowest_raw = std::min(out_.facts.lowest_raw, raw);
    out_.facts.highest_raw = std::max(out_.facts.highest_raw, raw);
  }

  /// The fraction of the next cells, which are alike. The sum is better than what was resolved
  /// wherever nothing is covered twice.
  double settle(std::int64_t cells, double raw, const Covered& covered) {
    const Index3 from{out_.first[0] + next_, out_.first[1], out_.first[2]};
    const bool overlap = covered.again > rules_.rounding;
    const bool inverted = covered.inverted > rules_.rounding;
    if (overlap) {
      out_.facts.overlaps.note(from, cells, covered.again);
    }
    if (inverted) {
      out_.facts.inverted.note(from, cells, covered.inverted);
    }
    if (covered.undecided > rules_.rounding) {
      out_.facts.undecided.note(from, cells, covered.undecided);
    }
    if (rules_.overlaps == Overlaps::refuse) {
      const double wrong = std::max(covered.again, covered.inverted);
      if (wrong > rules_.tolerance) {
        note(ColumnFault::Kind::winding, overlap ? covered.again : -covered.inverted);
      } else if (wrong + covered.undecided > rules_.tolerance) {
        note(ColumnFault::Kind::undecided, covered.undecided);
      }
    }
    return rules_.overlaps != Overlaps::count && (overlap || inverted) ? covered.once : raw;
  }

  [[nodiscard]] double snapped(double fraction) const {
    if (std::abs(fraction - 1.0) <= rules_.snap) {
      return 1.0;
    }
    if (std::abs(fraction) <= rules_.snap) {
      return 0.0;
    }
    return rules_.overlaps == Overlaps::count ? fraction : std::clamp(fraction, 0.0, 1.0);
  }

  const std::int64_t row_;
  const RowRules& rules_;
  const RowOutput& out_;
  std::int64_t next_ = 0;       ///< first cell not yet written
  std::int64_t run_first_ = 0;  ///< first slot after the last cells without a piece
  double base_ = 0.0;           ///< winding number in those
  std::uint64_t running_ = 0;   ///< rounded to a whole number wherever it has to be one
  std::uint64_t total_ = 0;     ///< never rounded
  ColumnFault fault_;
};

ColumnFault ColumnSums::drain(std::int64_t row, const RowRules& rules, const RowOutput& output) {
  Slot* slots = slots_.data() + row * slots_per_row_;
  std::uint64_t* touched = touched_.data() + row * words_per_row_;
  RowWriter writer(row, rules, output);
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
