#pragma once
// Where the vertices of single dual edges lie.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "placement/manson.hpp"
#include "placement/placement.hpp"
#include "planes/unit_plane.hpp"
#include "planes/window.hpp"
#include "surface/dual_grid.hpp"

namespace difmesh::detail {

/// Facts about the edges of some rows.
struct EdgeCounts {
  std::int64_t solved = 0;
  std::int64_t steps = 0;
  std::int64_t most_steps = 0;
  std::int64_t non_monotone = 0;
  bool on_end = false;

  void add(const WindowRoot& root) {
    ++solved;
    steps += root.steps;
    most_steps = std::max<std::int64_t>(most_steps, root.steps);
    non_monotone += root.non_monotone ? 1 : 0;
  }
};

/// Between two bounds whatever the value is, if it is no number too.
[[nodiscard]] inline double within(double value, double low, double high) {
  const double raised = value > low ? value : low;
  return raised < high ? raised : high;
}

/// A crossed dual edge and what is known at its two nodes.
struct DualEdge {
  Index3 lower;
  Index3 upper;
  std::size_t axis = 0;
  bool upper_inside = false;
};

/// The edge from a node along an axis.
[[nodiscard]] inline DualEdge edge_from(const Index3& lower, std::size_t axis, bool upper_inside) {
  DualEdge edge{lower, lower, axis, upper_inside};
  ++edge.upper[axis];
  return edge;
}

/// True for nodes that are cells of the blocks after this one: their edges are counted there.
[[nodiscard]] inline bool is_of_next_block(const BlockField& field, const Index3& node) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (node[axis] > field.block.dims[axis] &&
        field.block.offset[axis] + field.block.dims[axis] < field.grid.dims[axis]) {
      return true;
    }
  }
  return false;
}

