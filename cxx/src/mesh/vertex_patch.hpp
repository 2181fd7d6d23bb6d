#pragma once
// Parabolic patches at the vertices of a mesh.

#include <cstdint>
#include <span>

#include "difmesh/mesh.hpp"
#include "mesh/quadric_patch.hpp"
#include "mesh/ring_walk.hpp"
#include "mesh/vertex_neighbours.hpp"

namespace difmesh::detail {

/// What patches are fitted to. All must outlive the fits.
struct PatchSurface {
  std::span<const Vec3> positions;
  const Array<Vec3>& areas;
  const VertexNeighbours& neighbours;
  int rings = 2;
};

/// Fits patches to the rings of one vertex after the other; adds rings where they do not do. One
/// per thread.
class VertexPatch {
 public:
  explicit VertexPatch(const PatchSurface& surface)
      : surface_(surface), walk_(surface.neighbours) {}

  /// In the unit of the positions. What is determined is finite.
  PatchFit operator()(std::uint32_t vertex);
  /// Whether the last vertex needed more rings.
  [[nodiscard]] bool is_widened() const { return is_widened_; }

 private:
  PatchFit fit(const Vec3& normal);

  const PatchSurface& surface_;
  RingWalk walk_;
  PatchPoints points_;
  bool is_widened_ = false;
};

}  // namespace difmesh::detail
