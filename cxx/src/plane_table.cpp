#include "plane_table.hpp"

#include <algorithm>

#include "normal_stencil.hpp"
#include "unit_plane.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kRowsPerPortion = 16;

// The highest local index that is a cell of its own: the node after the block, unless it lies on or
// beyond a side of the domain.
std::int64_t last_cell(const BlockField& field, std::size_t axis) {
  const std::int64_t end = field.block.offset[axis] + field.block.dims[axis];
  const bool goes_on = end < field.grid.dims[axis] || field.sides[2 * axis + 1] == Side::periodic;
  return field.block.dims[axis] + (goes_on ? 1 : 0);
}

// Both ends of the crossed edges of a row, for one word.
std::uint64_t edge_ends(const NodeBits& nodes, std::int64_t j, std::int64_t k, std::int64_t w) {
  const EdgeRow here(nodes, j, k);
  const EdgeWord word = here.word(w);
  std::uint64_t ends = word.any() | word.x << 1;
  if (w > 0) {
    ends |= here.word(w - 1).x >> 63;
  }
  if (j > nodes.first()[1]) {
    ends |= EdgeRow(nodes, j - 1, k).word(w).y;
  }
  if (k > nodes.first()[2]) {
    ends |= EdgeRow(nodes, j, k - 1).word(w).z;
  }
  return ends;
}

template <class T>
class Flagger {
 public:
  Flagger(const BlockField& field, const NodeBits& nodes, bool open_layers)
      : field_(field), nodes_(nodes) {
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
      return;
    }
    std::uint64_t* row = flags.row(j, k);
    for (std::int64_t w = 0; w < nodes_.words(); ++w) {
      row[w] = edge_ends(nodes_, j, k, w) & NodeBits::range(w, 1, last_[0]);
    }
    const bool layer = in_layer(1, j) || in_layer(2, k);
    if (!layer && !open_[0][0] && !open_[0][1]) {
      return;
    }
    const T* first = static_cast<const T*>(field_.view.data) +
                     field_.element({field_.axes[0].resolve(field_.block.offset[0]),
                                     field_.axes[1].resolve(j - 1 + field_.block.offset[1]),
                                     field_.axes[2].resolve(k - 1 + field_.block.offset[2])});
    const auto flag_interfacial = [&](std::int64_t i, const T& value) {
      if (field_.is_interfacial(fraction_of(value))) {
        row[i / 64] |= std::uint64_t{1} << (i % 64);
      }
    };
    const std::int64_t dims = field_.block.dims[0];
    const std::int64_t step = layer || dims == 1 ? 1 : dims - 1;
    for (std::int64_t i = 1; i <= dims; i += step) {
      if (layer || open_[0][i == 1 ? 0 : 1] || (dims == 1 && open_[0][1])) {
        flag_interfacial(i, first[(i - 1) * field_.view.strides[0]]);
      }
    }
    if (layer && last_[0] > dims) {
      const std::int64_t beyond = field_.axes[0].resolve(dims + field_.block.offset[0]);
      flag_interfacial(last_[0], first[(beyond - field_.block.offset[0]) * field_.view.strides[0]]);
    }
  }

 private:
  [[nodiscard]] bool in_layer(std::size_t axis, std::int64_t local) const {
    return (open_[axis][0] && local == 1) || (open_[axis][1] && local == field_.block.dims[axis]);
  }
  const BlockField& field_;
  const NodeBits& nodes_;
  Index3 last_{};
  bool open_[3][2] = {};
};

struct SourceCounts {
  std::int64_t heights = 0;
  std::int64_t gradient_free = 0;
};

template <class T>
UnitPlane fit_plane(const BlockField& field, const NormalStencil<T>& stencil, const Index3& cell,
                    SourceCounts& counts) {
  Index3 resolved;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    resolved[axis] = field.axes[axis].resolve(cell[axis]);
  }
  const double fraction =
      fraction_of(static_cast<const T*>(field.view.data)[field.element(resolved)]);
  if (fraction == 0.0 || fraction == 1.0) {
    return UnitPlane::pure(fraction == 1.0);
  }
  const UnitNormal normal = stencil(resolved);
  if (normal.source == NormalSource::none) {
    ++counts.gradient_free;
    return {{0.0, 0.0, 0.0}, fraction - 0.5};
  }
  counts.heights += normal.source == NormalSource::height_function ? 1 : 0;
  return {normal.m, cube_offset(normal.m[0], normal.m[1], normal.m[2], fraction)};
}

}  // namespace

PlaneTable::PlaneTable(NodeBits flags) : flags_(std::move(flags)) {
  const std::int64_t rows = flags_.rows();
  row_start_.assign(static_cast<std::size_t>(rows) + 1, 0);
  const std::uint64_t* words = flags_.row(0, 0);
  std::int64_t sum = 0;
  for (std::int64_t row = 0; row < rows; ++row) {
    row_start_[static_cast<std::size_t>(row)] = sum;
    for (std::int64_t w = 0; w < flags_.words(); ++w, ++words) {
      sum += *words != 0 ? count_bits(*words) : 0;
    }
  }
  row_start_.back() = sum;
  planes_.resize(static_cast<std::size_t>(sum));
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

PlaneTable make_planes(const BlockField& field, const NodeBits& nodes, const Options& options,
                       Phases& phases, Report& report) {
  NodeBits flags(nodes.first(), nodes.last());
  const std::int64_t row_length = nodes.last()[1] + 1;
  with_scalar(field.view.type, [&](auto type) {
    const Flagger<decltype(type)> flagger(field, nodes, options.placement == Placement::plic);
    phases.run(0.05, nodes.rows(), kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t row = begin; row < end; ++row) {
        flagger.flag_row(row % row_length, row / row_length, flags);
      }
    });
  });
  PlaneTable table(std::move(flags));
  std::vector<SourceCounts> portions(
      static_cast<std::size_t>((nodes.rows() + kRowsPerPortion - 1) / kRowsPerPortion));
  with_scalar(field.view.type, [&](auto type) {
    using T = decltype(type);
    const NormalStencil<T> stencil(field, options.normals);
    phases.run(0.4, nodes.rows(), kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
      SourceCounts counts;
      std::int64_t number = table.row_start(begin);
      for (std::int64_t row = begin; row < end; ++row) {
        if (number == table.row_start(row + 1)) {
          continue;
        }
        const std::int64_t j = row % row_length;
        const std::int64_t k = row / row_length;
        const std::uint64_t* words = table.flags().row(j, k);
        for (std::int64_t w = 0; w < nodes.words(); ++w) {
          for (std::uint64_t left = words[w]; left != 0; left &= left - 1) {
            const std::int64_t i = 64 * w + std::countr_zero(left);
            const Index3 cell{i - 1 + field.block.offset[0], j - 1 + field.block.offset[1],
                              k - 1 + field.block.offset[2]};
            table[number++] = fit_plane<T>(field, stencil, cell, counts);
          }
        }
      }
      portions[static_cast<std::size_t>(begin / kRowsPerPortion)] = counts;
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
