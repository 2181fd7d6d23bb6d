#include "cells/classify.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "base/position_text.hpp"
#include "difmesh/error.hpp"
#include "planes/kernels.hpp"

namespace difmesh::detail {
namespace {

// Sums are kept in eight lanes of a group of cells, as the kernels do it.
constexpr std::size_t kLaneCount = 8;
// Groups that a kernel takes at once.
constexpr std::int64_t kMostGroups = 64;

struct Statistics {
  std::int64_t interfacial = 0;
  std::int64_t clamped = 0;
  double overshoot = 0.0;
  double sum = 0.0;             // of the part of a slab at hand
  std::int64_t first_bad = -1;  // cell number in the block with its ghosts, in the order z, y, x

  void add(const Statistics& other) {
    interfacial += other.interfacial;
    clamped += other.clamped;
    overshoot = std::max(overshoot, other.overshoot);
    note_bad(other.first_bad);
  }
  void note_bad(std::int64_t number) {
    if (number >= 0 && (first_bad < 0 || number < first_bad)) {
      first_bad = number;
    }
  }
};

template <class T>
class RowClassifier {
 public:
  RowClassifier(double tolerance, double bound) : tolerance_(tolerance), bound_(bound) {
    if constexpr (!std::is_integral_v<T>) {
      low_ = rounded_down(tolerance);
      high_ = -rounded_down(tolerance - 1.0);
    }
  }

  // Cells [from, to) of a row in memory: calls visit(place, bits, count) for each group, the first
  // at place `from`. `number` is that of the row's first cell.
  template <class Visit>
  void row(const T* cells, std::int64_t stride, std::int64_t from, std::int64_t to,
           std::int64_t number, Statistics& statistics, const Visit& visit) const {
    std::int64_t i = from;
    if constexpr (!std::is_integral_v<T>) {
      while (stride == 1 && i + kGroup <= to) {
        i += whole_groups(cells, i, to, number, statistics, visit);
      }
    }
    for (; i < to; i += kGroup) {
      const std::int64_t count = std::min(kGroup, to - i);
      T values[kGroup] = {};
      for (std::int64_t n = 0; n < count; ++n) {
        values[n] = cells[(i + n) * stride];
      }
      mixed(values, count, number + i, statistics);
      visit(i, inside_bits(values), count);
    }
  }

 private:
  template <class Visit>
  std::int64_t whole_groups(const T* cells, std::int64_t from, std::int64_t to, std::int64_t number,
                            Statistics& statistics, const Visit& visit) const {
    const std::int64_t groups = std::min(kMostGroups, (to - from) / kGroup);
    GroupFacts facts;
    facts.interfacial = statistics.interfacial;
    facts.sum = statistics.sum;
    classify_kernel(kernels_, T{})({cells + from, groups, low_, high_}, facts);
    statistics.interfacial = facts.interfacial;
    statistics.sum = facts.sum;
    for (std::uint64_t left = facts.outside; left != 0; left &= left - 1) {
      const std::int64_t start = from + kGroup * std::countr_zero(left);
      look_outside(cells + start, kGroup, number + start, statistics);
    }
    for (std::int64_t group = 0; group < groups; ++group) {
      visit(from + group * kGroup, facts.inside[group], kGroup);
    }
    return groups * kGroup;
  }

  static std::uint64_t inside_bits(const T* values) {
    std::uint64_t word = 0;
    for (int i = 0; i < kGroup; ++i) {
      word |= static_cast<std::uint64_t>(fraction_of(values[i]) >= 0.5) << i;
    }
    return word;
  }

  // Counts have the width of the elements, which lets the compiler count in vectors.
  using Count = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;

  void mixed(const T* values, std::int64_t count, std::int64_t number,
             Statistics& statistics) const {
    double lanes[kLaneCount] = {};
    for (std::size_t i = 0; i < static_cast<std::size_t>(kGroup); i += kLaneCount) {
      for (std::size_t lane = 0; lane < kLaneCount; ++lane) {
        lanes[lane] += fraction_of(values[i + lane]);
      }
    }
    // Cells past the end of the row are zeros, which add nothing to anything.
    Count interfacial = 0;
    Count outside = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(kGroup); ++i) {
      if constexpr (std::is_integral_v<T>) {
        const double fraction = fraction_of(values[i]);
        interfacial += (fraction > tolerance_) & (fraction < 1.0 - tolerance_);
      } else {
        const T value = values[i];
        interfacial += (value > low_) & (value < high_);
        outside += static_cast<Count>(!(value >= T(0))) | static_cast<Count>(!(value <= T(1)));
      }
    }
    statistics.interfacial += interfacial;
    statistics.sum += ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
                      ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
    if (outside != 0) {
      look_outside(values, count, number, statistics);
    }
  }

