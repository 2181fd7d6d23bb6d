#pragma once
/// \file surfaces.hpp
/// Meshes for the tests of distances, and distances from them by other means than the library's.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/metrics/distance.hpp"
#include "support/triangle_meshes.hpp"
#include "support/vec3.hpp"

namespace difmesh::test {

inline Distance distance_of(const TriangleMesh& mesh, const SignedDistance& shape,
                            const DistanceOptions& options = {}) {
  return distance(mesh.positions, mesh.triangles, shape, options);
}
inline Distance distance_of(const TriangleMesh& mesh, const Shape& shape,
                            const DistanceOptions& options = {}) {
  return distance(mesh.positions, mesh.triangles, shape, options);
}
inline MeshDistance distance_of(const TriangleMesh& mesh, const TriangleMesh& reference,
                                const DistanceOptions& options = {}) {
  return distance(mesh.positions, mesh.triangles, reference.positions, reference.triangles,
                  options);
}

inline Vec3 product(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A regular icosahedron with corners on the unit sphere, outward.
inline TriangleMesh icosahedron() {
  const double phi = std::numbers::phi;
  TriangleMesh mesh;
  for (const double one : {-1.0, 1.0}) {
    for (const double golden : {-phi, phi}) {
      mesh.positions.push_back(unit({0.0, one, golden}));
      mesh.positions.push_back(unit({one, golden, 0.0}));
      mesh.positions.push_back(unit({golden, 0.0, one}));
    }
  }
  // Its triangles are the triples of corners that are one edge apart.
  const double edge = 1.1 / std::sin(0.4 * std::numbers::pi);
  const auto close = [&](std::uint32_t a, std::uint32_t b) {
    return length(subtract(mesh.positions[a], mesh.positions[b])) < edge;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (close(a, b) && close(b, c) && close(c, a)) {
          const Vec3 normal = product(subtract(mesh.positions[b], mesh.positions[a]),
                                      subtract(mesh.positions[c], mesh.positions[a]));
          const bool outward = dot(normal, mesh.positions[a]) > 0.0;
          mesh.triangles.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
        }
      }
    }
  }
  return mesh;
}

