#include "difmesh/vertex_normals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "base/vector3.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "mesh/area_vectors.hpp"
#include "mesh/mesh_arrays.hpp"

namespace difmesh {
namespace detail {

Array<Vec3> area_vectors(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                         double scale) {
  Array<Vec3> sums;
  sums.assign(positions.size(), Vec3{0.0, 0.0, 0.0});
  for (const Triangle& t : triangles) {
    const Vec3& base = positions[t[0]];
    const Vec3 u = scaled(minus(positions[t[1]], base), scale);
    const Vec3 v = scaled(minus(positions[t[2]], base), scale);
    const Vec3 area = cross(u, v);
    for (const std::uint32_t corner : t) {
      sums[corner] = plus(sums[corner], area);
    }
  }
  return sums;
}

}  // namespace detail

namespace {

using namespace detail;

/// The largest coordinate of a side.
double extent_of(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  double largest = 0.0;
  for (const Triangle& t : triangles) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double base = positions[t[0]][axis];
      largest = std::max({largest, std::abs(positions[t[1]][axis] - base),
                          std::abs(positions[t[2]][axis] - base)});
    }
  }
  return largest;
}

/// 0 for a vector without a direction. Whatever its length, no square leaves the range of numbers.
Vec3 direction_of(Vec3 vector) {
  const double largest = std::max({std::abs(vector[0]), std::abs(vector[1]), std::abs(vector[2])});
  if (!(largest > 0.0) || !std::isfinite(largest)) {
    return {0.0, 0.0, 0.0};
  }
  for (double& component : vector) {
    component /= largest;
  }
  const double length = std::hypot(vector[0], vector[1], vector[2]);
  return {vector[0] / length, vector[1] / length, vector[2] / length};
}

/// Those of a surface that has moved, in the unit of its positions: where there is a length to
/// speak of is a direction, elsewhere the normal stays.
void renew(Array<Vec3>& normals, const Array<Vec3>& areas) {
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const Vec3& area = areas[v];
    const double length = std::hypot(area[0], area[1], area[2]);
    for (std::size_t axis = 0; axis < 3 && length > 0.0; ++axis) {
      normals[v][axis] = area[axis] / length;
    }
  }
}

}  // namespace

Array<Vec3> vertex_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  const DefaultFloatEnvironment environment;
  check_mesh_arrays("vertex_normals", positions, triangles);
  // In units of the longest side: squares of small lengths would underflow.
  const double extent = extent_of(positions, triangles);
  Array<Vec3> normals = area_vectors(positions, triangles, extent > 0.0 ? 1.0 / extent : 0.0);
  for (Vec3& normal : normals) {
    normal = direction_of(normal);
  }
  return normals;
}

Mesh with_positions(Mesh mesh, Array<Vec3> positions) {
  const DefaultFloatEnvironment environment;
  const auto check = [&mesh](std::size_t count, const char* what) {
    if (count != mesh.positions.size()) {
      throw Error(ErrorCode::invalid_argument,
                  "with_positions: " + std::to_string(count) + " " + what + " for " +
                      std::to_string(mesh.positions.size()) + " vertices");
    }
  };
  check(positions.size(), "positions");
  if (!mesh.normals.empty()) {
    check(mesh.normals.size(), "normals");
    check_mesh_arrays("with_positions", positions, mesh.triangles);
    renew(mesh.normals, area_vectors(positions, mesh.triangles));
  }
  mesh.positions = std::move(positions);
  mesh.scalars.clear();
  return mesh;
}

}  // namespace difmesh
