#pragma once
/// \file reconstruct.hpp
/// The main job: a field of volume fractions in, a surface out.

#include <cstdint>

#include "difmesh/block.hpp"
#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"
#include "difmesh/report.hpp"

namespace difmesh {

struct Reconstruction {
  Mesh mesh;
  Report report;
};

/// Reconstructs the surface of the whole field.
///
/// Marching cubes runs on the dual grid, whose nodes are the cell centres, at level 1/2 (with
/// `curved` a centre with 0.3 < γ < 0.7 may be on the other side: see Report::moved_centres); the
/// vertex on each crossed dual edge is put where options.placement says. The result is edge- and
/// vertex-manifold and free of self-intersections for every input, and bit-identical for any number
/// of threads.
/// - `open` sides: the dual grid has more nodes on the domain faces, edges and corners, and the
///   mesh ends there. With `plic` it follows the planes of the last cells.
/// - `periodic` axes: the mesh spans one period, from the first cell centre to its image; boundary
///   loops are equal but for one period, added to the coordinate.
/// - `mirror` sides: the mesh ends there too, at right angles. It ends nowhere else, but for edges
///   of the domain where an `empty` side meets a `full` one.
/// \param field cells in memory; dims must equal grid.dims
/// \throw Error invalid_argument (field or options), invalid_grid, invalid_value (first bad cell in
///   the order z, y, x is named), too_large, cancelled; OutOfMemory, early where that is known
/// Cost: one pass over the field, then O(interfacial cells). Memory beyond the output: one bit per
/// cell, some bytes per row of cells, and what the interfacial cells of two slabs and of the
/// outermost layers need; with Placement::curved 200 bytes for each interfacial cell, and up to a
/// hundred times the time where it is smeared. Thread safety: concurrent calls are safe.
/// Source: E19, as docs/method.md lays out.
[[nodiscard]] Reconstruction reconstruct(const FieldView& field, const Grid& grid,
                                         const Options& options = {});

/// Reconstructs one block of a larger grid: the dual cells whose lower node is in the block (and
/// those before the first cell at the low sides of the domain). `grid` is the whole grid. The mesh
/// carries edge_ids; vertices on faces between blocks come with both blocks, bit-equal; see weld().
/// \throw as reconstruct(), and invalid_argument where ghost layers are missing.
[[nodiscard]] Reconstruction reconstruct_block(const FieldView& field, const Block& block,
                                               const Grid& grid, const Options& options = {});

}  // namespace difmesh
