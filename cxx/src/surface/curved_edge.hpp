#pragma once
// The vertex of a dual edge whose cells own curved surfaces.

#include "curved/surface_table.hpp"
#include "surface/dual_grid.hpp"
#include "surface/node_place.hpp"
#include "surface/vertex_placer.hpp"

namespace difmesh::detail {

/// A dual edge between two nodes, and what their cells own.
class CurvedEdge {
 public:
  CurvedEdge(const SurfaceTable& table, const DualGrid& grid, const DualEdge& edge);

  /// The vertex's share of the way from the lower node to the upper one; false where the window has
  /// the say.
  /// \param window where the window puts it
  [[nodiscard]] bool place(double window, double& share) const;
  /// The unit normal there. \pre place() returned true
  [[nodiscard]] Vec3 normal(double share) const;

 private:
  struct End {
    Ownership ownership = Ownership::pure;
    OwnedSurface surface;
    Vec3 node{0.0, 0.0, 0.0};  ///< from the cell's centre, in the grid's unit
    double length = 1.0;       ///< the unit of the surface
    bool inside = false;

    [[nodiscard]] bool owns() const { return ownership == Ownership::owned; }
  };

  [[nodiscard]] static End end_at(const SurfaceTable& table, const NodePlace& place, bool inside);
  [[nodiscard]] bool contradicts(const End& end) const;
  [[nodiscard]] Vec3 seen_from(const End& end, double along) const;
  [[nodiscard]] double at(double share) const;
  [[nodiscard]] double function_of(const End& end, double along) const;
  [[nodiscard]] double upper_weight(double share) const;
  [[nodiscard]] double root(double low, double high) const;

  std::size_t axis_;
  double extent_;  // of the edge
  End lower_;
  End upper_;
};

}  // namespace difmesh::detail
