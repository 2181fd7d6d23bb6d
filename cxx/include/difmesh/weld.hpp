#pragma once
/// \file weld.hpp
/// Joins the meshes of blocks by the names of their vertices.

#include <span>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

/// Joins meshes from reconstruct_block() over disjoint blocks of one grid. Vertices are identified
/// by edge id, never by distance. Vertices come in the order of their ids and triangles in the
/// order of their dual cells, so blocks that cover the grid give the mesh of the whole field, bit
/// for bit. Scalars come along by name.
/// \param grid the whole grid
/// \throw Error invalid_argument if a mesh has vertices without edge_ids, an id is outside the
///   grid, only some meshes have normals or a scalar, or blocks are not disjoint, for instance one
///   given twice: two meshes have triangles between the same cells; too_large beyond 2^32 - 1
///   vertices.
/// Cost: linear in the size of the meshes for few of them, as each is sorted by itself. Thread
/// safety: pure function.
[[nodiscard]] Mesh weld(std::span<const Mesh> meshes, const Grid& grid);
/// The same for meshes that lie apart; none may be NULL.
[[nodiscard]] Mesh weld_pointers(std::span<const Mesh* const> meshes, const Grid& grid);

}  // namespace difmesh
