#pragma once
// The dual grid of a block: its nodes, where they lie, and which cell each stands for.

#include <array>
#include <vector>

#include "grid/block_field.hpp"
#include "grid/node_bits.hpp"
#include "planes/unit_plane.hpp"
#include "surface/plane_table.hpp"

namespace difmesh::detail {

/// What a node stands for.
struct NodeOrigin {
  Index3 cell{0, 0, 0};              ///< local index of the cell; meaningless where constant
  std::array<int, 3> face{0, 0, 0};  ///< -1, 1: the node lies on that open domain face of the cell
  bool constant = false;             ///< beyond an `empty` or `full` side
  [[nodiscard]] bool on_face() const { return face[0] != 0 || face[1] != 0 || face[2] != 0; }
};

class DualGrid {
 public:
  DualGrid(const BlockField& field, NodeBits nodes);

  /// Takes the outermost cells' planes; with `extend`, nodes on open domain faces are inside where
  /// the plane of their cell says so, which lets the surface run on to the face.
  void set_planes(PlaneTable planes, bool extend);

  /// Puts a node on a side.
  void settle(const Index3& node, bool inside) { nodes_.set(node, inside); }

  [[nodiscard]] const BlockField& field() const { return *field_; }
  [[nodiscard]] const NodeBits& nodes() const { return nodes_; }
  [[nodiscard]] const PlaneTable& planes() const { return planes_; }

  [[nodiscard]] NodeOrigin origin(const Index3& node) const;
  [[nodiscard]] double coordinate(std::size_t axis, std::int64_t local) const {
    return coordinates_[axis][static_cast<std::size_t>(local)];
  }
  /// Fraction of the node for the decision on ambiguous faces; >= 1/2 where the node is inside, but
  /// for rounding.
  [[nodiscard]] double node_fraction(const Index3& node) const;
  /// Fraction of the cell that the node stands for.
  [[nodiscard]] double cell_fraction(const Index3& node, const NodeOrigin& origin) const;
  /// Plane of the cell itself, an outermost one, or a pure one where it has none. Which cells that
  /// are as good as pure have one depends on the block: it does not see the edges that leave it at
  /// its low sides.
  [[nodiscard]] UnitPlane cell_plane(const Index3& node, const NodeOrigin& origin) const;
  /// Whether the cell that the node stands for is inside, or what lies beyond the side.
  [[nodiscard]] bool is_cell_inside(const Index3& node, const NodeOrigin& origin) const {
    return nodes_.test(origin.constant ? node : origin.cell);
  }
  /// True where the plane of the node's cell decides on which side the node is.
  [[nodiscard]] bool is_extended(const Index3& node, const NodeOrigin& origin) const;

 private:
  void settle_around(const Index3& cell);
  [[nodiscard]] bool has_crossed_edge(const Index3& cell) const;

  const BlockField* field_;
  NodeBits nodes_;
  PlaneTable planes_;
  std::array<std::vector<double>, 3> coordinates_;
  bool extend_ = false;
};

/// The plane's trace on the domain faces that the node lies on: a plane parallel to these faces'
/// normals that agrees with it on the faces. Says on which side of the plane the node is:
/// is_centre_inside().
///
/// Let one node lie on one face more than another, f = 1 or -1 along an axis. The offset of its
/// trace is the other's less f m / 2, m of that axis. Rounding is monotone, so if the first is
/// inside and the second outside, f m > 0, and f m < 0 if it is the other way round: where the two
/// nodes are on different sides, m is not 0.
[[nodiscard]] UnitPlane trace(const UnitPlane& plane, const std::array<int, 3>& face);

}  // namespace difmesh::detail
