#pragma once
// A triangle mesh to be measured, checked, with the scale at which squares neither overflow nor
// vanish.

#include <cstdint>
#include <span>

#include "base/vector3.hpp"
#include "closest_point.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

struct Box {
  Vec3 low{0, 0, 0};
  Vec3 high{0, 0, 0};
};

/// \pre not empty
[[nodiscard]] Box box_of(std::span<const Vec3> positions) noexcept;

/// A power of two that brings the longest side of what encloses both boxes into [2, 4), as far as
/// float64 allows. Scaling by it and back is exact.
[[nodiscard]] double scale_of(const Box& a, const Box& b) noexcept;

struct SurfaceView {
  const char* name = "mesh";  ///< tells it from others in messages
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
  double scale = 1.0;

  /// Corners of a triangle relative to a point, both in scaled units.
  [[nodiscard]] Corners corners(std::size_t triangle, const Vec3& point) const noexcept {
    const auto [a, b, c] = triangles[triangle];
    return {minus(scaled(positions[a], scale), point), minus(scaled(positions[b], scale), point),
            minus(scaled(positions[c], scale), point)};
  }
};

/// Throws Error invalid_argument unless there are triangles, indices are in range and positions
/// finite.
void check_surface(const SurfaceView& surface);

}  // namespace difmesh::detail
