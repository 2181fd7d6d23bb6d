#pragma once
// What is found out once about a mesh, so that testing its cells for sheets is quick.

#include <array>
#include <cstdint>
#include <span>

#include "base/parallel.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

struct SheetFacts {
  /// Directions of the triangles' normals, of length 2^20; 0 where there is none. They are
  /// integers, so their sums do not depend on their order.
  Array<std::array<std::int32_t, 3>> normals;
  /// 1 for vertices whose triangles go round them once, by edges, with all their normals in one
  /// half-space: seen along its direction, these triangles lie side by side. Vertices are told
  /// apart by index.
  Array<std::uint8_t> ordinary;
};

/// \param corners in grid units
[[nodiscard]] SheetFacts sheet_facts(std::span<const Vec3> corners,
                                     std::span<const Triangle> triangles, Workers& workers);

/// Measures angles in the plane across a direction.
class AngleGauge {
 public:
  explicit AngleGauge(const Vec3& direction);

  /// Of the wedge at `apex` from one point to the next, seen against the direction; 4 all round.
  /// Grows with the angle, and adds up where wedges do.
  [[nodiscard]] double quarters(const Vec3& apex, const Vec3& from, const Vec3& to) const;

 private:
  Vec3 u_;
  Vec3 v_;
};

}  // namespace difmesh::detail
