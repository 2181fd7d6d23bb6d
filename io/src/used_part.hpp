#pragma once
/// \file used_part.hpp
/// A mesh without the vertices that no triangle uses.

#include <optional>

#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// The triangles with their vertices, in their order, and what goes with these; nothing where every
/// vertex is in a triangle. glTF and Draco are given this: they place vertices in the box of all,
/// and those far off that no triangle uses would cost the surface digits.
/// \pre check_portion() took the mesh
[[nodiscard]] std::optional<Mesh> used_part(const Mesh& mesh);

}  // namespace difmesh::detail
