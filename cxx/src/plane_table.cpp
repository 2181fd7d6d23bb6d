#include "plane_table.hpp"

#include <algorithm>
#include <utility>

#include "classify.hpp"
#include "plane_fitter.hpp"

namespace difmesh::detail {
namespace {

// The highest local index that is a cell of its own: the node after the block, unless it lies on or
// beyond a side of the domain.
std::int64_t last_cell(const BlockField& field, std::size_t axis) {
  const std::int64_t end = field.block.offset[axis] + field.block.dims[axis];
  const bool goes_on = end < field.grid.dims[axis] || field.sides[2 * axis + 1] == Side::periodic;
  return field.block.dims[axis] + (goes_on ? 1 : 0);
}

// Both ends of the crossed edges of a row of cells: nodes that differ from a neighbour.
void flag_edge_ends(const NodeBits& nodes, std::int64_t j, std::int64_t k, std::int64_t last_cell,
                    std::uint64_t* __restrict flags) {
  const std::uint64_t* const here = nodes.row(j, k);
  const std::int64_t row = nodes.row_index(j, k);
  bool alike = nodes.are_alike(row, row);
  const auto beside = [&](std::int64_t dj, std::int64_t dk) {
    const std::int64_t to_j = j + dj;
    const std::int64_t to_k = k + dk;
    const bool exists = to_j >= nodes.first()[1] && to_j <= nodes.last()[1] &&
                        to_k >= nodes.first()[2] && to_k <= nodes.last()[2];
    alike = alike && (!exists || nodes.are_alike(row, nodes.row_index(to_j, to_k)));
    return exists ? nodes.row(to_j, to_k) : here;
  };
  const std::uint64_t* const south = beside(-1, 0);
  const std::uint64_t* const north = beside(1, 0);
  const std::uint64_t* const below_it = beside(0, -1);
  const std::uint64_t* const above = beside(0, 1);
  const std::int64_t words = nodes.words();
  if (alike) {
    std::fill_n(flags, words, 0);
    return;
  }
  for (std::int64_t w = 0; w < words; ++w) {
    flags[w] = ((here[w] ^ south[w]) | (here[w] ^ north[w])) |
               ((here[w] ^ below_it[w]) | (here[w] ^ above[w]));
  }
  const std::int64_t last_start = nodes.last()[0] - 1;
  std::uint64_t from_west = 0;
  for (std::int64_t w = 0; w < words; ++w) {
    const std::uint64_t from_east = w + 1 < words ? here[w + 1] << 63 : 0;
    std::uint64_t crossed = here[w] ^ (here[w] >> 1 | from_east);
    if (w == 0 || w >= last_start / 64) {
      crossed &= NodeBits::range(w, nodes.first()[0], last_start);
    }
    flags[w] |= crossed | crossed << 1 | from_west;
    from_west = crossed >> 63;
  }
  flags[0] &= NodeBits::range(0, 1, last_cell);
  for (std::int64_t w = last_cell / 64; w < words; ++w) {
    flags[w] &= NodeBits::range(w, 1, last_cell);
  }
}

template <class T>
class Flagger {
 public:
  Flagger(const BlockField& field, const NodeBits& nodes, const Array<std::uint8_t>& row_ends,
          bool open_layers)
      : field_(field), nodes_(nodes), row_ends_(row_ends) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      last_[axis] = last_cell(field, axis);
      const std::int64_t end = field.block.offset[axis] + field.block.dims[axis];
      open_[axis][0] =
          open_layers && field.sides[2 * axis] == Side::open && field.block.offset[axis] == 0;
      open_[axis][1] =
          open_layers && field.sides[2 * axis + 1] == Side::open && end == field.grid.dims[axis];
    }
  }

  void flag_row(std::int64_t j, std::int64_t k, NodeBits& flags) const {
    if (j < 1 || k < 1 || j > last_[1] || k > last_[2]) {
      flags.clear_row(j, k);
      return;
    }
    std::uint64_t* row = flags.row(j, k);
    flag_edge_ends(nodes_, j, k, last_[0], row);
    if (in_layer(1, j) || in_layer(2, k)) {
      flag_layer_row(j, k, row);
    } else if (open_[0][0] || open_[0][1]) {
      flag_ends(j, k, row);
    }
  }

