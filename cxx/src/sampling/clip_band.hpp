#pragma once
// Clipping of small polygons to the band between two grid planes, in grid units: one spacing is 1,
// and grid planes are integers.
//
// What keeps the sums of fractions_from_mesh exact is not precision but agreement. Where an edge
// meets a plane, the point lies on that plane exactly, and whoever clips that edge at that plane,
// for the triangle on its other side or for the band beyond the plane, gets the same point to the
// last bit. So the pieces of a closed mesh are again closed, however the points were rounded.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// A polygon in space, any number of corners up to Capacity.
template <std::size_t Capacity>
struct Polygon {
  std::array<Vec3, Capacity> corners;
  std::size_t size = 0;
};

/// Largest integer <= x, for |x| < 2^62; std::floor is a library call on baseline x86-64.
[[nodiscard]] inline std::int64_t floor_index(double x) noexcept {
  const auto truncated = static_cast<std::int64_t>(x);
  return truncated - static_cast<std::int64_t>(x < static_cast<double>(truncated));
}

/// Unit bands that something from `low` to `high` meets with more than a touch: first..last.
struct BandRange {
  std::int64_t first;
  std::int64_t last;
};

/// What lies flat in a plane belongs to the band above it.
[[nodiscard]] inline BandRange bands(double low, double high) noexcept {
  const std::int64_t first = floor_index(low);
  const std::int64_t top = floor_index(high);
  const bool ends_on_plane = static_cast<double>(top) == high;
  return {first, std::max(first, ends_on_plane ? top - 1 : top)};
}

/// Extent of a polygon along an axis.
struct Extent {
  double low;
  double high;
};

template <std::size_t Axis>
[[nodiscard]] inline Extent extent(const Vec3* corners, std::size_t size) noexcept {
  Extent range{corners[0][Axis], corners[0][Axis]};
  for (std::size_t i = 1; i < size; ++i) {
    range.low = std::min(range.low, corners[i][Axis]);
    range.high = std::max(range.high, corners[i][Axis]);
  }
  return range;
}

/// The point of the edge from `below` to `above` on the plane, below[Axis] < plane < above[Axis].
/// Taking the ends by their height makes both triangles of the edge agree. No coordinate leaves the
/// range of the ends: else rounding could carry a point out of a band to which the edge was clipped
/// before.
template <std::size_t Axis>
[[nodiscard]] inline Vec3 crossing(const Vec3& below, const Vec3& above, double plane) noexcept {
  constexpr std::size_t kB = (Axis + 1) % 3;
  constexpr std::size_t kC = (Axis + 2) % 3;
  const double t = (plane - below[Axis]) / (above[Axis] - below[Axis]);
  const auto between = [t](double low, double high) {
    return std::clamp(low + t * (high - low), std::min(low, high), std::max(low, high));
  };
  Vec3 point;
  point[Axis] = plane;
  point[kB] = between(below[kB], above[kB]);
  point[kC] = between(below[kC], above[kC]);
  return point;
}

/// The part of a polygon in low <= x[Axis] <= high. Signed areas of its projections are right for
/// polygons that are not convex too, as rounding may leave them. At most two corners come from each
/// edge.
template <std::size_t Axis, std::size_t Capacity>
inline void clip_band(const Vec3* corners, std::size_t size, double low, double high,
                      Polygon<Capacity>& out) noexcept {
  std::size_t n = 0;
  const Vec3* from = corners + (size - 1);
  for (const Vec3* to = corners; to != corners + size; from = to++) {
    const double a = (*from)[Axis];
    const double b = (*to)[Axis];
    if (a < low) {
      if (b > low) {
        out.corners[n++] = crossing<Axis>(*from, *to, low);
      }
    } else if (a > high && b < high) {
      out.corners[n++] = crossing<Axis>(*to, *from, high);
    }
    if (b < low) {
      if (a > low) {
        out.corners[n++] = crossing<Axis>(*to, *from, low);
      }
    } else if (b > high) {
      if (a < high) {
        out.corners[n++] = crossing<Axis>(*from, *to, high);
      }
    } else {
      out.corners[n++] = *to;
    }
  }
  out.size = n;
}

/// Twice the signed area of a polygon's projection along x, and six times the signed volume between
/// the polygon and the plane x = top. In one cell all differences are exact or nearly so, and the
/// terms are no larger than the piece.
struct PieceSums {
  double area2 = 0.0;
  double beyond6 = 0.0;
};

[[nodiscard]] inline PieceSums piece_sums(const Vec3* corners, std::size_t size,
                                          double top) noexcept {
  PieceSums sums;
  const Vec3& pivot = corners[0];
  const double pivot_depth = top - pivot[0];
  double y0 = corners[1][1] - pivot[1];
  double z0 = corners[1][2] - pivot[2];
  double depth0 = top - corners[1][0];
  for (std::size_t i = 2; i < size; ++i) {
    const double y1 = corners[i][1] - pivot[1];
    const double z1 = corners[i][2] - pivot[2];
    const double depth1 = top - corners[i][0];
    const double area2 = y0 * z1 - z0 * y1;
    sums.area2 += area2;
    sums.beyond6 += area2 * (pivot_depth + depth0 + depth1);
    y0 = y1;
    z0 = z1;
    depth0 = depth1;
  }
  return sums;
}

}  // namespace difmesh::detail
