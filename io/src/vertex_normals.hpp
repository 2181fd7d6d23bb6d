#pragma once
/// \file vertex_normals.hpp

#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// Unit normals of the vertices: those of the mesh, scaled to length 1, or, where it has none or 0,
/// the sum of the triangles' area vectors around, or (0,0,1) where that is 0 too.
[[nodiscard]] Array<Vec3> unit_normals(const Mesh& mesh);

}  // namespace difmesh::detail
