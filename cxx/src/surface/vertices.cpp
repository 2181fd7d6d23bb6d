#include "surface/vertices.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "base/memory_hints.hpp"
#include "base/stopwatch.hpp"
#include "grid/newton_steps.hpp"
#include "planes/plane_row.hpp"
#include "planes/unit_plane.hpp"
#include "surface/phase.hpp"
#include "surface/plane_slabs.hpp"
#include "surface/vertex_placer.hpp"
#include "surface/window_queue.hpp"

namespace difmesh::detail {
namespace {

// Places the vertices of rows of nodes, on a field of T.
template <class T>
class RowPlacer {
 public:
  RowPlacer(const VertexPlacer& placer, Mesh& mesh)
      : placer_(placer),
        grid_(placer.grid()),
        queues_windows_(placer.placement().by_planes && !placer.grid().field().is_stretched),
        writer_(placer, mesh),
        queue_(placer, writer_, counts_) {}

  /// \param planes of the row, the next in y and the next in z, where there are any; they must stay
  ///   until finish()
  void place_row(std::int64_t j, std::int64_t k, std::int64_t first_vertex,
                 std::array<PlaneRow, 3>* planes) {
    const NodeBits& nodes = grid_.nodes();
    const EdgeRow edges(nodes, j, k);
    const Index3& dims = grid_.field().block.dims;
    // Rows whose edges in y, and in z, lead to cells of the block from such.
    const bool own = j >= 1 && k >= 1 && j <= dims[1] && k <= dims[2];
    const bool own_along[3] = {own, own && j < dims[1], own && k < dims[2]};
    planes_ = planes;
    const T* const row = own ? row_of_cells(j, k) : nullptr;
    const bool ends_y = is_end(1, j);
    const bool ends_z = is_end(2, k);
    // Nodes whose edges all lead to cells of the block from such, none of them where the mesh may
    // end.
    const bool is_plain_row = own_along[1] && own_along[2] && !ends_y && !ends_z;
    const std::int64_t plain_from = std::max<std::int64_t>(1, nodes.first()[0] + 1);
    auto vertex = static_cast<std::size_t>(first_vertex);
    for (std::int64_t w = 0; w < nodes.words(); ++w) {
      if (planes_ != nullptr) {
        for (PlaneRow& each : *planes_) {
          each.enter_word(w);
        }
      }
      const EdgeWord word = edges.word(w);
      if (word.any() == 0) {
        continue;
      }
      const std::uint64_t inside = nodes.row(j, k)[w];
      if (is_plain_row && (word.any() & ~NodeBits::range(w, plain_from, dims[0] - 1)) == 0) {
        if (queues_windows_) {
          vertex = queue_word(word, {64 * w, j, k}, inside, vertex);
        } else if (!placer_.placement().by_planes) {
          vertex = place_word(word, {64 * w, j, k}, inside, row, vertex);
        } else {
          for_each_edge(word, [&](int bit, std::size_t axis) {
            const bool upper_inside = (inside >> bit & 1) == 0;
            place_own({{64 * w + bit, j, k}, axis, bit, upper_inside}, row, vertex++);
          });
        }
        continue;
      }
      for_each_edge(word, [&](int bit, std::size_t axis) {
        const Index3 node{64 * w + bit, j, k};
        counts_.on_end = counts_.on_end || (axis != 0 && is_end(0, node[0])) ||
                         (axis != 1 && ends_y) || (axis != 2 && ends_z);
        const bool upper_inside = (inside >> bit & 1) == 0;
        if (own_along[axis] && node[0] >= 1 && node[0] + (axis == 0 ? 1 : 0) <= dims[0]) {
          place_own({node, axis, bit, upper_inside}, row, vertex++);
          return;
        }
        const DualEdge edge = edge_from(node, axis, upper_inside);
        const double share =
            placer_.place(edge, is_of_next_block(grid_.field(), node) ? counts_of_next_ : counts_);
        writer_.write(vertex, node, axis, placer_.position(edge, share));
        if (writer_.with_normals()) {
          writer_.write_normal(vertex, placer_.normal(edge, share));
        }
        ++vertex;
      });
    }
  }

