#pragma once
/// \file vertex_curvature.hpp
/// Curvature at the vertices of a surface from the fractions that it was made of.

#include "difmesh/curvature.hpp"
#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

/// Curvatures at the vertices of a mesh that reconstruct() made of this field, from the surfaces of
/// the two cells that each vertex lies between (cell_surfaces.hpp, kind `curvature`), blended as
/// Placement::curved blends them. Several times nearer than curvature() of the mesh, most of all
/// with that placement. Where neither cell owns a surface, the patch of curvature() stands in.
/// \param mesh with edge_ids: Options::edge_ids. Its vertices may have been moved along their
///   edges.
/// \param options those of reconstruct(), of which boundary, purity_tolerance, threads and progress
///   count
/// \param principal fill Curvature::largest and smallest
/// \return undefined_vertices and widened_vertices are those of the patches that stand in
/// \throw Error as cell_surfaces(); invalid_argument for a mesh without edge_ids, or ids outside
///   the grid
/// Cost: that of the surfaces, each of which is made once or twice. Memory beyond the result: some
/// 20 MB for each thread. Thread safety: concurrent calls are safe.
/// Source: docs/method.md, "Curved cell surfaces".
[[nodiscard]] Curvature vertex_curvature(const FieldView& field, const Grid& grid, const Mesh& mesh,
                                         const Options& options, bool principal = false);

}  // namespace difmesh
