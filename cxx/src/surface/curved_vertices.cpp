#include "surface/curved_vertices.hpp"

#include <numeric>

#include "surface/curved_edge.hpp"
#include "surface/phase.hpp"
#include "surface/vertex_placer.hpp"

namespace difmesh::detail {
namespace {

// Whether the fractions of the two cells cross 1/2 as the nodes do: else no window could be half
// full.
bool has_window(const DualGrid& grid, const DualEdge& edge) {
  const auto is_full = [&](const Index3& node) {
    return grid.cell_fraction(node, grid.origin(node)) >= 0.5;
  };
  return is_full(edge.lower) != is_full(edge.upper) || grid.origin(edge.lower).on_face() ||
         grid.origin(edge.upper).on_face();
}

class VertexCurver {
 public:
  VertexCurver(const SurfaceTable& table, const DualGrid& grid, const Options& options, Mesh& mesh)
      : table_(table), grid_(grid), placer_(grid, options), mesh_(mesh) {}

  // Returns how many vertices were moved.
  [[nodiscard]] std::int64_t curve_row(std::int64_t j, std::int64_t k, std::int64_t vertex) const {
    const NodeBits& nodes = grid_.nodes();
    const EdgeRow edges(nodes, j, k);
    auto number = static_cast<std::size_t>(vertex);
    std::int64_t moved = 0;
    for (std::int64_t w = 0; w < nodes.words(); ++w) {
      const std::uint64_t inside = nodes.row(j, k)[w];
      for_each_edge(edges.word(w), [&](int bit, std::size_t axis) {
        const Index3 node{64 * w + bit, j, k};
        const bool upper_inside = (inside >> bit & 1) == 0;
        const bool is_moved = curve(edge_from(node, axis, upper_inside), number++);
        moved += is_moved && !is_of_next_block(grid_.field(), node) ? 1 : 0;
      });
    }
    return moved;
  }

 private:
  bool curve(const DualEdge& edge, std::size_t number) const {
    const bool is_window = has_window(grid_, edge);
    const CurvedEdge curved(table_, grid_, edge);
    double share = 0.5;
    const bool is_curved = curved.place(is_window ? share_of(edge, number) : 0.5, share);
    if (!is_curved && is_window) {
      return false;
    }
    share = placer_.cleared(is_curved ? share : 0.5);
    mesh_.positions[number] = placer_.position(edge, share);
    if (is_curved && !mesh_.normals.empty()) {
      mesh_.normals[number] = curved.normal(share);
    }
    return is_curved;
  }

  // Of the way from the lower node to the upper one, where the vertex is now.
  [[nodiscard]] double share_of(const DualEdge& edge, std::size_t number) const {
    const double low = grid_.coordinate(edge.axis, edge.lower[edge.axis]);
    const double high = grid_.coordinate(edge.axis, edge.upper[edge.axis]);
    return within((mesh_.positions[number][edge.axis] - low) / (high - low), 0.0, 1.0);
  }

  const SurfaceTable& table_;
  const DualGrid& grid_;
  VertexPlacer placer_;
  Mesh& mesh_;
};

}  // namespace

std::int64_t curve_vertices(const SurfaceTable& table, const DualGrid& grid, const Options& options,
                            const std::vector<std::int64_t>& row_start, Phases& phases,
                            Mesh& mesh) {
  const NodeBits& nodes = grid.nodes();
  const std::int64_t row_length = nodes.last()[1] + 1;
  const std::int64_t grain = rows_per_portion(nodes);
  std::vector<std::int64_t> moved(static_cast<std::size_t>((nodes.rows() + grain - 1) / grain));
  const VertexCurver curver(table, grid, options, mesh);
  phases.run(kCurving.weight, nodes.rows(), grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const std::int64_t vertex = row_start[static_cast<std::size_t>(row)];
      if (vertex != row_start[static_cast<std::size_t>(row) + 1]) {
        moved[static_cast<std::size_t>(begin / grain)] +=
            curver.curve_row(row % row_length, row / row_length, vertex);
      }
    }
  });
  return std::accumulate(moved.begin(), moved.end(), std::int64_t{0});
}

}  // namespace difmesh::detail
