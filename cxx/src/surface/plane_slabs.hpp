#pragma once
// Planes of whole rows, for a walk through the block slab by slab: those between the outermost
// layers are computed when they are needed and forgotten after, so that they stay in the cache and
// take no memory.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/stopwatch.hpp"
#include "planes/plane_fitter.hpp"
#include "planes/plane_row.hpp"
#include "planes/unit_plane.hpp"
#include "surface/block_cells.hpp"
#include "surface/dual_grid.hpp"
#include "surface/edge_ends.hpp"

namespace difmesh::detail {

/// Rows of nodes: j in [first[0], end[0]), k in [first[1], end[1]).
struct RowTile {
  std::array<std::int64_t, 2> first;
  std::array<std::int64_t, 2> end;
};

/// Two slabs, k and k + 1, of the rows of a tile and of the next in y. One per thread.
template <class T>
class PlaneSlabs {
 public:
  PlaneSlabs(const FitterPlan<T>& plan, const DualGrid& grid, const RowTile& tile)
      : grid_(grid),
        cells_(grid.field()),
        fitter_(plan, grid.nodes()),
        words_(grid.nodes().words()),
        first_(tile.first[0]),
        own_(tile.end[0] - tile.first[0]),
        rows_(std::min(tile.end[0], grid.nodes().last()[1]) + 1 - tile.first[0]),
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
    const auto place = static_cast<std::size_t>(j - first_);
    if (is_inner(j, k)) {
      const Slab& slab = k == current_ ? lower_ : upper_;
      const std::int64_t start = slab.start[place];
      if (start != slab.start[place + 1]) {
        return {flags_of(slab, j), slab.planes.data() + start};
      }
    } else if (!grid_.planes().is_empty(number)) {
      return {grid_.planes().flags(number), grid_.planes().planes(number)};
    }
    return {no_flags_.data(), nullptr};
  }

  /// Of the planes of the tile's rows in the slabs moved to.
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

  [[nodiscard]] const std::uint64_t* flags_of(const Slab& slab, std::int64_t j) const {
    return slab.flags.data() + (j - first_) * words_;
  }

  void fill(std::int64_t k) {
    Stopwatch watch;
    const auto rows = static_cast<std::size_t>(rows_);
    Slab& slab = upper_;
    slab.flags.resize(rows * static_cast<std::size_t>(words_));
    slab.start.resize(rows + 1);
    slab.inner_planes = 0;
    slab.counts = {};
    const bool in_inner_slab = k > 1 && k < cells_.dims[2];
    std::int64_t count = 0;
    for (std::int64_t n = 0; n < rows_; ++n) {
      slab.start[static_cast<std::size_t>(n)] = count;
      const std::int64_t j = first_ + n;
      if (in_inner_slab && j > 1 && j < cells_.dims[1]) {
        const RowCounts counts = flag_row(j, k, slab);
        count += counts.all;
        slab.inner_planes += n < own_ ? counts.inner : 0;
      }
    }
    slab.start[rows] = count;
    if (slab.planes.size() < static_cast<std::size_t>(count)) {
      slab.planes.resize(static_cast<std::size_t>(count + count / 2));
    }
    for (std::int64_t n = 0; n < rows_ && count > 0; ++n) {
      if (n == own_) {
        slab.counts = fitter_.finish();  // what follows is another tile's
      }
      if (slab.start[static_cast<std::size_t>(n)] != slab.start[static_cast<std::size_t>(n) + 1]) {
        fit_row(first_ + n, k, slab);
      }
    }
    const SourceCounts rest = fitter_.finish();
    if (rows_ == own_) {
      slab.counts = rest;
    }
    seconds_ += watch.lap();
  }

  struct RowCounts {
    std::int64_t all = 0;
    std::int64_t inner = 0;
  };

  // Of a row of inner cells and, at its ends, outermost ones.
  RowCounts flag_row(std::int64_t j, std::int64_t k, Slab& slab) const {
    const NodeBits& nodes = grid_.nodes();
    const std::int64_t number = nodes.row_index(j, k);
    const bool has_outermost = !grid_.planes().is_empty(number);
    if (nodes.are_alike_around(number) && !has_outermost) {
      return {};
    }
    const EdgeEnds ends(nodes, j, k);
    std::uint64_t* const flags = slab.flags.data() + (j - first_) * words_;
    for (std::int64_t w = 0; w < words_; ++w) {
      flags[w] = ends.word(w) & cells_.inner(w);
    }
    RowCounts counts;
    counts.inner = count_bits(flags, words_);
    counts.all = counts.inner;
    if (has_outermost) {
      const std::uint64_t* const outermost = grid_.planes().flags(number);
      counts.all += count_bits(outermost, words_);
      for (std::int64_t w = 0; w < words_; ++w) {
        flags[w] |= outermost[w];
      }
    }
    return counts;
  }

  void fit_row(std::int64_t j, std::int64_t k, Slab& slab) {
    const std::int64_t number = grid_.nodes().row_index(j, k);
    const auto place = static_cast<std::size_t>(j - first_);
    const std::uint64_t* const flags = flags_of(slab, j);
    UnitPlane* const planes = slab.planes.data() + slab.start[place];
    if (grid_.planes().is_empty(number)) {
      fitter_.fit_row(j, k, flags, planes);
      return;
    }
    // The first cell comes before the inner ones, all other outermost ones after.
    const std::uint64_t* const outermost = grid_.planes().flags(number);
    const UnitPlane* const from = grid_.planes().planes(number);
    const std::int64_t count = count_bits(outermost, words_);
    for (std::int64_t w = 0; w < words_; ++w) {
      inner_[static_cast<std::size_t>(w)] = flags[w] & cells_.inner(w);
    }
    const std::int64_t first = static_cast<std::int64_t>(outermost[0] >> 1 & 1);
    std::copy_n(from, first, planes);
    std::copy_n(from + first, count - first,
                slab.planes.data() + slab.start[place + 1] - (count - first));
    fitter_.fit_row(j, k, inner_.data(), planes + first);
  }

  const DualGrid& grid_;
  BlockCells cells_;
  PlaneFitter<T> fitter_;
  std::int64_t words_;
  std::int64_t first_;  // row of the tile
  std::int64_t own_;    // rows of the tile
  std::int64_t rows_;   // and with the next one, if there is one
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