/// The icosahedron with every triangle cut into four, `levels` times, vertices on the unit sphere.
inline TriangleMesh icosphere(int levels) {
  TriangleMesh mesh = icosahedron();
  for (; levels > 0; --levels) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
      if (is_new) {
        mesh.positions.push_back(unit(add(mesh.positions[a], mesh.positions[b])));
      }
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// A rotation about an axis, then a shift.
struct Motion {
  Vec3 axis{0, 0, 1};  ///< unit vector
  double angle = 0.0;
  Vec3 shift{0, 0, 0};

  [[nodiscard]] Vec3 rotated(const Vec3& p, double by) const {
    const Vec3 across = product(axis, p);
    return add(add(scaled(p, std::cos(by)), scaled(across, std::sin(by))),
               scaled(axis, dot(axis, p) * (1.0 - std::cos(by))));
  }
  [[nodiscard]] Vec3 forth(const Vec3& p) const { return add(rotated(p, angle), shift); }
  [[nodiscard]] Vec3 back(const Vec3& p) const { return rotated(subtract(p, shift), -angle); }
  [[nodiscard]] TriangleMesh forth(TriangleMesh mesh) const {
    for (Vec3& p : mesh.positions) {
      p = forth(p);
    }
    return mesh;
  }
};

/// Signed distance from the surface of the box [-h, h].
inline double box_distance(const Vec3& p, const Vec3& h) {
  const Vec3 over{std::abs(p[0]) - h[0], std::abs(p[1]) - h[1], std::abs(p[2]) - h[2]};
  const double inside = std::max({over[0], over[1], over[2]});
  if (inside <= 0.0) {
    return inside;
  }
  return length({std::max(over[0], 0.0), std::max(over[1], 0.0), std::max(over[2], 0.0)});
}

/// The points of a triangle seen from some point, in long double. It knows no normal: the triangle
/// is made of the segments between the points at the same share of the way from one corner to the
/// two others.
class SeenTriangle {
 public:
  using Real = long double;
  using Real3 = std::array<Real, 3>;

  SeenTriangle(const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c)
      : a_(way(from, a)), b_(way(from, b)), c_(way(from, c)) {}

  /// Some point of the triangle is no further than this.
  [[nodiscard]] Real upper_bound() const { return std::min({size(a_), size(b_), size(c_)}); }
  /// No point of the triangle is closer than this.
  [[nodiscard]] Real lower_bound() const {
    return size(a_) - std::max(size(combined(a_, -1, b_)), size(combined(a_, -1, c_)));
  }
  /// Least distance: along each segment by its formula, over the segments by search, as the
  /// distance is convex.
  [[nodiscard]] Real distance() const {
    Real low = 0;
    Real high = 1;
    for (int round = 0; round < 120; ++round) {
      const Real third = (high - low) / 3;
      const bool rising = at(low + third) < at(high - third);
      (rising ? high : low) = rising ? high - third : low + third;
    }
    return std::min({at(low), at(high), at(0), at(1)});
  }

 private:
  static Real3 way(const Vec3& from, const Vec3& to) {
    return {Real{to[0]} - Real{from[0]}, Real{to[1]} - Real{from[1]}, Real{to[2]} - Real{from[2]}};
  }
  static Real inner(const Real3& a, const Real3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Real size(const Real3& a) { return std::sqrt(inner(a, a)); }
  static Real3 combined(const Real3& a, Real factor, const Real3& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
  }
  /// Distance from the segment at share s of the way from a.
  [[nodiscard]] Real at(Real s) const {
    const Real3 p = combined(a_, s, combined(b_, -1, a_));
    const Real3 q = combined(a_, s, combined(c_, -1, a_));
    const Real3 across = combined(q, -1, p);
    const Real whole = inner(across, across);
    const Real t = whole > 0 ? std::clamp<Real>(-inner(p, across) / whole, 0, 1) : 0;
    return size(combined(p, t, across));
  }

  Real3 a_;
  Real3 b_;
  Real3 c_;
};

/// Distance from the nearest of all triangles, one by one.
inline double brute_force_distance(const Vec3& point, const TriangleMesh& mesh) {
  const auto seen = [&](const Triangle& t) {
    return SeenTriangle(point, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
  };
  long double best = std::numeric_limits<long double>::infinity();
  for (const Triangle& t : mesh.triangles) {
    best = std::min(best, seen(t).upper_bound());
  }
  for (const Triangle& t : mesh.triangles) {
    const SeenTriangle triangle = seen(t);
    if (triangle.lower_bound() < best) {
      best = std::min(best, triangle.distance());
    }
  }
  return static_cast<double>(best);
}

/// Statistics of distances that count one each, summed in long double.
inline DistanceStatistics statistics_of(const std::vector<double>& distances) {
  DistanceStatistics result;
  long double sum = 0.0L;
  long double sizes = 0.0L;
  long double squares = 0.0L;
  result.points = static_cast<std::int64_t>(distances.size());
  result.lowest = result.highest = distances[0];
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double d = distances[i];
    sum += d;
    sizes += std::abs(d);
    squares += static_cast<long double>(d) * d;
    result.lowest = std::min(result.lowest, d);
    result.highest = std::max(result.highest, d);
    if (std::abs(d) > result.maximum) {
      result.maximum = std::abs(d);
      result.maximum_index = static_cast<std::int64_t>(i);
    }
  }
  const auto n = static_cast<long double>(distances.size());
  result.rms = static_cast<double>(std::sqrt(squares / n));
  result.mean = static_cast<double>(sizes / n);
  result.signed_mean = static_cast<double>(sum / n);
  return result;
}

/// The largest difference between the figures of two sets of statistics.
inline double difference(const DistanceStatistics& a, const DistanceStatistics& b) {
  return std::max({std::abs(a.rms - b.rms), std::abs(a.mean - b.mean),
                   std::abs(a.signed_mean - b.signed_mean), std::abs(a.lowest - b.lowest),
                   std::abs(a.highest - b.highest), std::abs(a.maximum - b.maximum)});
}

/// Points as a mesh: every three are a triangle. What is left at the end is left out.
inline TriangleMesh as_mesh(std::vector<Vec3> points) {
  points.resize(points.size() / 3 * 3);
  TriangleMesh mesh{std::move(points), {}};
  for (std::uint32_t v = 0; v + 2 < mesh.positions.size(); v += 3) {
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  return mesh;
}

}  // namespace difmesh::test
