#include "roughness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace difmesh::cli {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

struct Side {
  Edge edge;  ///< smaller vertex first
  std::size_t triangle = 0;
};

Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Vec3& v) {
  return std::hypot(v[0], v[1], v[2]);
}

/// Unit normal, or 0. The sides are scaled first: areas of tiny triangles would underflow.
Vec3 normal_of(const Mesh& mesh, const Triangle& t) {
  Vec3 u = minus(mesh.positions[t[1]], mesh.positions[t[0]]);
  Vec3 v = minus(mesh.positions[t[2]], mesh.positions[t[0]]);
  for (Vec3* const side : {&u, &v}) {
    const double size = length(*side);
    for (double& component : *side) {
      component /= size > 0.0 ? size : 1.0;
    }
  }
  Vec3 normal = cross(u, v);
  const double size = length(normal);
  for (double& component : normal) {
    component /= size > 0.0 ? size : 1.0;
  }
  return normal;
}

std::vector<Side> sorted_sides(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      sides.push_back({std::minmax({t[corner], t[(corner + 1) % 3]}), i});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  return sides;
}

/// Calls visit(edge, angle) for every edge with two triangles that have a normal; radians.
template <class Visit>
void for_edge_angles(const Mesh& mesh, const Visit& visit) {
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].edge == sides[i].edge) {
      ++end;
    }
    if (end - i == 2) {
      const Vec3 a = normal_of(mesh, mesh.triangles[sides[i].triangle]);
      const Vec3 b = normal_of(mesh, mesh.triangles[sides[i + 1].triangle]);
      if (dot(a, a) > 0.0 && dot(b, b) > 0.0) {
        // Not acos(): it has no digits left where the angle is small.
        visit(sides[i].edge, std::atan2(length(cross(a, b)), dot(a, b)));
      }
    }
    i = end;
  }
}

}  // namespace

std::optional<double> roughness_degrees(const Mesh& mesh) {
  double sum = 0.0;
  std::int64_t edges = 0;
  for_edge_angles(mesh, [&](const Edge&, double angle) {
    sum += angle * angle;
    ++edges;
  });
  if (edges == 0) {
    return std::nullopt;
  }
  return std::sqrt(sum / static_cast<double>(edges)) * 180.0 / std::numbers::pi;
}

Array<double> largest_angles(const Mesh& mesh) {
  Array<double> angles(mesh.positions.size(), 0.0);
  for_edge_angles(mesh, [&](const Edge& edge, double angle) {
    for (const std::uint32_t v : {edge.first, edge.second}) {
      angles[v] = std::max(angles[v], angle * 180.0 / std::numbers::pi);
    }
  });
  return angles;
}

}  // namespace difmesh::cli
