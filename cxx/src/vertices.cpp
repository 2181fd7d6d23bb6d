#include "vertices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "placement.hpp"
#include "window.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kRowsPerPortion = 16;

struct EdgeCounts {
  std::int64_t solved = 0;
  std::int64_t steps = 0;
  std::int64_t most_steps = 0;
  std::int64_t non_monotone = 0;
  bool on_end = false;
};

// A crossed dual edge and what is known at its two nodes.
struct DualEdge {
  Index3 lower;
  Index3 upper;
  std::size_t axis = 0;
  bool upper_inside = false;
};

// Places the vertices of one kind of options on one dual grid. Thread safety: const calls are safe.
class VertexPlacer {
 public:
  VertexPlacer(const DualGrid& grid, const Options& options)
      : grid_(grid), options_(options), with_planes_(options.placement == Placement::plic) {}

  // The vertex's share of the way from the lower node to the upper one.
  double place(const DualEdge& edge, EdgeCounts& counts) const {
    double share = 0.5;
    if (!with_planes_) {
      share = place_by_fractions(edge);
    } else if (grid_.is_own(edge.lower) && grid_.is_own(edge.upper)) {
      share = place_by_window(edge, grid_.planes().at(edge.lower), grid_.planes().at(edge.upper),
                              counts);
    } else {
      share = place_at_side(edge, counts);
    }
    return std::clamp(share, options_.clearance, 1.0 - options_.clearance);
  }

  Vec3 position(const DualEdge& edge, double share) const {
    Vec3 position;
    for (std::size_t t = 0; t < 3; ++t) {
      position[t] = grid_.coordinate(t, edge.lower[t]);
    }
    const double low = position[edge.axis];
    const double high = grid_.coordinate(edge.axis, edge.upper[edge.axis]);
    const BlockField& field = grid_.field();
    const bool half_edge = is_half_edge(edge);
    const auto index =
        static_cast<double>(edge.lower[edge.axis] - 1 + field.block.offset[edge.axis]);
    const double along = half_edge ? low + share * (high - low)
                                   : field.grid.origin[edge.axis] +
                                         (index + 0.5 + share) * field.grid.spacing[edge.axis];
    // Rounding must not carry a vertex onto a node.
    constexpr double kFar = std::numeric_limits<double>::infinity();
    position[edge.axis] = std::clamp(along, std::nextafter(low, kFar), std::nextafter(high, -kFar));
    return position;
  }

  Vec3 normal(const DualEdge& edge, double share) const {
    Vec3 sum{0.0, 0.0, 0.0};
    add_normal(edge, edge.lower, 1.0 - share, sum);
    add_normal(edge, edge.upper, share, sum);
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    if (!(length > 0.0)) {
      sum = {0.0, 0.0, 0.0};
      sum[edge.axis] = edge.upper_inside ? -1.0 : 1.0;
      return sum;
    }
    return {sum[0] / length, sum[1] / length, sum[2] / length};
  }

 private:
  // Between a cell centre and a domain face.
  [[nodiscard]] bool is_half_edge(const DualEdge& edge) const {
    const BlockField& field = grid_.field();
    const std::int64_t index = edge.lower[edge.axis] - 1 + field.block.offset[edge.axis];
    const auto ends_on_face = [](Side side) { return side == Side::open || side == Side::mirror; };
    return (index < 0 && ends_on_face(field.sides[2 * edge.axis])) ||
           (index == field.grid.dims[edge.axis] - 1 &&
            ends_on_face(field.sides[2 * edge.axis + 1]));
  }

  [[nodiscard]] double place_by_fractions(const DualEdge& edge) const {
    if (options_.placement == Placement::midpoint) {
      return 0.5;
    }
    const double lower = fraction_at(edge.lower);
    const double upper = fraction_at(edge.upper);
    const double outer = edge.upper_inside ? lower : upper;
    const double inner = edge.upper_inside ? upper : lower;
    const double mu = options_.placement == Placement::linear ? linear_position(outer, inner)
                                                              : manson_position(outer, inner);
    return edge.upper_inside ? mu : 1.0 - mu;
  }

  [[nodiscard]] double fraction_at(const Index3& node) const {
    if (!grid_.is_own(node)) {
      return grid_.cell_fraction(node, grid_.origin(node));
    }
    const Index3& offset = grid_.field().block.offset;
    return grid_.field().fraction(
        {node[0] - 1 + offset[0], node[1] - 1 + offset[1], node[2] - 1 + offset[2]});
  }

