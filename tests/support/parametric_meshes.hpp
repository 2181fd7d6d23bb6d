#pragma once
/// \file parametric_meshes.hpp
/// Triangle meshes whose vertices lie exactly on surfaces in closed form.

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "support/triangle_meshes.hpp"

namespace difmesh::test {

/// Rows and columns of a surface, closed along an axis or not.
struct ParameterGrid {
  std::uint32_t columns = 2;
  std::uint32_t rows = 2;
  bool closed_columns = false;  ///< the last column is followed by the first
  bool closed_rows = false;
};

/// Vertex (i, j) is at place(i, j); triangles run counter-clockwise where i grows to the right and
/// j upwards.
template <class Place>
[[nodiscard]] TriangleMesh parametric_mesh(const ParameterGrid& grid, const Place& place) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j < grid.rows; ++j) {
    for (std::uint32_t i = 0; i < grid.columns; ++i) {
      mesh.positions.push_back(place(i, j));
    }
  }
  for (std::uint32_t j = 0; j + (grid.closed_rows ? 0 : 1) < grid.rows; ++j) {
    for (std::uint32_t i = 0; i + (grid.closed_columns ? 0 : 1) < grid.columns; ++i) {
      const std::uint32_t right = (i + 1) % grid.columns;
      const std::uint32_t up = (j + 1) % grid.rows * grid.columns;
      const std::uint32_t here = j * grid.columns;
      mesh.triangles.push_back({here + i, here + right, up + right});
      mesh.triangles.push_back({here + i, up + right, up + i});
    }
  }
  return mesh;
}

/// Torus about the z axis.
[[nodiscard]] inline TriangleMesh torus_mesh(std::uint32_t around, std::uint32_t about, double ring,
                                             double tube) {
  return parametric_mesh({around, about, true, true}, [&](std::uint32_t i, std::uint32_t j) {
    const double theta = 2.0 * std::numbers::pi * i / around;
    const double phi = 2.0 * std::numbers::pi * j / about;
    const double rho = ring + tube * std::cos(phi);
    return Vec3{rho * std::cos(theta), rho * std::sin(theta), tube * std::sin(phi)};
  });
}

/// Lateral surface of a cylinder about the z axis, open at both ends.
[[nodiscard]] inline TriangleMesh cylinder_mesh(std::uint32_t around, std::uint32_t rows,
                                                double radius, double height) {
  return parametric_mesh({around, rows, true, false}, [&](std::uint32_t i, std::uint32_t j) {
    const double theta = 2.0 * std::numbers::pi * i / around;
    return Vec3{radius * std::cos(theta), radius * std::sin(theta), height * j / (rows - 1)};
  });
}

/// Unit sphere: an octahedron whose edges are halved so many times.
[[nodiscard]] inline TriangleMesh octasphere(int halvings) {
  TriangleMesh mesh{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int round = 0; round < halvings; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
      if (is_new) {
        mesh.positions.push_back(unit(add(mesh.positions[a], mesh.positions[b])));
      }
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

}  // namespace difmesh::test
