#include "curved/plane_section.hpp"

#include <cmath>

namespace difmesh::detail {

namespace {

// That the plane's normal is most nearly along.
std::size_t main_axis(const PlaneInSpace& plane) {
  const Vec3 normal = cross(plane.along_s, plane.along_t);
  std::size_t axis = 0;
  for (std::size_t other = 1; other < 3; ++other) {
    axis = std::abs(normal[other]) > std::abs(normal[axis]) ? other : axis;
  }
  return axis;
}

}  // namespace

PlaneSection PlaneSection::of_box(const PlaneInSpace& plane, const Vec3& size) {
  const std::size_t axis = main_axis(plane);
  PlaneSection section(plane, size, axis);
  section.cut(plane, size, static_cast<BoxFace>(2 * axis));
  section.cut(plane, size, static_cast<BoxFace>(2 * axis + 1));
  return section;
}

// The corners are where the plane meets the four edges along the axis, or their continuations.
PlaneSection::PlaneSection(const PlaneInSpace& plane, const Vec3& size, std::size_t axis)
    : count_(4) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const double determinant =
      plane.along_s[u] * plane.along_t[v] - plane.along_t[u] * plane.along_s[v];
  const double inverse = 1.0 / determinant;
  const auto corner = [&](double at_u, double at_v) {
    const double by_u = at_u * size[u] - plane.point[u];
    const double by_v = at_v * size[v] - plane.point[v];
    return PlanePoint{(by_u * plane.along_t[v] - by_v * plane.along_t[u]) * inverse,
                      (by_v * plane.along_s[u] - by_u * plane.along_s[v]) * inverse};
  };
  const auto face = [](std::size_t of, int high) { return static_cast<BoxFace>(of) * 2 + high; };
  const bool turns = determinant > 0.0;  // counter-clockwise from u to v
  corners_[0] = {corner(-0.5, -0.5), turns ? face(v, 0) : face(u, 0)};
  corners_[1] = {turns ? corner(0.5, -0.5) : corner(-0.5, 0.5), turns ? face(u, 1) : face(v, 1)};
  corners_[2] = {corner(0.5, 0.5), turns ? face(v, 1) : face(u, 1)};
  corners_[3] = {turns ? corner(-0.5, 0.5) : corner(0.5, -0.5), turns ? face(u, 0) : face(v, 0)};
}

// Keeps what lies within the face (Sutherland and Hodgman).
void PlaneSection::cut(const PlaneInSpace& plane, const Vec3& size, BoxFace face) {
  const std::size_t axis = axis_of(face);
  const double sense = sense_of(face);
  std::array<double, kMostCorners> beyond;
  bool is_cut = false;
  for (std::size_t n = 0; n < count_; ++n) {
    const PlanePoint& at = corners_[n].at;
    beyond[n] =
        sense * (plane.point[axis] + plane.along_s[axis] * at.s + plane.along_t[axis] * at.t) -
        0.5 * size[axis];
    is_cut = is_cut || beyond[n] > 0.0;
  }
  if (!is_cut) {
    return;
  }
  std::array<Corner, kMostCorners> kept;
  std::size_t count = 0;
  for (std::size_t n = 0; n < count_; ++n) {
    const std::size_t next = n + 1 < count_ ? n + 1 : 0;
    const bool is_in = beyond[n] <= 0.0;
    if (is_in && count < kMostCorners) {
      kept[count++] = corners_[n];
    }
    if (is_in != (beyond[next] <= 0.0) && count < kMostCorners) {
      const PlanePoint& from = corners_[n].at;
      const PlanePoint& to = corners_[next].at;
      const double share = beyond[n] / (beyond[n] - beyond[next]);
      kept[count++] = {{from.s + share * (to.s - from.s), from.t + share * (to.t - from.t)},
                       is_in ? face : corners_[n].face};
    }
  }
  corners_ = kept;
  count_ = count;
}

}  // namespace difmesh::detail