  // Some value is below 0, above 1 or no number.
  void look_outside(const T* values, std::int64_t count, std::int64_t number,
                    Statistics& statistics) const {
    for (std::int64_t i = 0; i < count; ++i) {
      const auto value = static_cast<double>(values[i]);
      const double overshoot = std::max(-value, value - 1.0);
      if (!(overshoot <= bound_)) {
        statistics.note_bad(number + i);
        return;
      }
      if (overshoot > 0.0) {
        ++statistics.clamped;
        statistics.overshoot = std::max(statistics.overshoot, overshoot);
      }
    }
  }

  // The largest T up to the limit: for x in T, x > limit exactly where x > rounded_down(limit).
  static T rounded_down(double limit) {
    const T rounded = static_cast<T>(limit);
    return static_cast<double>(rounded) <= limit ? rounded : std::nextafter(rounded, T(-2));
  }

  const Kernels& kernels_ = kernels();
  double tolerance_;
  double bound_;
  T low_{};
  T high_{};
};

// Reads one row of cells in memory; j and k are counted in the field view. Rows of the block leave
// their bits, with the first cell of the block at bit 1; ghost cells are checked only.
template <class T>
void classify_row(const BlockField& field, const RowClassifier<T>& classifier, const Index3& start,
                  NodeBits* nodes, Statistics& statistics) {
  const FieldView& view = field.view;
  const T* row =
      static_cast<const T*>(view.data) + start[1] * view.strides[1] + start[2] * view.strides[2];
  const std::int64_t number = (start[2] * view.dims[1] + start[1]) * view.dims[0];
  const auto check = [&](std::int64_t from, std::int64_t to, Statistics& facts) {
    classifier.row(row, view.strides[0], from, to, number, facts,
                   [](std::int64_t, std::uint64_t, std::int64_t) {});
  };
  const std::int64_t first = field.block.ghost_low[0];
  const std::int64_t last = first + field.block.dims[0];
  Statistics ghosts;
  if (first > 0) {
    check(0, first, ghosts);
  }
  if (nodes == nullptr) {
    check(first, last, ghosts);
  } else {
    const std::int64_t j = start[1] - field.block.ghost_low[1] + 1;
    const std::int64_t k = start[2] - field.block.ghost_low[2] + 1;
    std::uint64_t* word = nodes->row(j, k);
    std::uint64_t* const end = word + nodes->words();
    std::uint64_t carry = 0;
    classifier.row(row, view.strides[0], first, last, number, statistics,
                   [&](std::int64_t, std::uint64_t bits, std::int64_t count) {
                     if (count < kGroup) {
                       bits &= below(static_cast<int>(count));
                     }
                     *word++ = bits << 1 | carry;
                     carry = bits >> 63;
                   });
    if (word != end) {
      *word++ = carry;
      std::fill(word, end, 0);
    }
  }
  if (last < view.dims[0]) {
    check(last, view.dims[0], ghosts);
  }
  statistics.note_bad(ghosts.first_bad);
}

// The first of the block's own cells in a row, whose j and k are counted in the field view.
template <class T>
const T* own_cells(const BlockField& field, const Index3& start) {
  const Index3& strides = field.view.strides;
  return static_cast<const T*>(field.view.data) + field.block.ghost_low[0] * strides[0] +
         start[1] * strides[1] + start[2] * strides[2];
}

// Of the fractions in the block's part of a row, on stretched axes.
template <class T>
double row_volume(const BlockField& field, const Index3& start) {
  const T* const row = own_cells<T>(field, start);
  double length = 0.0;
  for (std::int64_t i = 0; i < field.block.dims[0]; ++i) {
    length +=
        fraction_of(row[i * field.view.strides[0]]) * field.width(0, i + field.block.offset[0]);
  }
  return length * field.width(1, start[1] + field.axes[1].low) *
         field.width(2, start[2] + field.axes[2].low);
}

[[noreturn]] void throw_bad_cell(const BlockField& field, std::int64_t number, double bound) {
  const Index3 local{number % field.view.dims[0], number / field.view.dims[0] % field.view.dims[1],
                     number / field.view.dims[0] / field.view.dims[1]};
  const Index3 cell{local[0] + field.axes[0].low, local[1] + field.axes[1].low,
                    local[2] + field.axes[2].low};
  const double value = with_scalar(field.view.type, [&](auto type) {
    using T = decltype(type);
    return static_cast<double>(static_cast<const T*>(field.view.data)[field.element(cell)]);
  });
  std::string text = "cell (";
  text += std::to_string(cell[0]) + ", " + std::to_string(cell[1]) + ", " +
          std::to_string(cell[2]) + ") holds " + rounded_text(value);
  text += std::isfinite(value)
              ? ", further outside [0, 1] than the overshoot bound of " + rounded_text(bound)
              : ", which is no fraction";
  throw Error(ErrorCode::invalid_value, text);
}

// Sets the bits of the nodes that are not cells of the block.
class BeyondFiller {
 public:
  BeyondFiller(const BlockField& field, NodeBits& nodes) : field_(field), nodes_(nodes) {
    ends_[0] = end_at(0);
    ends_[1] = end_at(nodes.last()[0]);
  }