  [[nodiscard]] EdgePlane oriented(const DualEdge& edge, const UnitPlane& plane) const {
    EdgePlane result;
    result.a = plane.a;
    if (!plane.has_normal()) {
      result.is_pure = std::abs(plane.a) >= 0.5;
      // No gradient: the normal runs along the edge, towards the outer cell.
      result.along = result.is_pure ? 0.0 : -1.0;
      return result;
    }
    result.is_pure = false;
    result.along = edge.upper_inside ? plane.m[edge.axis] : -plane.m[edge.axis];
    result.across0 = plane.m[(edge.axis + 1) % 3];
    result.across1 = plane.m[(edge.axis + 2) % 3];
    return result;
  }

  [[nodiscard]] double place_by_window(const DualEdge& edge, const UnitPlane& lower,
                                       const UnitPlane& upper, EdgeCounts& counts) const {
    const UnitPlane& outer = edge.upper_inside ? lower : upper;
    const UnitPlane& inner = edge.upper_inside ? upper : lower;
    const EdgePlane outer_plane = oriented(edge, outer);
    const EdgePlane inner_plane = oriented(edge, inner);
    const WindowRoot root = solve_window(outer_plane, inner_plane, [&] {
      return Algorithm1Start{window_guess(outer_plane, inner_plane), physical_weight(edge, outer),
                             physical_weight(edge, inner)};
    });
    ++counts.solved;
    counts.steps += root.steps;
    counts.most_steps = std::max<std::int64_t>(counts.most_steps, root.steps);
    counts.non_monotone += root.non_monotone ? 1 : 0;
    return edge.upper_inside ? root.mu : 1.0 - root.mu;
  }

  // Manson's position from the fractions that the planes stand for.
  [[nodiscard]] static double window_guess(const EdgePlane& outer, const EdgePlane& inner) {
    return manson_position(window::filling(outer, inner, 0.0).excess + 0.5,
                           window::filling(outer, inner, 1.0).excess + 0.5);
  }

  [[nodiscard]] double physical_weight(const DualEdge& edge, const UnitPlane& plane) const {
    const Vec3& spacing = grid_.field().grid.spacing;
    if (!plane.has_normal()) {
      return std::abs(plane.a) >= 0.5 ? 0.0 : spacing[edge.axis];
    }
    return 1.0 /
           std::hypot(plane.m[0] / spacing[0], plane.m[1] / spacing[1], plane.m[2] / spacing[2]);
  }

  // Edges that touch a side of the domain.
  [[nodiscard]] double place_at_side(const DualEdge& edge, EdgeCounts& counts) const {
    const NodeOrigin lower = grid_.origin(edge.lower);
    const NodeOrigin upper = grid_.origin(edge.upper);
    if (!lower.constant && !upper.constant && lower.cell == upper.cell) {
      return place_on_half_edge(edge, lower, upper);
    }
    const bool crossed_cells = !lower.constant && !upper.constant &&
                               grid_.nodes().test(lower.cell) != grid_.nodes().test(upper.cell);
    return place_by_window(edge, node_plane(edge.lower, lower, crossed_cells),
                           node_plane(edge.upper, upper, crossed_cells), counts);
  }

  // From a cell's centre to its domain face there is one plane; it meets the edge.
  [[nodiscard]] double place_on_half_edge(const DualEdge& edge, const NodeOrigin& lower,
                                          const NodeOrigin& upper) const {
    const bool face_above = upper.face[edge.axis] > 0;
    std::array<int, 3> face = face_above ? lower.face : upper.face;
    const UnitPlane plane = trace(grid_.planes().at(lower.cell), face);
    const double from_centre = 2.0 * plane.a / plane.m[edge.axis];
    return face_above ? from_centre : 1.0 + from_centre;
  }

  // The plane that stands for a node in a window: on open faces the trace of its cell's plane,
  // which makes the window one of the face. Which planes serve depends on nothing but the two
  // cells, so blocks that share the edge agree.
  [[nodiscard]] UnitPlane node_plane(const Index3& node, const NodeOrigin& origin,
                                     bool crossed_cells) const {
    const UnitPlane plane = grid_.cell_plane(node, origin);
    if (!origin.on_face() || origin.constant || !plane.has_normal()) {
      return plane;
    }
    const bool inside = grid_.nodes().test(node);
    const UnitPlane traced = trace(plane, origin.face);
    const bool serves =
        crossed_cells || grid_.field().is_interfacial(grid_.cell_fraction(node, origin));
    if (serves && (traced.a >= 0.0) == inside) {
      return traced.has_normal() ? traced : UnitPlane::pure(inside);
    }
    return UnitPlane::pure(inside);
  }

