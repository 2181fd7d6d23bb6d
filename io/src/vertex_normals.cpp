#include "vertex_normals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace difmesh::detail {
namespace {

double extent_of(const Mesh& mesh) {
  double largest = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double a = mesh.positions[t[0]][axis];
      largest = std::max({largest, std::abs(mesh.positions[t[1]][axis] - a),
                          std::abs(mesh.positions[t[2]][axis] - a)});
    }
  }
  return largest;
}

void add_area_vectors(const Mesh& mesh, Array<Vec3>& sums) {
  // In units of the longest side: squares of small lengths would underflow.
  const double extent = extent_of(mesh);
  const double scale = extent > 0.0 ? 1.0 / extent : 0.0;
  for (const Triangle& t : mesh.triangles) {
    Vec3 u{};
    Vec3 v{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      u[axis] = (mesh.positions[t[1]][axis] - mesh.positions[t[0]][axis]) * scale;
      v[axis] = (mesh.positions[t[2]][axis] - mesh.positions[t[0]][axis]) * scale;
    }
    const Vec3 area{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
    for (const std::uint32_t corner : t) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sums[corner][axis] += area[axis];
      }
    }
  }
}

/// False for a vector without a direction.
bool make_unit(Vec3& vector) {
  const double largest = std::max({std::abs(vector[0]), std::abs(vector[1]), std::abs(vector[2])});
  if (!(largest > 0.0) || !std::isfinite(largest)) {
    return false;
  }
  for (double& component : vector) {
    component /= largest;
  }
  const double length = std::hypot(vector[0], vector[1], vector[2]);
  for (double& component : vector) {
    component /= length;
  }
  return true;
}

}  // namespace

Array<Vec3> unit_normals(const Mesh& mesh) {
  Array<Vec3> normals = mesh.normals;
  bool complete = !normals.empty();
  for (Vec3& normal : normals) {
    complete = make_unit(normal) && complete;
  }
  if (complete) {
    return normals;
  }
  Array<Vec3> sums(mesh.positions.size(), Vec3{0, 0, 0});
  add_area_vectors(mesh, sums);
  normals.resize(mesh.positions.size(), Vec3{0, 0, 0});
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (!make_unit(normals[v])) {
      normals[v] = make_unit(sums[v]) ? sums[v] : Vec3{0, 0, 1};
    }
  }
  return normals;
}

}  // namespace difmesh::detail
