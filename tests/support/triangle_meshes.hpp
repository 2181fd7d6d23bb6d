#pragma once
/// \file triangle_meshes.hpp
/// Closed triangle meshes for tests: boxes, tetrahedra, and files.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/mesh.hpp"
#include "support/vec3.hpp"

namespace difmesh::test {

struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;

  void append(const TriangleMesh& other) {
    const auto shift = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    for (const Triangle& t : other.triangles) {
      triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    }
  }
  /// The same surface seen from the other side.
  [[nodiscard]] TriangleMesh reversed() const {
    TriangleMesh mesh = *this;
    for (Triangle& t : mesh.triangles) {
      std::swap(t[1], t[2]);
    }
    return mesh;
  }
};

/// Low and high corner of the box round all vertices.
[[nodiscard]] inline std::pair<Vec3, Vec3> corners_of_box_round(const TriangleMesh& mesh) {
  Vec3 low = mesh.positions[0];
  Vec3 high = low;
  for (const Vec3& p : mesh.positions) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  }
  return {low, high};
}

/// Twelve triangles, outward. Vertex b has the high x where bit 0 of b is set, y: bit 1, z: bit 2.
[[nodiscard]] inline TriangleMesh box_mesh(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (unsigned bits = 0; bits < 8; ++bits) {
    mesh.positions.push_back({(bits & 1U) != 0 ? high[0] : low[0],
                              (bits & 2U) != 0 ? high[1] : low[1],
                              (bits & 4U) != 0 ? high[2] : low[2]});
  }
  const std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : sides) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

/// Four triangles, outward whatever the order of the corners.
[[nodiscard]] inline TriangleMesh tetrahedron_mesh(const std::array<Vec3, 4>& corners) {
  TriangleMesh mesh{{corners.begin(), corners.end()}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  const Vec3 u = subtract(corners[1], corners[0]);
  const Vec3 v = subtract(corners[2], corners[0]);
  const Vec3 w = subtract(corners[3], corners[0]);
  const Vec3 normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
  return dot(normal, w) < 0.0 ? mesh.reversed() : mesh;
}

/// Reads the triangles of an OFF file; none where the file is absent.
[[nodiscard]] inline std::optional<TriangleMesh> read_off(const std::string& path) {
  std::ifstream file(path);
  std::string head;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  if (!(file >> head >> vertices >> faces >> edges)) {
    return std::nullopt;
  }
  TriangleMesh mesh;
  mesh.positions.resize(vertices);
  mesh.triangles.resize(faces);
  for (Vec3& p : mesh.positions) {
    file >> p[0] >> p[1] >> p[2];
  }
  for (Triangle& t : mesh.triangles) {
    std::size_t corners = 0;
    file >> corners >> t[0] >> t[1] >> t[2];
    if (corners != 3) {
      return std::nullopt;
    }
  }
  return file ? std::optional(std::move(mesh)) : std::nullopt;
}

}  // namespace difmesh::test