  /// Asks for the cells that place_row() will read where it has no windows to solve.
  void read_ahead(std::int64_t j, std::int64_t k) const {
    const Index3& dims = grid_.field().block.dims;
    if (j < 1 || k < 1 || j > dims[1] || k > dims[2]) {
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

  /// All vertices are there after this. Returns the facts about all edges so far.
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

  // True for the outermost nodes of the whole grid: an edge across the axis there lies where the
  // mesh ends.
  [[nodiscard]] bool is_end(std::size_t axis, std::int64_t local) const {
    const BlockField& field = grid_.field();
    return (local == grid_.nodes().first()[axis] && field.block.offset[axis] == 0) ||
           (local == grid_.nodes().last()[axis] &&
            field.block.offset[axis] + field.block.dims[axis] == field.grid.dims[axis]);
  }

  // The edges of a word, all between cells of the block; returns the number of the vertex after
  // theirs. `first` is the node at bit 0.
  std::size_t queue_word(const EdgeWord& word, const Index3& first, std::uint64_t inside,
                         std::size_t vertex) {
    const auto& [here, next_j, next_k] = *planes_;
    for (std::uint64_t left = word.any(); left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      const std::uint64_t mask = left & -left;
      const Index3 node{first[0] + bit, first[1], first[2]};
      const bool upper_inside = (inside & mask) == 0;
      const UnitPlane& lower = here.at(bit);
      if ((word.x & mask) != 0) {
        const UnitPlane& upper = bit < 63 ? (&lower)[1] : here.first_of_next();
        queue_.add(node, 0, upper_inside, vertex++, lower, upper);
      }
      if ((word.y & mask) != 0) {
        queue_.add(node, 1, upper_inside, vertex++, lower, next_j.at(bit));
      }
      if ((word.z & mask) != 0) {
        queue_.add(node, 2, upper_inside, vertex++, lower, next_k.at(bit));
      }
    }
    return vertex;
  }

  // An edge between cells of the block from the node at a bit of the word entered last.
  struct OwnEdge {
    Index3 node;
    std::size_t axis;
    int bit;
    bool upper_inside;
  };

  // As queue_word(), by the fractions of the cells; `row` is that of the lower ones.
  std::size_t place_word(const EdgeWord& word, const Index3& first, std::uint64_t inside,
                         const T* row, std::size_t vertex) {
    OwnEdge edges[kMostEdges];
    double outer[kMostEdges];
    double inner[kMostEdges];
    double position[kMostEdges];
    const Index3& strides = grid_.field().view.strides;
    const T* const cells = row + (first[0] - 1) * strides[0];
    int count = 0;
    for_each_edge(word, [&](int bit, std::size_t axis) {
      const T* const cell = cells + bit * strides[0];
      const double lower = fraction_of(*cell);
      const double upper = fraction_of(cell[strides[axis]]);
      const bool upper_inside = (inside >> bit & 1) == 0;
      edges[count] = {{first[0] + bit, first[1], first[2]}, axis, bit, upper_inside};
      outer[count] = upper_inside ? lower : upper;
      inner[count++] = upper_inside ? upper : lower;
    });
    placer_.placement().place({outer, inner, position, count});
    for (int n = 0; n < count; ++n) {
      const double mu = position[n];
      write_own(edges[n], vertex++, placer_.cleared(edges[n].upper_inside ? mu : 1.0 - mu));
    }
    return vertex;
  }

  // `row` is that of the lower cell.
  void place_own(const OwnEdge& edge, const T* row, std::size_t vertex) {
    if (queues_windows_) {
      queue_.add(edge.node, edge.axis, edge.upper_inside, vertex, lower_plane(edge.bit),
                 upper_plane(edge.axis, edge.bit));
      return;
    }
    write_own(edge, vertex, placer_.cleared(share_of_own(edge, row)));
  }

  void write_own(const OwnEdge& edge, std::size_t vertex, double share) {
    writer_.write(vertex, edge.node, edge.axis,
                  placer_.position_between_cells(edge.node, edge.axis, share));
    if (writer_.with_normals()) {
      const UnitPlane& lower = lower_plane(edge.bit);
      const UnitPlane& upper = upper_plane(edge.axis, edge.bit);
      writer_.write_normal(
          vertex, grid_.field().is_stretched
                      ? placer_.normal(dual_edge(edge), lower, upper, share)
                      : placer_.uniform_normal(edge.axis, edge.upper_inside, lower, upper, share));
    }
  }

  [[nodiscard]] static DualEdge dual_edge(const OwnEdge& edge) {
    return edge_from(edge.node, edge.axis, edge.upper_inside);
  }

  // Not cleared.
  double share_of_own(const OwnEdge& edge, const T* row) {
    if (placer_.placement().by_planes) {
      return placer_.place_by_window(dual_edge(edge), lower_plane(edge.bit),
                                     upper_plane(edge.axis, edge.bit), counts_);
    }
    const Index3& strides = grid_.field().view.strides;
    const T* const cell = row + (edge.node[0] - 1) * strides[0];
    return placer_.share_of(edge.upper_inside, fraction_of(*cell),
                            fraction_of(cell[strides[edge.axis]]));
  }

  // Of the edge along the axis from the node at a bit of the word entered last.
  [[nodiscard]] const UnitPlane& lower_plane(int bit) const { return (*planes_)[0].at(bit); }
  [[nodiscard]] const UnitPlane& upper_plane(std::size_t axis, int bit) const {
    if (axis != 0) {
      return (*planes_)[axis].at(bit);
    }
    return bit < 63 ? (&lower_plane(bit))[1] : (*planes_)[0].first_of_next();
  }

  static constexpr int kMostEdges = 3 * 64;  // that start at the nodes of a word

  const VertexPlacer& placer_;
  const DualGrid& grid_;
  bool queues_windows_;
  EdgeCounts counts_;
  EdgeCounts counts_of_next_;
  VertexWriter writer_;
  WindowQueue queue_;
  std::array<PlaneRow, 3>* planes_ = nullptr;
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

// What came of a range of rows.
struct Placed {
  EdgeCounts edges;
  SourceCounts sources;
  std::int64_t planes = 0;
  double plane_seconds = 0.0;
  double seconds = 0.0;
};

// Rows of which no vertex needs a plane.
template <class T>
Placed place_rows(const VertexPlacer& placer, const std::vector<std::int64_t>& row_start,
                  std::int64_t begin, std::int64_t end, Mesh& mesh) {
  const std::int64_t row_length = placer.grid().nodes().last()[1] + 1;
  RowPlacer<T> row_placer(placer, mesh);
  RowsAhead ahead;
  const auto place = [&](std::int64_t row) {
    row_placer.place_row(row % row_length, row / row_length,
                         row_start[static_cast<std::size_t>(row)], nullptr);
  };
  for (std::int64_t row = begin; row < end; ++row) {
    if (row_start[static_cast<std::size_t>(row)] != row_start[static_cast<std::size_t>(row) + 1]) {
      row_placer.read_ahead(row % row_length, row / row_length);
      ahead.push(row, place);
    }
  }
  ahead.drain(place);
  Placed result;
  result.edges = row_placer.finish();
  return result;
}

// The rows of a tile, slab by slab.
template <class T>
Placed place_tile(const VertexPlacer& placer, const FitterPlan<T>& plan,
                  const std::vector<std::int64_t>& row_start, const RowTile& tile, Mesh& mesh) {
  const NodeBits& nodes = placer.grid().nodes();
  Stopwatch watch;
  RowPlacer<T> row_placer(placer, mesh);
  PlaneSlabs<T> slabs(plan, placer.grid(), tile);
  Placed result;
  for (std::int64_t k = tile.first[1]; k < tile.end[1]; ++k) {
    slabs.move_to(k);
    for (std::int64_t j = tile.first[0]; j < tile.end[0]; ++j) {
      const auto row = static_cast<std::size_t>(nodes.row_index(j, k));
      if (row_start[row] == row_start[row + 1]) {
        continue;
      }
      std::array<PlaneRow, 3> planes{slabs.row(j, k),
                                     slabs.row(std::min(j + 1, nodes.last()[1]), k),
                                     slabs.row(j, std::min(k + 1, nodes.last()[2]))};
      row_placer.place_row(j, k, row_start[row], &planes);
    }
    result.edges = row_placer.finish();
  }
  result.sources = slabs.counts();
  result.planes = slabs.planes();
  result.plane_seconds = slabs.seconds();
  result.seconds = watch.lap();
  return result;
}

// Vertices by row in y (axis 0) or by slab (axis 1) of nodes.
std::vector<std::int64_t> histogram(const NodeBits& nodes,
                                    const std::vector<std::int64_t>& row_start, std::size_t axis) {
  std::vector<std::int64_t> vertices(static_cast<std::size_t>(nodes.last()[axis + 1]) + 1, 0);
  for (std::int64_t k = 0; k <= nodes.last()[2]; ++k) {
    for (std::int64_t j = 0; j <= nodes.last()[1]; ++j) {
      const auto row = static_cast<std::size_t>(nodes.row_index(j, k));
      vertices[static_cast<std::size_t>(axis == 0 ? j : k)] += row_start[row + 1] - row_start[row];
    }
  }
  return vertices;
}

// Tiles of about as many vertices each: slabs, or rows in y where the surface lies in few slabs.
// Each tile computes the planes of the rows after it once more, so there are few: enough to keep
// the threads busy to the end, and to report progress between them.
std::vector<RowTile> make_tiles(const NodeBits& nodes, const std::vector<std::int64_t>& row_start,
                                const Phases& phases) {
  constexpr std::int64_t kTilesPerThread = 6;
  const std::int64_t wanted = std::max<std::int64_t>(
      phases.threads() == 1 ? 1 : kTilesPerThread * phases.threads(), phases.least_portions());
  const RowTile all{{0, 0}, {nodes.last()[1] + 1, nodes.last()[2] + 1}};
  if (wanted == 1) {
    return {all};
  }
  std::size_t axis = 1;
  std::vector<std::int64_t> vertices = histogram(nodes, row_start, axis);
  std::int64_t most = *std::max_element(vertices.begin(), vertices.end());
  const std::int64_t total = row_start.back();
  if (most > total / wanted) {
    std::vector<std::int64_t> by_row = histogram(nodes, row_start, 0);
    if (*std::max_element(by_row.begin(), by_row.end()) < most) {
      axis = 0;
      vertices = std::move(by_row);
    }
  }
  std::vector<RowTile> tiles;
  RowTile tile = all;
  std::int64_t before = 0;
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    before += vertices[n];
    const bool is_last = n + 1 == vertices.size();
    if (is_last || before * wanted >= total * static_cast<std::int64_t>(tiles.size() + 1)) {
      tile.end[axis] = is_last ? all.end[axis] : static_cast<std::int64_t>(n) + 1;
      tiles.push_back(tile);
      tile.first[axis] = tile.end[axis];
    }
  }
  return tiles;
}

}  // namespace

void place_vertices(const DualGrid& grid, const Options& options,
                    const std::vector<std::int64_t>& row_start, Phases& phases, Mesh& mesh,
                    Report& report) {
  const auto total = static_cast<std::size_t>(row_start.back());
  mesh.positions.resize(total);
  mesh.normals.resize(options.vertex_normals ? total : 0);
  mesh.edge_ids.resize(options.edge_ids ? total : 0);
  hint_large_pages(mesh.positions);
  hint_large_pages(mesh.normals);
  const NodeBits& nodes = grid.nodes();
  const VertexPlacer placer(grid, options);
  const bool with_planes = placer.placement().by_planes || options.vertex_normals;
  const std::vector<RowTile> tiles =
      with_planes ? make_tiles(nodes, row_start, phases) : std::vector<RowTile>{};
  const std::int64_t count = with_planes ? static_cast<std::int64_t>(tiles.size()) : nodes.rows();
  const std::int64_t grain = with_planes ? 1 : rows_per_portion(nodes);
  std::vector<Placed> portions(static_cast<std::size_t>((count + grain - 1) / grain));
  Stopwatch watch;
  with_scalar(grid.field().view.type, [&](auto type) {
    using T = decltype(type);
    const FitterPlan<T> plan(grid.field(), options.normals);
    phases.run(kVertices.weight, count, grain, [&](std::int64_t begin, std::int64_t end) {
      portions[static_cast<std::size_t>(begin / grain)] =
          with_planes
              ? place_tile<T>(placer, plan, row_start, tiles[static_cast<std::size_t>(begin)], mesh)
              : place_rows<T>(placer, row_start, begin, end, mesh);
    });
  });
  double all_seconds = 0.0;
  double plane_seconds = 0.0;
  std::int64_t steps = newton_steps(report);
  for (const Placed& portion : portions) {
    const EdgeCounts& counts = portion.edges;
    report.solved_edges += counts.solved;
    report.newton_steps_max = std::max(report.newton_steps_max, counts.most_steps);
    report.non_monotone_edges += counts.non_monotone;
    report.closed = report.closed && !counts.on_end;
    steps += counts.steps;
    report.planes += portion.planes;
    portion.sources.add_to(report);
    plane_seconds += portion.plane_seconds;
    all_seconds += portion.seconds;
  }
  set_newton_steps(steps, report);
  // Planes and vertices take turns in each thread: the wall time is shared out as theirs is.
  const double seconds = watch.lap();
  const double for_planes = all_seconds > 0.0 ? seconds * plane_seconds / all_seconds : 0.0;
  report.seconds.normals += for_planes;
  report.seconds.vertices += seconds - for_planes;
}

}  // namespace difmesh::detail
