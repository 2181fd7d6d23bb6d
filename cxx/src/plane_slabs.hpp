#pragma once
// Planes of whole rows, for a walk through the block slab by slab: those between the outermost layers are computed
// when they are needed and forgotten after, so that they stay in the cache and take no memory.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "dual_grid.hpp"
#include "plane_fitter.hpp"
#include "plane_table.hpp"
#include "stopwatch.hpp"

namespace difmesh::detail {

/// Two slabs of rows, k and k + 1. One per thread.
template <class T>
class PlaneSlabs {
 public:
  PlaneSlabs(const FitterPlan<T>& plan, const DualGrid& grid)
      : grid_(grid),
        cells_(grid.field()),
        fitter_(plan, grid.nodes()),
        words_(grid.nodes().words()),
        no_flags_(static_cast<std::size_t>(words_), 0),
        inner_(no_flags_) {}

  /// \param k the first slab asked for, or the one after the last
  void move_to(std::int64_t k) {
    if (k != current_ + 1) {
      fill(k);
    }
    std::swap(lower_, upper_);
    counts_.add(lower_.counts);
    planes_ += lower_.inner_planes;
    current_ = k;
    if (k < grid_.nodes().last()[2]) {
      fill(k + 1);
    }
  }

  /// A row of the current slab or of the one above.
  [[nodiscard]] PlaneRow row(std::int64_t j, std::int64_t k) const {
    const std::int64_t number = grid_.nodes().row_index(j, k);
    const auto place = static_cast<std::size_t>(j);
    if (is_inner(j, k)) {
      const Slab& slab = k == current_ ? lower_ : upper_;
      const std::int64_t start = slab.start[place];
      if (start != slab.start[place + 1]) {
        return {slab.flags.data() + j * words_, slab.planes.data() + start};
      }
    } else if (!grid_.planes().is_empty(number)) {
      return {grid_.planes().flags(number), grid_.planes().planes(number)};
    }
    return {no_flags_.data(), nullptr};
  }

  /// Of the planes computed for the slabs moved to.
  [[nodiscard]] const SourceCounts& counts() const { return counts_; }
  [[nodiscard]] std::int64_t planes() const { return planes_; }
  /// Spent on them.
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  struct Slab {
    std::vector<std::uint64_t> flags;  // by row; nothing in those without planes
    std::vector<std::int64_t> start;   // planes before each row; one more
    Array<UnitPlane> planes;
    std::int64_t inner_planes = 0;
    SourceCounts counts;
  };

  [[nodiscard]] bool is_inner(std::int64_t j, std::int64_t k) const {
    return cells_.is_row(j, k) && !cells_.is_outermost(j, k);
  }

  void fill(std::int64_t k) {
    Stopwatch watch;
    const NodeBits& nodes = grid_.nodes();
    const auto rows = static_cast<std::size_t>(nodes.last()[1]) + 1;
    Slab& slab = upper_;
    slab.flags.resize(rows * static_cast<std::size_t>(words_));
    slab.start.resize(rows + 1);
    slab.inner_planes = 0;
    const bool is_inner = k > 1 && k < cells_.dims[2];
    std::int64_t count = 0;
    for (std::size_t j = 0; j < rows; ++j) {
      slab.start[j] = count;
      const auto local = static_cast<std::int64_t>(j);
      if (is_inner && local > 1 && local < cells_.dims[1]) {
        count += flag_row(local, k, slab);
      }
    }
    slab.start[rows] = count;
    if (slab.planes.size() < static_cast<std::size_t>(count)) {
      slab.planes.resize(static_cast<std::size_t>(count + count / 2));
    }
    for (std::size_t j = 0; j < rows && count > 0; ++j) {
      if (slab.start[j] != slab.start[j + 1]) {
        fit_row(static_cast<std::int64_t>(j), k, slab);
      }
    }
    slab.counts = fitter_.finish();
    seconds_ += watch.lap();
  }

  // Of a row of inner cells. Returns how many there are.
  std::int64_t flag_row(std::int64_t j, std::int64_t k, Slab& slab) const {
    const NodeBits& nodes = grid_.nodes();
    const std::int64_t number = nodes.row_index(j, k);
    const bool has_outermost = !grid_.planes().is_empty(number);
    if (nodes.are_alike_around(number) && !has_outermost) {
      return 0;
    }
    const EdgeEnds ends(nodes, j, k);
    std::uint64_t* const flags = slab.flags.data() + j * words_;
    std::int64_t count = 0;
    for (std::int64_t w = 0; w < words_; ++w) {
      const std::uint64_t inner = ends.word(w) & cells_.inner(w);
      const int in_word = inner != 0 ? count_bits(inner) : 0;
      slab.inner_planes += in_word;
      count += in_word;
      flags[w] = inner;
    }
    if (has_outermost) {
      const std::uint64_t* const outermost = grid_.planes().flags(number);
      for (std::int64_t w = 0; w < words_; ++w) {
        flags[w] |= outermost[w];
        count += outermost[w] != 0 ? count_bits(outermost[w]) : 0;
      }
    }
    return count;
  }

  void fit_row(std::int64_t j, std::int64_t k, Slab& slab) {
    const std::int64_t number = grid_.nodes().row_index(j, k);
    const std::uint64_t* const flags = slab.flags.data() + j * words_;
    UnitPlane* const planes = slab.planes.data() + slab.start[static_cast<std::size_t>(j)];
    if (grid_.planes().is_empty(number)) {
      fitter_.fit_row(j, k, flags, planes);
      return;
    }
    // The first cell comes before the inner ones, all other outermost ones after.
    const std::uint64_t* const outermost = grid_.planes().flags(number);
    const UnitPlane* const from = grid_.planes().planes(number);
    std::int64_t count = 0;
    for (std::int64_t w = 0; w < words_; ++w) {
      inner_[static_cast<std::size_t>(w)] = flags[w] & cells_.inner(w);
      count += count_bits(outermost[w]);
    }
    const std::int64_t first = static_cast<std::int64_t>(outermost[0] >> 1 & 1);
    std::copy_n(from, first, planes);
    std::copy_n(from + first, count - first,
                slab.planes.data() + slab.start[static_cast<std::size_t>(j) + 1] - (count - first));
    fitter_.fit_row(j, k, inner_.data(), planes + first);
  }

  const DualGrid& grid_;
  BlockCells cells_;
  PlaneFitter<T> fitter_;
  std::int64_t words_;
  std::vector<std::uint64_t> no_flags_;
  std::vector<std::uint64_t> inner_;
  Slab lower_;
  Slab upper_;
  std::int64_t current_ = -2;
  SourceCounts counts_;
  std::int64_t planes_ = 0;
  double seconds_ = 0.0;
};

}  // namespace difmesh::detail
