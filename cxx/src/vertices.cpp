#include "vertices.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "memory_hints.hpp"
#include "vertex_placer.hpp"
#include "window_queue.hpp"

namespace difmesh::detail {
namespace {

// Calls visit(bit, axis) for the crossed edges of a word in the order of their ids.
template <class Visit>
void for_each_edge(const EdgeWord& word, const Visit& visit) {
  for (std::uint64_t left = word.any(); left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    if ((word.x >> bit & 1) != 0) {
      visit(bit, 0);
    }
    if ((word.y >> bit & 1) != 0) {
      visit(bit, 1);
    }
    if ((word.z >> bit & 1) != 0) {
      visit(bit, 2);
    }
  }
}

// Places the vertices of rows of nodes, on a field of T.
template <class T>
class RowPlacer {
 public:
  RowPlacer(const VertexPlacer& placer, Mesh& mesh)
      : placer_(placer),
        grid_(placer.grid()),
        with_planes_(placer.options().placement == Placement::plic),
        writer_(placer, mesh),
        queue_(placer, writer_, counts_) {}

  void place_row(std::int64_t j, std::int64_t k, std::int64_t first_vertex) {
    const NodeBits& nodes = grid_.nodes();
    const EdgeRow edges(nodes, j, k);
    const Index3& dims = grid_.field().block.dims;
    // Rows whose edges in y, and in z, lead to cells of the block from such.
    const bool own = j >= 1 && k >= 1 && j <= dims[1] && k <= dims[2];
    const bool own_along[3] = {own, own && j < dims[1], own && k < dims[2]};
    if (with_planes_) {
      planes_[0] = PlaneTable::Row(grid_.planes(), j, k);
      planes_[1] = PlaneTable::Row(grid_.planes(), std::min(j + 1, nodes.last()[1]), k);
      planes_[2] = PlaneTable::Row(grid_.planes(), j, std::min(k + 1, nodes.last()[2]));
    }
    const T* const row = own ? row_of_cells(j, k) : nullptr;
    const bool ends_y = is_end(1, j);
    const bool ends_z = is_end(2, k);
    // Nodes whose edges all lead to cells of the block from such, none of them where the mesh may end.
    const bool is_plain_row = own_along[1] && own_along[2] && !ends_y && !ends_z;
    const std::int64_t plain_from = std::max<std::int64_t>(1, nodes.first()[0] + 1);
    auto vertex = static_cast<std::size_t>(first_vertex);
    for (std::int64_t w = 0; w < nodes.words(); ++w) {
      if (with_planes_) {
        for (PlaneTable::Row& each : planes_) {
          each.enter_word(w);
        }
      }
      const EdgeWord word = edges.word(w);
      if (word.any() == 0) {
        continue;
      }
      const std::uint64_t inside = nodes.row(j, k)[w];
      if (is_plain_row && (word.any() & ~NodeBits::range(w, plain_from, dims[0] - 1)) == 0) {
        for_each_edge(word, [&](int bit, std::size_t axis) {
          place_own({64 * w + bit, j, k}, axis, (inside >> bit & 1) == 0, bit, row, vertex++);
        });
        continue;
      }
      for_each_edge(word, [&](int bit, std::size_t axis) {
        const Index3 node{64 * w + bit, j, k};
        counts_.on_end = counts_.on_end || (axis != 0 && is_end(0, node[0])) ||
                         (axis != 1 && ends_y) || (axis != 2 && ends_z);
        const bool upper_inside = (inside >> bit & 1) == 0;
        if (own_along[axis] && node[0] >= 1 && node[0] + (axis == 0 ? 1 : 0) <= dims[0]) {
          place_own(node, axis, upper_inside, bit, row, vertex++);
          return;
        }
        DualEdge edge{node, node, axis, upper_inside};
        ++edge.upper[axis];
        const double share = placer_.place(edge, counts_);
        writer_.write(vertex++, node, axis, upper_inside, share, placer_.position(edge, share));
      });
    }
  }

  // Asks for the cells that place_row() will read.
  void read_ahead(std::int64_t j, std::int64_t k) const {
    const Index3& dims = grid_.field().block.dims;
    if (with_planes_ || j < 1 || k < 1 || j > dims[1] || k > dims[2]) {
      return;
    }
    const NodeBits& nodes = grid_.nodes();
    const EdgeRow edges(nodes, j, k);
    const Index3& strides = grid_.field().view.strides;
    const T* const row = row_of_cells(j, k);
    for (std::int64_t w = 0; w < nodes.words(); ++w) {
      const EdgeWord word = edges.word(w);
      for (std::uint64_t left = word.any(); left != 0; left &= left - 1) {
        const std::int64_t i = 64 * w + std::countr_zero(left);
        const T* const cell = row + (i - 1) * strides[0];
        hint_read(cell);
        if ((word.y & left & -left) != 0) {
          hint_read(cell + strides[1]);
        }
        if ((word.z & left & -left) != 0) {
          hint_read(cell + strides[2]);
        }
      }
    }
  }

  const EdgeCounts& finish() {
    queue_.flush();
    return counts_;
  }

 private:
  [[nodiscard]] const T* row_of_cells(std::int64_t j, std::int64_t k) const {
    const BlockField& field = grid_.field();
    const Index3& offset = field.block.offset;
    return static_cast<const T*>(field.view.data) +
           field.element({offset[0], j - 1 + offset[1], k - 1 + offset[2]});
  }

  // True for the outermost nodes: an edge across the axis there lies where the mesh ends.
  [[nodiscard]] bool is_end(std::size_t axis, std::int64_t local) const {
    return local == grid_.nodes().first()[axis] || local == grid_.nodes().last()[axis];
  }

