#pragma once
// The polygon in which a plane meets a box, with the faces of the box that its edges lie on.

#include <array>
#include <cstddef>

#include "base/vector3.hpp"

namespace difmesh::detail {

/// Two coordinates in a plane.
struct PlanePoint {
  double s;
  double t;
};

/// A plane in space, point + s along_s + t along_t, seen from the centre of a box.
struct PlaneInSpace {
  Vec3 point;
  Vec3 along_s;
  Vec3 along_t;
};

/// A face of a box: 2 axis, plus 1 at the upper end.
using BoxFace = int;
[[nodiscard]] constexpr std::size_t axis_of(BoxFace face) {
  return static_cast<std::size_t>(face / 2);
}
[[nodiscard]] constexpr double sense_of(BoxFace face) {
  return face % 2 == 0 ? -1.0 : 1.0;
}

/// A convex polygon, counter-clockwise in (s, t).
class PlaneSection {
 public:
  static constexpr std::size_t kMostCorners = 8;

  struct Edge {
    PlanePoint from;
    PlanePoint to;
    BoxFace face;
  };

  /// Within all faces of the box.
  [[nodiscard]] static PlaneSection of_box(const PlaneInSpace& plane, const Vec3& size);
  /// Within the four faces across the other two axes. \pre the plane is not parallel to the axis
  PlaneSection(const PlaneInSpace& plane, const Vec3& size, std::size_t axis);

  [[nodiscard]] std::size_t corners() const { return count_; }
  [[nodiscard]] Edge edge(std::size_t n) const {
    return {corners_[n].at, corners_[n + 1 < count_ ? n + 1 : 0].at, corners_[n].face};
  }

 private:
  struct Corner {
    PlanePoint at;
    BoxFace face;  ///< of the edge to the next corner
  };

  void cut(const PlaneInSpace& plane, const Vec3& size, BoxFace face);

  std::array<Corner, kMostCorners> corners_;
  std::size_t count_ = 0;
};

}  // namespace difmesh::detail
