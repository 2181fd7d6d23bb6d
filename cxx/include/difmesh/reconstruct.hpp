#pragma once
/// \file reconstruct.hpp
/// The main job: a field of volume fractions in, a surface out.

#include <cstdint>

#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

/// Facts about one reconstruction. Counts are of the block where a block was reconstructed.
struct Report {
  std::int64_t cells = 0;              ///< cells read
  std::int64_t interfacial_cells = 0;  ///< tolerance < γ < 1 - tolerance
  std::int64_t clamped_cells = 0;      ///< γ < 0 or γ > 1
  double largest_overshoot = 0.0;      ///< largest distance of a γ from [0,1]
  double fraction_volume = 0.0;        ///< Σγ|K| over the cells, clamped, in the unit of the grid
  std::int64_t planes = 0;             ///< cells that were given a normal and a plane
  std::int64_t height_function_cells = 0;  ///< of these, with a normal from heights
  std::int64_t gradient_free_cells = 0;  ///< of these, without gradient: edge directions were used
  std::int64_t solved_edges = 0;         ///< vertices placed by the half-full window
  double newton_steps_mean = 0.0;        ///< steps per solved edge
  std::int64_t newton_steps_max = 0;
  std::int64_t non_monotone_edges =
      0;                         ///< solved edges where the window's fraction is not monotone
  bool closed = true;            ///< no boundary edge; an empty mesh is closed
  double enclosed_volume = 0.0;  ///< signed volume inside; 0 where not closed
  struct Seconds {               ///< wall time by phase
    double classify = 0.0;       ///< the one pass over the field: checks, sums, inside bits
    double normals = 0.0;        ///< normals and planes
    double count = 0.0;          ///< counting and allocation of the output
    double vertices = 0.0;       ///< placement
    double triangles = 0.0;      ///< connectivity, volume
    double total = 0.0;
  } seconds;
};

struct Reconstruction {
  Mesh mesh;
  Report report;
};

/// Ghost cells that a block needs beyond each of its faces, as far as the domain reaches (and
/// beyond it on periodic sides): one for the dual cell and four for the column of heights.
inline constexpr std::int64_t kGhostLayers = 5;

/// A block of a larger grid. The field view given with it covers the cells
/// [offset - ghost_low, offset + dims + ghost_high) of the whole grid.
struct Block {
  Index3 offset{0, 0, 0};      ///< first cell of the block in the whole grid
  Index3 dims{0, 0, 0};        ///< cells of the block
  Index3 ghost_low{0, 0, 0};   ///< ghost cells before the block in x, y, z
  Index3 ghost_high{0, 0, 0};  ///< ghost cells after it
};

/// Reconstructs the surface of the whole field.
///
/// Marching cubes runs on the dual grid, whose nodes are the cell centres, at level 1/2; the vertex
/// on each crossed dual edge is put where options.placement says. The result is edge- and
/// vertex-manifold and free of self-intersections for every input, and bit-identical for any number
/// of threads.
/// - `open` sides: the dual grid has more nodes on the domain faces, edges and corners, and the mesh
///   ends there. With `plic` it follows the planes of the last cells.
/// - `periodic` axes: the mesh spans one period, from the first cell centre to its image; boundary
///   loops are equal but for one period, added to the coordinate.
/// \param field cells in memory; dims must equal grid.dims
/// \throw Error invalid_argument (field or options), invalid_grid, invalid_value (first bad cell in
///   the order z, y, x is named), too_large, cancelled; OutOfMemory, early where that is known
/// Cost: one pass over the field, then O(interfacial cells). Memory beyond the output: two bits per
/// cell and O(interfacial cells). Thread safety: concurrent calls are safe.
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
