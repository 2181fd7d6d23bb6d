#include "surface/plane_table.hpp"

#include <algorithm>

#include "cells/classify.hpp"
#include "placement/placement.hpp"
#include "planes/plane_fitter.hpp"
#include "surface/block_cells.hpp"
#include "surface/edge_ends.hpp"
#include "surface/phase.hpp"

namespace difmesh::detail {
namespace {

// Flags the outermost cells of the block.
template <class T>
class Flagger {
 public:
  Flagger(const BlockField& field, const NodeBits& nodes, const PlaneHints& hints, bool open_layers)
      : field_(field),
        nodes_(nodes),
        row_ends_(hints.row_ends),
        surfaces_(hints.surfaces),
        cells_(field) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t end = field.block.offset[axis] + field.block.dims[axis];
      open_[axis][0] =
          open_layers && field.boundary[2 * axis] == Side::open && field.block.offset[axis] == 0;
      open_[axis][1] =
          open_layers && field.boundary[2 * axis + 1] == Side::open && end == field.grid.dims[axis];
    }
  }

  /// Returns how many there are in the row; the words hold anything where there are none.
  std::uint32_t flag_row(std::int64_t j, std::int64_t k, std::uint64_t* row) const {
    if (!cells_.is_row(j, k)) {
      return 0;
    }
    std::uint32_t count = flag_seen_row(j, k, row);
    if (cells_.is_own_row(j, k)) {
      for_each_unseen_end(j, k, [&](std::int64_t i) {
        if (count == 0) {
          std::fill_n(row, nodes_.words(), 0);
        }
        count += is_set(row, i) ? 0U : 1U;
        set(row, i);
      });
    }
    return count;
  }

 private:
  // Those with a crossed edge among the nodes, and along open sides the interfacial ones.
  std::uint32_t flag_seen_row(std::int64_t j, std::int64_t k, std::uint64_t* row) const {
    const bool is_outermost = cells_.is_outermost(j, k);
    const bool is_layer = is_outermost && (in_layer(1, j) || in_layer(2, k));
    const bool has_open_ends = !is_layer && (open_[0][0] || open_[0][1]);
    const unsigned open_ends = has_open_ends ? interfacial_ends_of(j, k) : 0U;
    if (!is_outermost && open_ends == 0 && nodes_.are_alike_around(nodes_.row_index(j, k))) {
      return 0;
    }
    const EdgeEnds ends(nodes_, j, k);
    if (ends.are_none() && !is_layer && open_ends == 0) {
      return 0;
    }
    const unsigned at_ends = is_outermost ? 0U : outermost_ends(ends);
    if (!is_outermost && (at_ends | open_ends) == 0) {
      return 0;
    }
    const std::int64_t words = nodes_.words();
    std::fill_n(row, words, 0);
    if (is_outermost && !ends.are_none()) {
      for (std::int64_t w = 0; w < words; ++w) {
        row[w] = ends.word(w) & NodeBits::range(w, 1, cells_.last[0]);
      }
    }
    if (is_layer) {
      flag_layer_row(j, k, row);
    }
    if (((open_ends | at_ends) & 1) != 0) {
      set(row, 1);
    }
    if (((open_ends | at_ends) & 2) != 0) {
      set(row, cells_.dims[0]);
    }
    if ((at_ends & 4) != 0) {
      set(row, cells_.last[0]);
    }
    return static_cast<std::uint32_t>(count_bits(row, words));
  }