  // The ends of a row of the block's cells. Thread safety: for different rows.
  void set_ends(std::int64_t j, std::int64_t k) {
    if (nodes_.first()[0] == 0) {
      set_end(ends_[0], j, k);
    }
    set_end(ends_[1], j, k);
  }

  // All other rows. \pre the rows of cells are complete
  void fill() {
    const Index3& first = nodes_.first();
    const Index3& last = nodes_.last();
    for (std::int64_t k = first[2]; k <= last[2]; ++k) {
      for (std::int64_t j = first[1]; j <= last[1]; ++j) {
        if (!is_own(1, j) || !is_own(2, k)) {
          nodes_.clear_row(j, k);
          fill_row(j, k);
          nodes_.summarise_row(j, k);
        }
      }
    }
  }

 private:
  [[nodiscard]] bool is_own(std::size_t axis, std::int64_t local) const {
    return local >= 1 && local <= field_.block.dims[axis];
  }
  // On open sides the node on the domain face stands for the last cell.
  [[nodiscard]] std::int64_t cell_of(std::size_t axis, std::int64_t local) const {
    const std::int64_t resolved = field_.axes[axis].resolve(local - 1 + field_.block.offset[axis]);
    if (resolved == kMissing) {
      return local == 0 ? 0 : field_.grid.dims[axis] - 1;
    }
    return resolved;
  }
  void set_node(const Index3& node) {
    const Index3 cell{cell_of(0, node[0]), cell_of(1, node[1]), cell_of(2, node[2])};
    nodes_.set(node, field_.fraction(cell) >= 0.5);
  }
  // A node at an end of all rows in x, and the node of the same row that it repeats, if it does.
  struct End {
    std::int64_t node;
    std::int64_t repeated;  // 0: none
  };
  [[nodiscard]] End end_at(std::int64_t i) const {
    const std::int64_t cell = cell_of(0, i);
    if (!is_cell(cell)) {
      return {i, 0};
    }
    const std::int64_t from = cell - field_.block.offset[0] + 1;
    return {i, is_own(0, from) ? from : 0};
  }
  void set_end(const End& end, std::int64_t j, std::int64_t k) {
    if (end.repeated > 0 && is_own(1, j) && is_own(2, k)) {
      nodes_.set({end.node, j, k}, nodes_.test({end.repeated, j, k}));
    } else {
      set_node({end.node, j, k});
    }
  }
  // A whole row: constant beyond `empty` and `full`, else that of the cells it stands for.
  void fill_row(std::int64_t j, std::int64_t k) {
    const std::int64_t cell_j = cell_of(1, j);
    const std::int64_t cell_k = cell_of(2, k);
    if (!is_cell(cell_j) || !is_cell(cell_k)) {
      const bool inside = cell_j != kEmptyBeyond && cell_k != kEmptyBeyond;
      for (std::int64_t w = 0; inside && w < nodes_.words(); ++w) {
        nodes_.row(j, k)[w] = NodeBits::range(w, nodes_.first()[0], nodes_.last()[0]);
      }
      set_ends(j, k);
      return;
    }
    const std::int64_t from_j = cell_j - field_.block.offset[1] + 1;
    const std::int64_t from_k = cell_k - field_.block.offset[2] + 1;
    if (is_own(1, from_j) && is_own(2, from_k)) {
      std::copy_n(nodes_.row(from_j, from_k), nodes_.words(), nodes_.row(j, k));
      return;
    }
    for (std::int64_t i = nodes_.first()[0]; i <= nodes_.last()[0]; ++i) {
      set_node({i, j, k});
    }
  }

