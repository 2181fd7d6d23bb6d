#pragma once
// A parabolic patch fitted to points near a vertex by weighted least squares, and its curvatures.

#include <span>
#include <vector>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// A point relative to the vertex, in units of the neighbourhood's size.
struct PatchPoint {
  Vec3 at{0.0, 0.0, 0.0};
  double weight = 0.0;
};

/// Points within about a unit of the vertex with their weights, and the size of the unit.
class PatchPoints {
 public:
  /// \param vertices the vertex itself, then its neighbours
  void assign(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices);
  [[nodiscard]] std::span<const PatchPoint> points() const { return points_; }
  /// The largest difference of coordinates; 0 if all points are one, or not finite if they are.
  [[nodiscard]] double unit() const { return unit_; }

 private:
  std::vector<PatchPoint> points_;
  double unit_ = 0.0;
};

struct PatchFit {
  /// Principal curvatures, as half their sum and half their difference. Positive where the surface
  /// bends away from the normal.
  double mean = 0.0;
  double half_difference = 0.0;
  double height = 0.0;         ///< of the patch over the vertex, along the frame's axis
  Vec3 axis{0.0, 0.0, 0.0};    ///< unit vector, of the last frame
  bool is_determined = false;  ///< by the points; the rest is 0 otherwise
};

/// Fits h = c0 + c1 x + c2 y + c3 x² + c4 xy + c5 y² over the plane across `normal` and turns the
/// normal with the patch until it stays.
/// \param normal unit vector
[[nodiscard]] PatchFit fit_patch(std::span<const PatchPoint> points, const Vec3& normal);

}  // namespace difmesh::detail
