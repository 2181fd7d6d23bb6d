#pragma once
/// \file used_part.hpp
/// A mesh without the vertices that no triangle uses.

#include <optional>
#include <vector>

#include "difmesh/io/vertex_scalars.hpp"

namespace difmesh::detail {

/// The triangles with their vertices, in their order, and what goes with these; nothing where every
/// vertex is in a triangle. glTF and Draco are given this: they place vertices in the box of all, and
/// those far off that no triangle uses would cost the surface digits.
/// \pre the mesh was checked by check_mesh(), the scalars by check_scalars()
[[nodiscard]] std::optional<ScalarMesh> used_part(const Mesh& mesh,
                                                  const std::vector<VertexScalars>& scalars);

}  // namespace difmesh::detail