  const BlockField& field_;
  NodeBits& nodes_;
  End ends_[2]{};
};

// The rows of a field in parts of its slabs. Each part has a sum of its own, and these are added in
// their order, so that the sum over a field is the same to the last bit however slabs are given.
struct SlabParts {
  explicit SlabParts(const Index3& dims)
      : rows(std::max<std::int64_t>(1, (1 << 16) / dims[0])),
        per_slab((dims[1] + rows - 1) / rows),
        count(per_slab * dims[2]),
        at_once(std::max<std::int64_t>(1, rows / dims[1])) {}

  std::int64_t rows;  // of a part; fewer in the last of a slab
  std::int64_t per_slab;
  std::int64_t count;
  std::int64_t at_once;  // parts that a thread takes
};

}  // namespace

ClassifiedNodes classify(const BlockField& field, const FieldLimits& limits, double weight,
                         Phases& phases, FieldFacts& facts) {
  Report& report = facts.report;
  Index3 first;
  Index3 last;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool at_low_side =
        field.block.offset[axis] == 0 && field.boundary[2 * axis] != Side::periodic;
    first[axis] = at_low_side ? 0 : 1;
    last[axis] = field.block.dims[axis] + 1;
  }
  ClassifiedNodes result{NodeBits(first, last), {}};
  NodeBits& nodes = result.nodes;
  result.row_ends.resize(static_cast<std::size_t>(field.block.dims[1] * field.block.dims[2]));
  BeyondFiller beyond(field, nodes);
  const Index3& dims = field.view.dims;
  const SlabParts parts(dims);
  std::vector<double> sums(static_cast<std::size_t>(parts.count));
  std::vector<Statistics> portions(
      static_cast<std::size_t>((parts.count + parts.at_once - 1) / parts.at_once));
  with_scalar(field.view.type, [&](auto type) {
    using T = decltype(type);
    const RowClassifier<T> classifier(field.purity_tolerance, limits.overshoot_bound);
    const auto classify_one = [&](const Index3& start, Statistics& statistics) {
      const std::int64_t j = start[1] - field.block.ghost_low[1];
      const std::int64_t k = start[2] - field.block.ghost_low[2];
      const bool in_block = j >= 0 && j < field.block.dims[1] && k >= 0 && k < field.block.dims[2];
      const std::int64_t interfacial_before = statistics.interfacial;
      const double sum_before = statistics.sum;
      classify_row<T>(field, classifier, start, in_block ? &nodes : nullptr, statistics);
      if (!in_block) {
        return;
      }
      if (field.is_stretched) {
        statistics.sum = sum_before + row_volume<T>(field, start);
      }
      if (limits.layer_planes.is_limited() && limits.layer_planes.has_row(j, k)) {
        limits.layer_planes.add(statistics.interfacial - interfacial_before);
      }
      beyond.set_ends(j + 1, k + 1);
      nodes.summarise_row(j + 1, k + 1);
      result.row_ends[static_cast<std::size_t>(k * field.block.dims[1] + j)] =
          interfacial_ends(own_cells<T>(field, start), field.block.dims[0], field);
    };
    phases.run(weight, parts.count, parts.at_once, [&](std::int64_t begin, std::int64_t end) {
      Statistics& statistics = portions[static_cast<std::size_t>(begin / parts.at_once)];
      for (std::int64_t part = begin; part < end; ++part) {
        statistics.sum = 0.0;
        Index3 start{0, part % parts.per_slab * parts.rows, part / parts.per_slab};
        for (const std::int64_t to = std::min(dims[1], start[1] + parts.rows); start[1] < to;
             ++start[1]) {
          classify_one(start, statistics);
        }
        sums[static_cast<std::size_t>(part)] = statistics.sum;
      }
    });
  });
  Statistics all;
  for (const Statistics& portion : portions) {
    all.add(portion);
  }
  if (all.first_bad >= 0) {
    throw_bad_cell(field, all.first_bad, limits.overshoot_bound);
  }
  beyond.fill();
  report.cells += field.block.dims[0] * field.block.dims[1] * field.block.dims[2];
  report.interfacial_cells += all.interfacial;
  report.clamped_cells += all.clamped;
  report.largest_overshoot = std::max(report.largest_overshoot, all.overshoot);
  for (const double sum : sums) {
    facts.fractions += sum;
  }
  report.fraction_volume =
      field.is_stretched ? facts.fractions : facts.fractions * field.grid.cell_volume();
  return result;
}

}  // namespace difmesh::detail
