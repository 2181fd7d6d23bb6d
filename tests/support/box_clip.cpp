#include "support/box_clip.hpp"

#include <algorithm>
#include <cstddef>

namespace difmesh::test {
namespace {

using Real = long double;
using Point = std::array<Real, 3>;

/// The unit cube [-½,½]³ and the signed distance m·x - alpha, up to a factor, at any of its points.
struct CutCube {
  Point m;
  Real alpha;
  [[nodiscard]] Real beyond(const Point& x) const {
    return m[0] * x[0] + m[1] * x[1] + m[2] * x[2] - alpha;
  }
};

/// A face of the cube or what clipping leaves of it.
struct Polygon {
  std::array<Point, 6> points{};
  std::size_t size = 0;
  void push(const Point& p) { points[size++] = p; }
};

Polygon cube_face(std::size_t axis, Real side) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  constexpr std::array<std::array<Real, 2>, 4> kCorners{
      {{-0.5L, -0.5L}, {0.5L, -0.5L}, {0.5L, 0.5L}, {-0.5L, 0.5L}}};
  Polygon face;
  for (const auto& corner : kCorners) {
    Point p{};
    p[axis] = side;
    p[u] = corner[0];
    p[v] = corner[1];
    face.push(p);
  }
  return face;
}

Point crossing(const CutCube& cube, const Point& a, const Point& b) {
  const Real da = cube.beyond(a);
  const Real db = cube.beyond(b);
  const Real t = da / (da - db);
  Point p{};
  for (std::size_t c = 0; c < 3; ++c) {
    p[c] = a[c] == b[c] ? a[c] : a[c] + t * (b[c] - a[c]);
  }
  return p;
}

Polygon clip(const CutCube& cube, const Polygon& polygon) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Point& a = polygon.points[i];
    const Point& b = polygon.points[(i + 1) % polygon.size];
    const bool a_in = cube.beyond(a) <= 0.0L;
    if (a_in) {
      kept.push(a);
    }
    if (a_in != (cube.beyond(b) <= 0.0L)) {
      kept.push(crossing(cube, a, b));
    }
  }
  return kept;
}

/// Area of a convex polygon in a plane across the axis.
Real area(const Polygon& polygon, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const Point& o = polygon.points[0];
  Real twice = 0.0L;
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    const Point& a = polygon.points[i];
    const Point& b = polygon.points[i + 1];
    twice += (a[u] - o[u]) * (b[v] - o[v]) - (a[v] - o[v]) * (b[u] - o[u]);
  }
  return 0.5L * std::abs(twice);
}

/// A point where the plane meets an edge of the cube. \pre the corners lie on both sides.
Point point_of_cut(const CutCube& cube) {
  for (const Real side : {-0.5L, 0.5L}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Polygon face = cube_face(axis, side);
      for (std::size_t i = 0; i < 4; ++i) {
        const Point& a = face.points[i];
        const Point& b = face.points[(i + 1) % 4];
        if ((cube.beyond(a) <= 0.0L) != (cube.beyond(b) <= 0.0L)) {
          return crossing(cube, a, b);
        }
      }
    }
  }
  return {};
}

/// Volume by pyramids over the clipped faces with their apex on the plane, where the cut itself
/// adds nothing; the apex lies in the cube, so all of them are positive and nothing cancels.
Real cube_share(const CutCube& cube) {
  const Real reach = 0.5L * (std::abs(cube.m[0]) + std::abs(cube.m[1]) + std::abs(cube.m[2]));
  if (cube.alpha >= reach) {
    return 1.0L;
  }
  if (cube.alpha < -reach) {
    return 0.0L;
  }
  const Point apex = point_of_cut(cube);
  Real volume = 0.0L;
  for (const Real side : {-0.5L, 0.5L}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Polygon face = clip(cube, cube_face(axis, side));
      if (face.size >= 3) {
        volume += std::abs(side - apex[axis]) * area(face, axis) / 3.0L;
      }
    }
  }
  return std::clamp(volume, 0.0L, 1.0L);
}

}  // namespace

long double clipped_share(const Box& box, const Vec3& normal, double level) {
  CutCube cube{{}, level};
  for (std::size_t a = 0; a < 3; ++a) {
    const Real low = box.low[a];
    const Real high = box.high[a];
    if (!(high > low)) {
      return 0.0L;
    }
    cube.m[a] = normal[a] * (high - low);
    cube.alpha -= normal[a] * (0.5L * (low + high));
  }
  return cube_share(cube);
}

long double clipped_share(const Vec3& spacing, const Vec3& normal, double offset) {
  CutCube cube{{}, offset};
  for (std::size_t a = 0; a < 3; ++a) {
    cube.m[a] = static_cast<Real>(normal[a]) * spacing[a];
  }
  return cube_share(cube);
}

}  // namespace difmesh::test
