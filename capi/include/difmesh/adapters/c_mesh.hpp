#pragma once
/// \file c_mesh.hpp
/// Meshes of libdifmesh in C++: as the adapters to OpenMesh and CGAL read them, and from what these
/// give back. Header-only; users link libdifmesh and install the component `adapters`.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "difmesh/adapters/mesh_view.hpp"
#include "difmesh/difmesh.h"
#include "difmesh/error.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

/// The arrays of a C mesh, for to_openmesh(), to_cgal() and others. Valid as long as the mesh is
/// neither changed nor freed.
/// \throw Error invalid_argument if libdifmesh refuses to show the mesh, as it does for null.
[[nodiscard]] inline MeshView view_of(const dif_mesh* mesh) {
  MeshView view;
  std::int64_t with_normals = 0;
  std::int64_t with_edge_ids = 0;
  if (dif_mesh_positions(mesh, &view.positions, &view.vertices) != DIF_OK ||
      dif_mesh_triangles(mesh, &view.indices, &view.triangles) != DIF_OK ||
      dif_mesh_normals(mesh, &view.normals, &with_normals) != DIF_OK ||
      dif_mesh_edge_ids(mesh, &view.edge_ids, &with_edge_ids) != DIF_OK) {
    throw Error(ErrorCode::invalid_argument, "the dif_mesh cannot be read");
  }
  const char* name = nullptr;
  for (std::int64_t n = 0; dif_mesh_scalars_name(mesh, n, &name) == DIF_OK && name != nullptr;
       ++n) {
    const double* values = nullptr;
    std::int64_t count = 0;
    if (dif_mesh_scalars(mesh, name, &values, &count) == DIF_OK) {
      view.scalars.push_back({name, {values, static_cast<std::size_t>(count)}});
    }
  }
  return view;
}

/// The arrays of a mesh that came back from another library as a C mesh, for
/// dif_fractions_from_mesh() and others. To be freed by dif_mesh_free().
/// \throw Error invalid_argument with the message of libdifmesh
[[nodiscard]] inline dif_mesh* to_dif_mesh(const Mesh& mesh) {
  const MeshView view(mesh);
  dif_mesh* result = nullptr;
  const auto set_scalar = [&result](const ScalarView& scalar) {
    return dif_mesh_set_scalars(result, scalar.name.c_str(), scalar.values.data()) == DIF_OK;
  };
  if (dif_mesh_from_arrays(view.positions, view.vertices, view.indices, view.triangles, &result) !=
          DIF_OK ||
      dif_mesh_set_normals(result, view.normals) != DIF_OK ||
      dif_mesh_set_edge_ids(result, view.edge_ids) != DIF_OK ||
      !std::all_of(view.scalars.begin(), view.scalars.end(), set_scalar)) {
    const std::string message = dif_last_message();
    dif_mesh_free(result);
    throw Error(ErrorCode::invalid_argument, message);
  }
  return result;
}

}  // namespace difmesh
