#include "unit_normals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "difmesh/vertex_normals.hpp"

namespace difmesh::detail {
namespace {

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
  const Array<Vec3> own = vertex_normals(mesh.positions, mesh.triangles);
  normals.resize(mesh.positions.size(), Vec3{0, 0, 0});
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (!make_unit(normals[v])) {
      normals[v] = own[v] == Vec3{0, 0, 0} ? Vec3{0, 0, 1} : own[v];
    }
  }
  return normals;
}

}  // namespace difmesh::detail
