#pragma once
// The point of a segment or triangle that is closest to the origin.

#include <array>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// The corners of a triangle as seen from some point: relative to it.
using Corners = std::array<Vec3, 3>;

/// The point of the segment from a to b closest to the origin; an end, where it is one, to the last
/// bit. a = b is a point.
[[nodiscard]] Vec3 closest_on_segment(const Vec3& a, const Vec3& b) noexcept;

/// The point of a triangle closest to the origin. Any triangle will do: without area it is the
/// longest of its edges. What comes back lies on the triangle within rounding, so distances are
/// never too small.
[[nodiscard]] Vec3 closest_on_triangle(const Corners& corners) noexcept;

}  // namespace difmesh::detail
