#pragma once
/// \file surface_builder.hpp
/// A field slab by slab in, a surface portion by portion out: for fields and meshes that need not
/// fit into memory, or come from a solver or a file one layer after another.

#include <cstdint>
#include <memory>
#include <optional>

#include "difmesh/block.hpp"
#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh_portion.hpp"
#include "difmesh/options.hpp"
#include "difmesh/report.hpp"

namespace difmesh {

/// How a SurfaceBuilder works; nothing of it changes the surface.
struct BuilderOptions {
  /// A part of the grid instead of all of it. The slabs bring the cells of the block with its ghost
  /// layers, and the surface is that of reconstruct_block().
  std::optional<Block> part = {};
  /// Layers of cells that are worked on at once where slabs are thin. Each such group costs the
  /// planes and edges of one layer, and a look at the cells of 2 ghost_layers(), once more (for
  /// Placement::curved the surfaces of five layers); it needs memory for its fractions and its
  /// mesh. 0: as many as hold 4 million cells, but at least 16.
  std::int64_t layers_at_once = 0;
};

/// Reconstructs a field that comes in consecutive slabs, from z = 0 up: the same vertices and
/// triangles, in the same order and to the last bit, as reconstruct() of the whole field, and the
/// same Report but for its seconds, wherever the field is cut.
///
///     SurfaceBuilder builder(grid, options, [&](const MeshPortion& portion) { … });
///     while (more) builder.add(next_slab());
///     Report report = builder.finish();
///
/// Holds the last 2 ghost_layers() layers and those that wait for layers_at_once. Slabs thicker
/// than that are worked on where they lie; the caller may free a slab once add() returns.
/// Periodic in z: the first cells need the last ones. Give the field in one slab, or a `part` that
/// is the whole grid with ghost_layers() ghost layers at both ends in z, wrapped round.
/// Thread safety: one call at a time on each builder; different builders are independent.
class SurfaceBuilder {
 public:
  /// \param sink gets what is final, on the thread that calls add(): vertices with normals and
  ///   edge ids as options ask, triangles with the indices of the whole mesh
  /// \throw Error invalid_argument, invalid_grid: options, grid or part are wrong, or there is no
  ///   sink
  SurfaceBuilder(const Grid& grid, const Options& options, MeshSink sink,
                 const BuilderOptions& builder = {});
  /// A builder that was moved from has no missing layers and throws invalid_argument when used.
  SurfaceBuilder(SurfaceBuilder&& other) noexcept;
  SurfaceBuilder& operator=(SurfaceBuilder&& other) noexcept;
  ~SurfaceBuilder();

  /// Takes the next slab: all cells of the grid, or of the part with its ghosts, in x and y, and
  /// one or more layers in z, in any layout; all slabs have the same element type.
  /// \throw Error invalid_argument if the slab does not fit: it is not taken, another one may be;
  ///   else as reconstruct(): invalid_value, too_large, cancelled; OutOfMemory; what the sink
  ///   throws. The builder takes nothing more after those: what the sink has is the beginning of
  ///   the surface.
  /// Cost: as reconstruct() of these layers.
  void add(const FieldView& slab);

  /// Says what was found. \throw Error invalid_argument if layers are missing.
  [[nodiscard]] Report finish();

  /// Layers that are still missing.
  [[nodiscard]] std::int64_t missing_layers() const noexcept;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace difmesh
