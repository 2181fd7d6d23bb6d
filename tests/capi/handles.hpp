#pragma once
/// \file handles.hpp
/// The C interface from tests in C++: handles that free themselves, structs prepared, fields made.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "difmesh/difmesh.h"
#include "support/fields.hpp"

namespace difmesh::test {

struct Free {
  void operator()(dif_mesh* mesh) const { dif_mesh_free(mesh); }
  void operator()(dif_shape* shape) const { dif_shape_free(shape); }
  void operator()(dif_field_file* file) const { dif_field_file_free(file); }
};
using MeshHandle = std::unique_ptr<dif_mesh, Free>;
using ShapeHandle = std::unique_ptr<dif_shape, Free>;
using FieldFileHandle = std::unique_ptr<dif_field_file, Free>;

/// A struct as its _init function leaves it.
template <class Struct>
[[nodiscard]] Struct prepared(dif_status (*init)(Struct*, std::uint64_t)) {
  Struct result;
  REQUIRE(init(&result, sizeof result) == DIF_OK);
  return result;
}

[[nodiscard]] inline dif_measure measured(const dif_mesh* mesh) {
  dif_measure facts = prepared(dif_measure_init);
  REQUIRE(dif_mesh_measure(mesh, &facts) == DIF_OK);
  return facts;
}
/// Of the bounding box.
[[nodiscard]] inline double longest_side(const dif_measure& facts) {
  double side = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    side = std::max(side, facts.high[axis] - facts.low[axis]);
  }
  return side;
}

[[nodiscard]] inline dif_field c_field(const void* data, std::int32_t type, const Index3& dims) {
  dif_field field;
  REQUIRE(dif_field_init(&field, sizeof field, data, type, dims.data()) == DIF_OK);
  return field;
}
[[nodiscard]] inline dif_field c_field(const OwnedField& field) {
  return c_field(field.values.data(), DIF_FLOAT64, field.dims);
}

[[nodiscard]] inline dif_grid c_grid(const Grid& grid) {
  dif_grid result;
  REQUIRE(dif_grid_init(&result, sizeof result, grid.dims.data()) == DIF_OK);
  for (int axis = 0; axis < 3; ++axis) {
    result.origin[axis] = grid.origin[static_cast<std::size_t>(axis)];
    result.spacing[axis] = grid.spacing[static_cast<std::size_t>(axis)];
  }
  return result;
}

[[nodiscard]] inline MeshHandle c_reconstruct(const dif_field& field,
                                              const dif_options* options = nullptr) {
  dif_mesh* mesh = nullptr;
  const dif_status status = dif_reconstruct(&field, options, &mesh);
  INFO(std::string(dif_last_message()));
  REQUIRE(status == DIF_OK);
  return MeshHandle(mesh);
}

/// The field in a file that was read; it borrows the file's memory.
[[nodiscard]] inline dif_field field_of(const FieldFileHandle& file) {
  dif_field field{};
  field.struct_size = sizeof field;
  REQUIRE(dif_field_file_field(file.get(), &field) == DIF_OK);
  return field;
}

/// A copy of the arrays behind a handle.
[[nodiscard]] inline Mesh mesh_of(const dif_mesh* handle) {
  Mesh mesh;
  std::int64_t count = 0;
  const double* numbers = nullptr;
  REQUIRE(dif_mesh_positions(handle, &numbers, &count) == DIF_OK);
  const auto* points = reinterpret_cast<const Vec3*>(numbers);
  mesh.positions.assign(points, points + count);
  const std::uint32_t* indices = nullptr;
  REQUIRE(dif_mesh_triangles(handle, &indices, &count) == DIF_OK);
  const auto* triangles = reinterpret_cast<const Triangle*>(indices);
  mesh.triangles.assign(triangles, triangles + count);
  REQUIRE(dif_mesh_normals(handle, &numbers, &count) == DIF_OK);
  const auto* normals = reinterpret_cast<const Vec3*>(numbers);
  mesh.normals.assign(normals, normals + count);
  const std::uint64_t* ids = nullptr;
  REQUIRE(dif_mesh_edge_ids(handle, &ids, &count) == DIF_OK);
  mesh.edge_ids.assign(ids, ids + count);
  return mesh;
}

}  // namespace difmesh::test
