#pragma once
/// \file unit_normals.hpp

#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// Unit normals of the vertices: those of the mesh, scaled to length 1, or, where it has none or 0,
/// those of its triangles (vertex_normals()), or (0,0,1) where that is 0 too.
[[nodiscard]] Array<Vec3> unit_normals(const Mesh& mesh);

}  // namespace difmesh::detail
