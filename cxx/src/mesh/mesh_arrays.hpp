#pragma once
// What all functions that take a mesh as positions and triangles ask of it.

#include <span>
#include <string>

#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// \param caller starts the message
/// \throw Error too_large beyond 2^32 - 1 vertices; invalid_argument naming the first position that
///   is not finite, or else the first triangle with an index out of range
void check_mesh_arrays(const std::string& caller, std::span<const Vec3> positions,
                       std::span<const Triangle> triangles);

/// A triangle without area, whatever the positions.
[[nodiscard]] inline bool index_twice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace difmesh::detail
