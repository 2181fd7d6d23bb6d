#pragma once
/// \file vertex_normals.hpp
/// Normals at the vertices of any triangle mesh, from its triangles. Those that reconstruct() gives
/// come from the planes in the cells.

#include <span>

#include "difmesh/mesh.hpp"

namespace difmesh {

/// The direction of the sum of the area vectors of the triangles around each vertex, of length 1;
/// (0, 0, 0) where they have no area or cancel each other.
/// \throw Error invalid_argument for an index out of range (the triangle is named) or a position
///   that is not finite (the vertex is named); too_large beyond 2^32 - 1 vertices
/// Cost: linear, some 20 ns per triangle. Thread safety: pure function.
[[nodiscard]] Array<Vec3> vertex_normals(std::span<const Vec3> positions,
                                         std::span<const Triangle> triangles);

/// The mesh with its vertices moved. Its normals, where it has any, are made anew from the
/// triangles, as by vertex_normals() to the last digits, but for vertices without a direction,
/// which keep theirs. Triangles and edge_ids stay; scalars go, for they were those of the surface
/// as it was.
/// \throw Error as vertex_normals(); invalid_argument for another number of positions or normals
[[nodiscard]] Mesh with_positions(Mesh mesh, Array<Vec3> positions);

}  // namespace difmesh