/// Places the vertices of one kind of options on one dual grid. Thread safety: const calls are
/// safe.
class VertexPlacer {
 public:
  VertexPlacer(const DualGrid& grid, const Options& options)
      : grid_(grid),
        options_(options),
        placement_(placement_part(options.placement)),
        is_stretched_(grid.field().is_stretched) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first_index_[axis] = static_cast<double>(grid.field().block.offset[axis] - 1);
      const std::int64_t last = grid.nodes().last()[axis];
      for (std::int64_t local = 0; local <= last; ++local) {
        const double node = grid.coordinate(axis, local);
        after_[axis].push_back(std::nextafter(node, kFar));
        before_[axis].push_back(std::nextafter(node, -kFar));
      }
    }
  }

  [[nodiscard]] const DualGrid& grid() const { return grid_; }
  [[nodiscard]] const PlacementPart& placement() const { return placement_; }

  [[nodiscard]] double cleared(double share) const {
    return within(share, options_.clearance, 1.0 - options_.clearance);
  }

  // By the window over the planes of two cells: the share of the way, not cleared.
  [[nodiscard]] double place_by_window(const DualEdge& edge, const UnitPlane& lower,
                                       const UnitPlane& upper, EdgeCounts& counts) const {
    EdgePlane outer = oriented(edge, edge.upper_inside ? lower : upper);
    EdgePlane inner = oriented(edge, edge.upper_inside ? upper : lower);
    if (is_stretched_) {
      outer.size = cell_size(edge.upper_inside ? edge.lower : edge.upper)[edge.axis];
      inner.size = cell_size(edge.upper_inside ? edge.upper : edge.lower)[edge.axis];
    }
    const WindowRoot root =
        solve_window(outer, inner, [&] { return algorithm1_start(edge, lower, upper); });
    counts.add(root);
    return edge.upper_inside ? root.mu : 1.0 - root.mu;
  }

  // The vertex's share of the way from the lower node to the upper one.
  double place(const DualEdge& edge, EdgeCounts& counts) const {
    return cleared(placement_.by_planes ? place_at_side(edge, counts) : place_by_fractions(edge));
  }

  [[nodiscard]] Vec3 position(const DualEdge& edge, double share) const {
    return is_half_edge(edge) ? position_between_nodes(edge.lower, edge.axis, share)
                              : position_between_cells(edge.lower, edge.axis, share);
  }

  // The same for edges from a cell's centre to another's.
  [[nodiscard]] Vec3 position_between_cells(const Index3& lower, std::size_t axis,
                                            double share) const {
    if (is_stretched_) {
      return position_between_nodes(lower, axis, share);
    }
    const Grid& grid = grid_.field().grid;
    const double index = static_cast<double>(lower[axis]) + first_index_[axis];
    return at(lower, axis, grid.origin[axis] + (index + 0.5 + share) * grid.spacing[axis]);
  }

  [[nodiscard]] Vec3 normal(const DualEdge& edge, double share) const {
    const EdgeOrigins ends = origins(edge);
    return normal(edge, edge_plane(edge.lower, ends.lower, ends),
                  edge_plane(edge.upper, ends.upper, ends), share);
  }

  // The same from the planes of the two cells.
  [[nodiscard]] Vec3 normal(const DualEdge& edge, const UnitPlane& lower, const UnitPlane& upper,
                            double share) const {
    return normal(edge.axis, edge.upper_inside, {lower, cell_size(edge.lower)},
                  {upper, cell_size(edge.upper)}, share);
  }

  // The same where all cells have one size.
  [[nodiscard]] Vec3 uniform_normal(std::size_t axis, bool upper_inside, const UnitPlane& lower,
                                    const UnitPlane& upper, double share) const {
    const Vec3& spacing = grid_.field().grid.spacing;
    return normal(axis, upper_inside, {lower, spacing}, {upper, spacing}, share);
  }

  // From the fractions of the two cells. \pre the placement is not by planes
  [[nodiscard]] double share_of(bool upper_inside, double lower, double upper) const {
    const double outer = upper_inside ? lower : upper;
    const double inner = upper_inside ? upper : lower;
    double mu = 0.0;
    placement_.place({&outer, &inner, &mu, 1});
    return upper_inside ? mu : 1.0 - mu;
  }

  // A plane as it is seen from the edge.
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

  [[nodiscard]] Algorithm1Start algorithm1_start(const DualEdge& edge, const UnitPlane& lower,
                                                 const UnitPlane& upper) const {
    const UnitPlane& outer = edge.upper_inside ? lower : upper;
    const UnitPlane& inner = edge.upper_inside ? upper : lower;
    const Index3& outer_node = edge.upper_inside ? edge.lower : edge.upper;
    const Index3& inner_node = edge.upper_inside ? edge.upper : edge.lower;
    return {window_guess(oriented(edge, outer), oriented(edge, inner)),
            physical_weight(edge.axis, outer, cell_size(outer_node)),
            physical_weight(edge.axis, inner, cell_size(inner_node))};
  }

 private:
  // What the two nodes of an edge stand for.
  struct EdgeOrigins {
    NodeOrigin lower;
    NodeOrigin upper;
    bool crossed_cells;  // one cell, or what lies beyond a side, is inside, the other outside

    [[nodiscard]] bool is_one_cell() const {
      return !lower.constant && !upper.constant && lower.cell == upper.cell;
    }
  };

  [[nodiscard]] EdgeOrigins origins(const DualEdge& edge) const {
    EdgeOrigins ends{grid_.origin(edge.lower), grid_.origin(edge.upper), false};
    ends.crossed_cells = grid_.is_cell_inside(edge.lower, ends.lower) !=
                         grid_.is_cell_inside(edge.upper, ends.upper);
    return ends;
  }

  // Between a cell centre and a domain face.
  [[nodiscard]] bool is_half_edge(const DualEdge& edge) const {
    const BlockField& field = grid_.field();
    const std::int64_t index = edge.lower[edge.axis] - 1 + field.block.offset[edge.axis];
    const auto ends_on_face = [](Side side) { return side == Side::open || side == Side::mirror; };
    return (index < 0 && ends_on_face(field.boundary[2 * edge.axis])) ||
           (index == field.grid.dims[edge.axis] - 1 &&
            ends_on_face(field.boundary[2 * edge.axis + 1]));
  }

  [[nodiscard]] double place_by_fractions(const DualEdge& edge) const {
    return share_of(edge.upper_inside, fraction_at(edge.lower), fraction_at(edge.upper));
  }

  [[nodiscard]] double fraction_at(const Index3& node) const {
    return grid_.cell_fraction(node, grid_.origin(node));
  }

  // Manson's position from the fractions that the planes stand for.
  [[nodiscard]] static double window_guess(const EdgePlane& outer, const EdgePlane& inner) {
    const window::Plane outer_plane = window::prepared(outer);
    const window::Plane inner_plane = window::prepared(inner);
    return manson_position(baseline::filling(outer_plane, inner_plane, 0.0).excess + 0.5,
                           baseline::filling(outer_plane, inner_plane, 1.0).excess + 0.5);
  }

  // Sizes of the cell that a node is, or stands for.
  [[nodiscard]] Vec3 cell_size(const Index3& node) const {
    const Index3& offset = grid_.field().block.offset;
    return grid_.field().cell_size(
        {node[0] - 1 + offset[0], node[1] - 1 + offset[1], node[2] - 1 + offset[2]});
  }

  [[nodiscard]] static double physical_weight(std::size_t axis, const UnitPlane& plane,
                                              const Vec3& spacing) {
    if (!plane.has_normal()) {
      return std::abs(plane.a) >= 0.5 ? 0.0 : spacing[axis];
    }
    return 1.0 /
           std::hypot(plane.m[0] / spacing[0], plane.m[1] / spacing[1], plane.m[2] / spacing[2]);
  }

  // Edges that touch a side of the domain.
  [[nodiscard]] double place_at_side(const DualEdge& edge, EdgeCounts& counts) const {
    const EdgeOrigins ends = origins(edge);
    if (ends.is_one_cell()) {
      return place_on_half_edge(edge, ends);
    }
    return place_by_window(edge, node_plane(edge.lower, ends.lower, ends),
                           node_plane(edge.upper, ends.upper, ends), counts);
  }

  // From a cell's centre to its domain face, or between two faces of the cell, there is one plane;
  // it meets the edge. What it says of both nodes made the edge a crossed one, so it is not
  // parallel to the edge: see trace().
  [[nodiscard]] double place_on_half_edge(const DualEdge& edge, const EdgeOrigins& ends) const {
    const bool face_above = ends.upper.face[edge.axis] > 0;
    const UnitPlane plane =
        trace(grid_.planes().at(ends.lower.cell), face_above ? ends.lower.face : ends.upper.face);
    const double from_centre = 2.0 * plane.a / plane.m[edge.axis];
    return face_above ? from_centre : 1.0 + from_centre;
  }

  // The plane of the cell that a node of an edge stands for. Which serve depends on nothing but the
  // two cells, so blocks that share the edge agree. Cells of crossed edges have planes, and so have
  // the interfacial ones along open sides; others may have one for the sake of an edge that this
  // block does not see.
  [[nodiscard]] UnitPlane edge_plane(const Index3& node, const NodeOrigin& origin,
                                     const EdgeOrigins& ends) const {
    const bool serves =
        ends.crossed_cells || grid_.field().is_interfacial(grid_.cell_fraction(node, origin));
    return serves ? grid_.cell_plane(node, origin)
                  : UnitPlane::pure(grid_.is_cell_inside(node, origin));
  }

  // The plane that stands for a node in a window: on open faces the trace of its cell's plane,
  // which makes the window one of the face.
  [[nodiscard]] UnitPlane node_plane(const Index3& node, const NodeOrigin& origin,
                                     const EdgeOrigins& ends) const {
    const UnitPlane plane = edge_plane(node, origin, ends);
    if (!origin.on_face() || origin.constant || !plane.has_normal()) {
      return plane;
    }
    const bool inside = grid_.nodes().test(node);
    const UnitPlane traced = trace(plane, origin.face);
    // The trace does not decide on the node's side where the cell is a smear: see
    // DualGrid::is_extended().
    if (traced.is_centre_inside() != inside || !traced.has_normal()) {
      return UnitPlane::pure(inside);
    }
    return traced;
  }

  // A plane in a cell of a size.
  struct CellPlane {
    const UnitPlane& plane;
    const Vec3& size;
  };

  [[nodiscard]] static Vec3 normal(std::size_t axis, bool upper_inside, const CellPlane& lower,
                                   const CellPlane& upper, double share) {
    // Two normals that are opposite but for this share of them leave rounding and no direction.
    constexpr double kCancelled = 1e-14;
    Vec3 sum{0.0, 0.0, 0.0};
    double total = add_normal(axis, upper_inside, lower, 1.0 - share, sum);
    total += add_normal(axis, upper_inside, upper, share, sum);
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    if (!(length > kCancelled * total)) {
      sum = {0.0, 0.0, 0.0};
      sum[axis] = upper_inside ? -1.0 : 1.0;
      return sum;
    }
    return {sum[0] / length, sum[1] / length, sum[2] / length};
  }

  // Returns the length of what it adds.
  static double add_normal(std::size_t axis, bool upper_inside, const CellPlane& of, double share,
                           Vec3& sum) {
    const auto& [plane, spacing] = of;
    const double weight = share * physical_weight(axis, plane, spacing);
    if (!plane.has_normal()) {
      sum[axis] += (upper_inside ? -weight : weight) / spacing[axis];
      return weight > 0.0 ? share : 0.0;
    }
    for (std::size_t t = 0; t < 3; ++t) {
      sum[t] += weight * plane.m[t] / spacing[t];
    }
    return share;
  }

  [[nodiscard]] Vec3 position_between_nodes(const Index3& lower, std::size_t axis,
                                            double share) const {
    const double low = grid_.coordinate(axis, lower[axis]);
    const double high = grid_.coordinate(axis, lower[axis] + 1);
    return at(lower, axis, low + share * (high - low));
  }

  // Rounding must not carry a vertex onto a node. Between two nodes there are numbers, for they are
  // at least half a spacing apart, which validate() keeps above 2^-41 of the largest coordinate.
  [[nodiscard]] Vec3 at(const Index3& lower, std::size_t axis, double along) const {
    Vec3 position;
    for (std::size_t t = 0; t < 3; ++t) {
      position[t] = grid_.coordinate(t, lower[t]);
    }
    const auto place = static_cast<std::size_t>(lower[axis]);
    position[axis] = within(along, after_[axis][place], before_[axis][place + 1]);
    return position;
  }

  const DualGrid& grid_;
  const Options& options_;
  const PlacementPart& placement_;
  bool is_stretched_;
  Vec3 first_index_{};                         // of local index 0 in the whole grid
  std::array<std::vector<double>, 3> after_;   // the next number above each node's coordinate
  std::array<std::vector<double>, 3> before_;  // and below
};

}  // namespace difmesh::detail
