#pragma once
/// \file convex_body.hpp
/// Volumes of convex bodies cut by axis-aligned planes, in long double.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/triangle_meshes.hpp"

namespace difmesh::test {

/// A convex body as the polygons of its faces, cut by axis-aligned planes: an oracle that shares
/// nothing with the divergence theorem.
class ConvexBody {
 public:
  using Real = long double;
  using Point = std::array<Real, 3>;

  explicit ConvexBody(const TriangleMesh& mesh) {
    for (const Triangle& t : mesh.triangles) {
      std::vector<Point> face;
      for (const std::uint32_t v : t) {
        const Vec3& p = mesh.positions[v];
        face.push_back({p[0], p[1], p[2]});
      }
      faces_.push_back(face);
    }
  }

  /// Keeps the part where sense * (x[axis] - level) <= 0.
  void cut(std::size_t axis, Real level, Real sense) {
    std::vector<std::vector<Point>> kept;
    std::vector<Point> cap;
    for (const auto& face : faces_) {
      std::vector<Point> polygon;
      bool in_plane = true;
      for (std::size_t i = 0; i < face.size(); ++i) {
        const Point& a = face[i];
        const Point& b = face[(i + 1) % face.size()];
        const Real da = sense * (a[axis] - level);
        const Real db = sense * (b[axis] - level);
        in_plane = in_plane && da == 0;
        if (da <= 0) {
          polygon.push_back(a);
        }
        if (da == 0) {
          cap.push_back(a);
        }
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
          Point p = a;
          for (std::size_t c = 0; c < 3; ++c) {
            p[c] += da / (da - db) * (b[c] - a[c]);
          }
          p[axis] = level;
          polygon.push_back(p);
          cap.push_back(p);
        }
      }
      // The cap takes the place of a face in the plane.
      if (polygon.size() >= 3 && !in_plane) {
        kept.push_back(polygon);
      }
    }
    faces_ = std::move(kept);
    add_cap(axis, cap);
  }

  [[nodiscard]] Real volume() const {
    if (faces_.size() < 4) {
      return 0;
    }
    // Tetrahedra over the faces with their apex inside: no cancelling.
    const Point apex = middle_of_all();
    Real sum = 0;
    for (const auto& face : faces_) {
      for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        const Point u = from(apex, face[0]);
        const Point v = from(apex, face[i]);
        const Point w = from(apex, face[i + 1]);
        sum += std::abs(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                        u[2] * (v[0] * w[1] - v[1] * w[0]));
      }
    }
    return sum / 6;
  }

 private:
  static Point from(const Point& a, const Point& b) {
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }

  static Point middle(const std::vector<Point>& points) {
    Point sum{0, 0, 0};
    for (const Point& p : points) {
      for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += p[c] / static_cast<Real>(points.size());
      }
    }
    return sum;
  }

  [[nodiscard]] Point middle_of_all() const {
    std::vector<Point> all;
    for (const auto& face : faces_) {
      all.insert(all.end(), face.begin(), face.end());
    }
    return middle(all);
  }

  void add_cap(std::size_t axis, std::vector<Point> cap) {
    if (cap.size() < 3) {
      return;
    }
    const Point centre = middle(cap);
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::sort(cap.begin(), cap.end(), [&](const Point& a, const Point& b) {
      return std::atan2(a[v] - centre[v], a[u] - centre[u]) <
             std::atan2(b[v] - centre[v], b[u] - centre[u]);
    });
    faces_.push_back(cap);
  }

  std::vector<std::vector<Point>> faces_;
};

}  // namespace difmesh::test
