#include "curved/plane_section.hpp"

#include <algorithm>

namespace difmesh::detail {

PlaneSection::PlaneSection(const PlaneInSpace& plane, const Vec3& size, int without) {
  // A square that no box of this size reaches beyond, wherever the plane passes it.
  const double far = 4.0 * std::max({size[0], size[1], size[2]}) + 2.0;
  corners_[0] = {{-far, -far}, kNoFace};
  corners_[1] = {{far, -far}, kNoFace};
  corners_[2] = {{far, far}, kNoFace};
  corners_[3] = {{-far, far}, kNoFace};
  count_ = 4;
  for (BoxFace face = 0; face < 6 && count_ > 0; ++face) {
    if (face / 2 != without) {
      cut(plane, size, face);
    }
  }
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