  // Calls visit(i) for cells of the block at the upper ends of crossed edges that come from cells
  // before the block, which its nodes do not include.
  template <class Visit>
  void for_each_unseen_end(std::int64_t j, std::int64_t k, const Visit& visit) const {
    const std::int64_t stride = field_.view.strides[0];
    const T* const here = cells_of(j, k);
    for (const std::size_t axis : {std::size_t{1}, std::size_t{2}}) {
      if (nodes_.first()[axis] == 0 || (axis == 1 ? j : k) != 1) {
        continue;
      }
      const T* const before = axis == 1 ? cells_of(j - 1, k) : cells_of(j, k - 1);
      const Index3 step{0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
      for (std::int64_t i = 0; i < cells_.dims[0]; ++i) {
        if (is_inside(here[i * stride], {i + 1, j, k}) !=
            is_inside(before[i * stride], {i + 1, j - step[1], k - step[2]})) {
          visit(i + 1);
        }
      }
    }
    if (nodes_.first()[0] == 1) {
      const std::int64_t before = field_.axes[0].resolve(field_.block.offset[0] - 1);
      if (is_inside(*here, {1, j, k}) !=
          is_inside(here[(before - field_.block.offset[0]) * stride], {0, j, k})) {
        visit(1);
      }
    }
  }

  // By fraction, or by its surface if that says otherwise; the cell is told by its local index.
  [[nodiscard]] bool is_inside(const T& value, const Index3& local) const {
    const bool is_moved =
        surfaces_ != nullptr && surfaces_->is_moved({local[0] - 1 + field_.block.offset[0],
                                                     local[1] - 1 + field_.block.offset[1],
                                                     local[2] - 1 + field_.block.offset[2]});
    return (fraction_of(value) >= 0.5) != is_moved;
  }
  [[nodiscard]] const T* cells_of(std::int64_t j, std::int64_t k) const {
    return static_cast<const T*>(field_.view.data) +
           field_.element({field_.axes[0].resolve(field_.block.offset[0]),
                           field_.axes[1].resolve(j - 1 + field_.block.offset[1]),
                           field_.axes[2].resolve(k - 1 + field_.block.offset[2])});
  }
  // All interfacial cells of a row.
  void flag_layer_row(std::int64_t j, std::int64_t k, std::uint64_t* row) const {
    const T* const first = cells_of(j, k);
    const auto flag_interfacial = [&](std::int64_t i, const T& value) {
      if (field_.is_interfacial(fraction_of(value))) {
        set(row, i);
      }
    };
    const std::int64_t dims = cells_.dims[0];
    for (std::int64_t i = 1; i <= dims; ++i) {
      flag_interfacial(i, first[(i - 1) * field_.view.strides[0]]);
    }
    if (cells_.last[0] > dims) {
      const std::int64_t beyond = field_.axes[0].resolve(dims + field_.block.offset[0]);
      flag_interfacial(cells_.last[0],
                       first[(beyond - field_.block.offset[0]) * field_.view.strides[0]]);
    }
  }
  // Which outermost cells of a row of inner ones are ends of crossed edges: bit 0 the first, bit 1
  // that at dims, bit 2 the last.
  [[nodiscard]] unsigned outermost_ends(const EdgeEnds& ends) const {
    const auto is_end = [&](std::int64_t i) {
      return static_cast<unsigned>(ends.word(i / 64) >> (i % 64) & 1);
    };
    return is_end(1) | is_end(cells_.dims[0]) << 1 | is_end(cells_.last[0]) << 2;
  }
  // Which cells at open sides in x are interfacial: bit 0 the first, bit 1 the last.
  [[nodiscard]] unsigned interfacial_ends_of(std::int64_t j, std::int64_t k) const {
    const Index3& dims = cells_.dims;
    const unsigned ends = cells_.is_own_row(j, k)
                              ? row_ends_[static_cast<std::size_t>((k - 1) * dims[1] + j - 1)]
                              : interfacial_ends(cells_of(j, k), dims[0], field_);
    return ends & ((open_[0][0] ? 1U : 0U) | (open_[0][1] ? 2U : 0U));
  }
  static void set(std::uint64_t* row, std::int64_t i) {
    row[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  [[nodiscard]] static bool is_set(const std::uint64_t* row, std::int64_t i) {
    return (row[i / 64] >> (i % 64) & 1) != 0;
  }
  [[nodiscard]] bool in_layer(std::size_t axis, std::int64_t local) const {
    return (open_[axis][0] && local == 1) || (open_[axis][1] && local == cells_.dims[axis]);
  }
  const BlockField& field_;
  const NodeBits& nodes_;
  const Array<std::uint8_t>& row_ends_;
  const SurfaceTable* surfaces_;
  BlockCells cells_;
  bool open_[3][2] = {};
};

// Fits the planes of flagged rows, and counts those of the block's own cells: planes of the next
// blocks' first cells are counted there.
template <class T>
class TableFitter {
 public:
  TableFitter(const FitterPlan<T>& plan, const NodeBits& nodes)
      : cells_(plan.field),
        own_(plan, nodes),
        next_(plan, nodes),
        words_(static_cast<std::size_t>(nodes.words())) {}

  void fit_row(std::int64_t j, std::int64_t k, const std::uint64_t* flags, UnitPlane* planes) {
    const auto words = static_cast<std::int64_t>(words_.size());
    if (!cells_.is_own_row(j, k)) {
      next_.fit_row(j, k, flags, planes);
      return;
    }
    for (std::int64_t w = 0; w < words; ++w) {
      words_[static_cast<std::size_t>(w)] = flags[w] & NodeBits::range(w, 1, cells_.dims[0]);
    }
    own_.fit_row(j, k, words_.data(), planes);
    const std::int64_t count = count_bits(words_.data(), words);
    planes_ += count;
    if (count != count_bits(flags, words)) {
      for (std::int64_t w = 0; w < words; ++w) {
        words_[static_cast<std::size_t>(w)] ^= flags[w];
      }
      next_.fit_row(j, k, words_.data(), planes + count);
    }
  }

  struct Counts {
    SourceCounts sources;
    std::int64_t planes = 0;
  };
  [[nodiscard]] Counts finish() {
    (void)next_.finish();
    return {own_.finish(), planes_};
  }

 private:
  BlockCells cells_;
  PlaneFitter<T> own_;
  PlaneFitter<T> next_;
  std::vector<std::uint64_t> words_;
  std::int64_t planes_ = 0;
};

}  // namespace

PlaneTable::PlaneTable(const NodeBits& nodes, const std::vector<std::uint32_t>& row_counts)
    : row_length_(nodes.last()[1] + 1) {
  if (std::all_of(row_counts.begin(), row_counts.end(),
                  [](std::uint32_t count) { return count == 0; })) {
    return;
  }
  starts_.reserve(row_counts.size() + 1);
  Starts sum;
  for (const std::uint32_t count : row_counts) {
    starts_.push_back(sum);
    sum.planes += count;
    sum.flags += count > 0 ? nodes.words() : 0;
  }
  starts_.push_back(sum);
  flags_.resize(static_cast<std::size_t>(sum.flags));
  planes_.resize(static_cast<std::size_t>(sum.planes));
}

std::int64_t PlaneTable::rank(const Index3& node) const {
  const std::int64_t row = row_of(node);
  const std::uint64_t* const words = flags(row);
  const std::int64_t word = node[0] / 64;
  return starts_[static_cast<std::size_t>(row)].planes + count_bits(words, word) +
         count_bits(words[word] & below(static_cast<int>(node[0] % 64)));
}

PlaneTable make_planes(const BlockField& field, const NodeBits& nodes, const PlaneHints& hints,
                       const Options& options, Phases& phases, Report& report) {
  std::vector<std::uint32_t> row_counts(static_cast<std::size_t>(nodes.rows()));
  const std::int64_t grain = rows_per_portion(nodes);
  const std::int64_t row_length = nodes.last()[1] + 1;
  PlaneTable table;
  with_scalar(field.view.type, [&](auto type) {
    using T = decltype(type);
    const Flagger<T> flagger(field, nodes, hints, placement_part(options.placement).by_planes);
    phases.run(0.5 * kPlanes.weight, nodes.rows(), grain,
               [&](std::int64_t begin, std::int64_t end) {
                 std::vector<std::uint64_t> words(static_cast<std::size_t>(nodes.words()));
                 std::int64_t j = begin % row_length;
                 std::int64_t k = begin / row_length;
                 for (std::int64_t row = begin; row < end; ++row) {
                   row_counts[static_cast<std::size_t>(row)] = flagger.flag_row(j, k, words.data());
                   if (++j == row_length) {
                     j = 0;
                     ++k;
                   }
                 }
               });
    // Flags are found once more where there are some, rather than kept for all rows.
    table = PlaneTable(nodes, row_counts);
    if (table.size() == 0) {
      return;
    }
    const FitterPlan<T> plan(field, options.normals);
    std::vector<typename TableFitter<T>::Counts> portions(
        static_cast<std::size_t>((nodes.rows() + grain - 1) / grain));
    phases.run(0.5 * kPlanes.weight, nodes.rows(), grain,
               [&](std::int64_t begin, std::int64_t end) {
                 TableFitter<T> fitter(plan, nodes);
                 for (std::int64_t row = begin; row < end; ++row) {
                   if (!table.is_empty(row)) {
                     const std::int64_t j = row % row_length;
                     const std::int64_t k = row / row_length;
                     flagger.flag_row(j, k, table.flags(row));
                     fitter.fit_row(j, k, table.flags(row), table.planes(row));
                   }
                 }
                 portions[static_cast<std::size_t>(begin / grain)] = fitter.finish();
               });
    for (const auto& portion : portions) {
      portion.sources.add_to(report);
      report.planes += portion.planes;
    }
  });
  return table;
}

}  // namespace difmesh::detail