  void add_normal(const DualEdge& edge, const Index3& node, double share, Vec3& sum) const {
    const UnitPlane plane = grid_.cell_plane(node, grid_.origin(node));
    const double weight = share * physical_weight(edge, plane);
    const Vec3& spacing = grid_.field().grid.spacing;
    if (!plane.has_normal()) {
      sum[edge.axis] += (edge.upper_inside ? -weight : weight) / spacing[edge.axis];
      return;
    }
    for (std::size_t t = 0; t < 3; ++t) {
      sum[t] += weight * plane.m[t] / spacing[t];
    }
  }

  const DualGrid& grid_;
  const Options& options_;
  bool with_planes_;
};

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

std::uint64_t edge_id(const BlockField& field, const Index3& node, std::size_t axis) {
  std::uint64_t number = 0;
  for (std::size_t t = 3; t-- > 0;) {
    number = number * static_cast<std::uint64_t>(field.grid.dims[t] + 2) +
             static_cast<std::uint64_t>(node[t] + field.block.offset[t]);
  }
  return 3 * number + axis;
}

// True if the edge lies in an outermost plane of nodes: the mesh ends there.
bool lies_on_end(const NodeBits& nodes, const DualEdge& edge) {
  for (std::size_t t = 0; t < 3; ++t) {
    if (t != edge.axis && (edge.lower[t] == nodes.first()[t] || edge.lower[t] == nodes.last()[t])) {
      return true;
    }
  }
  return false;
}

void place_row(const DualGrid& grid, const VertexPlacer& placer, std::int64_t row,
               std::int64_t vertex, Mesh& mesh, EdgeCounts& counts) {
  const NodeBits& nodes = grid.nodes();
  const std::int64_t row_length = nodes.last()[1] + 1;
  const std::int64_t j = row % row_length;
  const std::int64_t k = row / row_length;
  const EdgeRow edges(nodes, j, k);
  for (std::int64_t w = 0; w < nodes.words(); ++w) {
    for_each_edge(edges.word(w), [&](int bit, std::size_t axis) {
      DualEdge edge{{64 * w + bit, j, k}, {64 * w + bit, j, k}, axis, false};
      ++edge.upper[axis];
      edge.upper_inside = nodes.test(edge.upper);
      const double share = placer.place(edge, counts);
      const auto number = static_cast<std::size_t>(vertex++);
      mesh.positions[number] = placer.position(edge, share);
      if (!mesh.normals.empty()) {
        mesh.normals[number] = placer.normal(edge, share);
      }
      if (!mesh.edge_ids.empty()) {
        mesh.edge_ids[number] = edge_id(grid.field(), edge.lower, axis);
      }
      counts.on_end = counts.on_end || lies_on_end(nodes, edge);
    });
  }
}

}  // namespace

std::vector<std::int64_t> count_vertices(const NodeBits& nodes, Phases& phases) {
  const std::int64_t row_length = nodes.last()[1] + 1;
  std::vector<std::int64_t> start(static_cast<std::size_t>(nodes.rows()) + 1, 0);
  phases.run(0.02, nodes.rows(), kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const std::int64_t j = row % row_length;
      const std::int64_t k = row / row_length;
      if (j < nodes.first()[1] || k < nodes.first()[2]) {
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
  const VertexPlacer placer(grid, options);
  const std::int64_t rows = grid.nodes().rows();
  std::vector<EdgeCounts> portions(
      static_cast<std::size_t>((rows + kRowsPerPortion - 1) / kRowsPerPortion));
  phases.run(0.25, rows, kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
    EdgeCounts counts;
    for (std::int64_t row = begin; row < end; ++row) {
      const std::int64_t vertex = row_start[static_cast<std::size_t>(row)];
      if (vertex != row_start[static_cast<std::size_t>(row) + 1]) {
        place_row(grid, placer, row, vertex, mesh, counts);
      }
    }
    portions[static_cast<std::size_t>(begin / kRowsPerPortion)] = counts;
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