 private:
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
    const std::int64_t dims = field_.block.dims[0];
    for (std::int64_t i = 1; i <= dims; ++i) {
      flag_interfacial(i, first[(i - 1) * field_.view.strides[0]]);
    }
    if (last_[0] > dims) {
      const std::int64_t beyond = field_.axes[0].resolve(dims + field_.block.offset[0]);
      flag_interfacial(last_[0], first[(beyond - field_.block.offset[0]) * field_.view.strides[0]]);
    }
  }
  // The interfacial cells of a row at open sides in x.
  void flag_ends(std::int64_t j, std::int64_t k, std::uint64_t* row) const {
    const Index3& dims = field_.block.dims;
    const bool own = j <= dims[1] && k <= dims[2];
    const unsigned ends = own ? row_ends_[static_cast<std::size_t>((k - 1) * dims[1] + j - 1)]
                              : interfacial_ends(cells_of(j, k), dims[0], field_);
    if (open_[0][0] && (ends & 1) != 0) {
      set(row, 1);
    }
    if (open_[0][1] && (ends & 2) != 0) {
      set(row, dims[0]);
    }
  }
  static void set(std::uint64_t* row, std::int64_t i) {
    row[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  [[nodiscard]] bool in_layer(std::size_t axis, std::int64_t local) const {
    return (open_[axis][0] && local == 1) || (open_[axis][1] && local == field_.block.dims[axis]);
  }
  const BlockField& field_;
  const NodeBits& nodes_;
  const Array<std::uint8_t>& row_ends_;
  Index3 last_{};
  bool open_[3][2] = {};
};

}  // namespace

PlaneTable::PlaneTable(NodeBits flags, std::vector<std::int64_t> row_counts)
    : flags_(std::move(flags)), row_start_(std::move(row_counts)) {
  std::int64_t sum = 0;
  for (std::int64_t& start : row_start_) {
    sum += std::exchange(start, sum);
  }
  row_start_.push_back(sum);
  planes_.resize(static_cast<std::size_t>(sum));
  hint_large_pages(planes_);
}

std::int64_t PlaneTable::rank(const Index3& node) const {
  const std::uint64_t* row = flags_.row(node[1], node[2]);
  std::int64_t number = row_start(flags_.row_index(node[1], node[2]));
  const std::int64_t word = node[0] / 64;
  for (std::int64_t w = 0; w < word; ++w) {
    number += count_bits(row[w]);
  }
  return number + count_bits(row[word] & below(static_cast<int>(node[0] % 64)));
}

PlaneTable make_planes(const BlockField& field, const NodeBits& nodes,
                       const Array<std::uint8_t>& row_ends, const Options& options, Phases& phases,
                       Report& report) {
  NodeBits flags(nodes.first(), nodes.last());
  std::vector<std::int64_t> row_counts(static_cast<std::size_t>(nodes.rows()));
  const std::int64_t grain = rows_per_portion(nodes);
  const std::int64_t row_length = nodes.last()[1] + 1;
  with_scalar(field.view.type, [&](auto type) {
    const Flagger<decltype(type)> flagger(field, nodes, row_ends,
                                          options.placement == Placement::plic);
    phases.run(0.05, nodes.rows(), grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t row = begin; row < end; ++row) {
        const std::int64_t j = row % row_length;
        const std::int64_t k = row / row_length;
        flagger.flag_row(j, k, flags);
        row_counts[static_cast<std::size_t>(row)] = flags.count_row(j, k);
      }
    });
  });
  PlaneTable table(std::move(flags), std::move(row_counts));
  std::vector<SourceCounts> portions(static_cast<std::size_t>((nodes.rows() + grain - 1) / grain));
  with_scalar(field.view.type, [&](auto type) {
    using T = decltype(type);
    const FitterPlan<T> plan(field, options.normals);
    phases.run(0.4, nodes.rows(), grain, [&](std::int64_t begin, std::int64_t end) {
      PlaneFitter<T> fitter(plan, nodes, table);
      for (std::int64_t row = begin; row < end; ++row) {
        if (table.row_start(row) != table.row_start(row + 1)) {
          fitter.fit_row(row % row_length, row / row_length, table.row_start(row));
        }
      }
      fitter.finish();
      portions[static_cast<std::size_t>(begin / grain)] = fitter.counts();
    });
  });
  report.planes = table.size();
  for (const SourceCounts& counts : portions) {
    report.height_function_cells += counts.heights;
    report.gradient_free_cells += counts.gradient_free;
  }
  return table;
}

}  // namespace difmesh::detail