  // An edge between cells of the block; `row` is that of its lower cell.
  void place_own(const Index3& node, std::size_t axis, bool upper_inside, int bit, const T* row,
                 std::size_t vertex) {
    if (with_planes_) {
      const UnitPlane& lower = planes_[0].at(bit);
      const UnitPlane& upper =
          axis != 0 ? planes_[axis].at(bit) : (bit < 63 ? (&lower)[1] : planes_[0].first_of_next());
      queue_.add(node, axis, upper_inside, vertex, lower, upper);
      return;
    }
    const Index3& strides = grid_.field().view.strides;
    const T* const cell = row + (node[0] - 1) * strides[0];
    const double share = placer_.cleared(
        placer_.share_of(upper_inside, fraction_of(*cell), fraction_of(cell[strides[axis]])));
    writer_.write(vertex, node, axis, upper_inside, share,
                  placer_.position_between_cells(node, axis, share));
  }

  const VertexPlacer& placer_;
  const DualGrid& grid_;
  bool with_planes_;
  EdgeCounts counts_;
  VertexWriter writer_;
  WindowQueue queue_;
  std::array<PlaneTable::Row, 3> planes_;
};

// Holds rows back until what they read has arrived.
class RowsAhead {
 public:
  // Calls place(row) for the row pushed kAhead ago.
  template <class Place>
  void push(std::int64_t row, const Place& place) {
    std::int64_t& slot = rows_[static_cast<std::size_t>(next_ % kAhead)];
    if (next_ >= kAhead) {
      place(slot);
    }
    slot = row;
    ++next_;
  }
  template <class Place>
  void drain(const Place& place) {
    for (std::int64_t n = std::max<std::int64_t>(0, next_ - kAhead); n < next_; ++n) {
      place(rows_[static_cast<std::size_t>(n % kAhead)]);
    }
  }

 private:
  static constexpr std::int64_t kAhead = 8;
  std::array<std::int64_t, kAhead> rows_{};
  std::int64_t next_ = 0;
};

}  // namespace

std::vector<std::int64_t> count_vertices(const NodeBits& nodes, Phases& phases) {
  const std::int64_t row_length = nodes.last()[1] + 1;
  std::vector<std::int64_t> start(static_cast<std::size_t>(nodes.rows()) + 1, 0);
  phases.run(0.02, nodes.rows(), rows_per_portion(nodes),
             [&](std::int64_t begin, std::int64_t end) {
               for (std::int64_t row = begin; row < end; ++row) {
                 const std::int64_t j = row % row_length;
                 const std::int64_t k = row / row_length;
                 if (j < nodes.first()[1] || k < nodes.first()[2] || is_bare(nodes, j, k)) {
                   continue;
                 }
                 const EdgeRow edges(nodes, j, k);
                 std::int64_t count = 0;
                 for (std::int64_t w = 0; w < nodes.words(); ++w) {
                   const EdgeWord word = edges.word(w);
                   count += word.any() != 0 ? word.count() : 0;
                 }
                 start[static_cast<std::size_t>(row) + 1] = count;
               }
             });
  for (std::size_t row = 1; row < start.size(); ++row) {
    start[row] += start[row - 1];
  }
  return start;
}

void place_vertices(const DualGrid& grid, const Options& options,
                    const std::vector<std::int64_t>& row_start, Phases& phases, Mesh& mesh,
                    Report& report) {
  const auto total = static_cast<std::size_t>(row_start.back());
  mesh.positions.resize(total);
  mesh.normals.resize(options.vertex_normals ? total : 0);
  mesh.edge_ids.resize(options.edge_ids ? total : 0);
  hint_large_pages(mesh.positions);
  hint_large_pages(mesh.normals);
  const VertexPlacer placer(grid, options);
  const std::int64_t rows = grid.nodes().rows();
  const std::int64_t grain = rows_per_portion(grid.nodes());
  const std::int64_t row_length = grid.nodes().last()[1] + 1;
  std::vector<EdgeCounts> portions(static_cast<std::size_t>((rows + grain - 1) / grain));
  with_scalar(grid.field().view.type, [&](auto type) {
    phases.run(0.25, rows, grain, [&](std::int64_t begin, std::int64_t end) {
      RowPlacer<decltype(type)> row_placer(placer, mesh);
      RowsAhead ahead;
      const auto place = [&](std::int64_t row) {
        row_placer.place_row(row % row_length, row / row_length,
                             row_start[static_cast<std::size_t>(row)]);
      };
      for (std::int64_t row = begin; row < end; ++row) {
        if (row_start[static_cast<std::size_t>(row)] !=
            row_start[static_cast<std::size_t>(row) + 1]) {
          row_placer.read_ahead(row % row_length, row / row_length);
          ahead.push(row, place);
        }
      }
      ahead.drain(place);
      portions[static_cast<std::size_t>(begin / grain)] = row_placer.finish();
    });
  });
  std::int64_t steps = 0;
  for (const EdgeCounts& counts : portions) {
    report.solved_edges += counts.solved;
    report.newton_steps_max = std::max(report.newton_steps_max, counts.most_steps);
    report.non_monotone_edges += counts.non_monotone;
    report.closed = report.closed && !counts.on_end;
    steps += counts.steps;
  }
  if (report.solved_edges > 0) {
    report.newton_steps_mean =
        static_cast<double>(steps) / static_cast<double>(report.solved_edges);
  }
}

}  // namespace difmesh::detail
