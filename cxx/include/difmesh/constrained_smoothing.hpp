#pragma once
/// \file constrained_smoothing.hpp
/// Smoothing of a reconstructed surface that keeps the fraction of every cell within a tolerance.

#include <cstdint>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

struct ConstrainedSmoothingOptions {
  int steps = 3;  ///< [0, 1000]
  /// By so much the fraction of a cell under the surface may come to differ from what it was;
  /// [1e-9, 0.5].
  double tolerance = 0.01;
  /// Vertices stay at least this share of the edge's length away from its ends; [1e-13, 0.25].
  double clearance = 1e-12;
  int threads = 0;         ///< at most this many, 0: as the machine has; changes no bit
  Progress progress = {};  ///< may be empty; called after each step
};

struct ConstrainedSmoothing {
  Mesh mesh;  ///< with_positions() (vertex_normals.hpp) of the one given
  /// Largest change of a cell's fraction, as measured at the end; at most the tolerance.
  double largest_change = 0.0;
  /// Vertices whose last step was shortened, or denied, for the sake of the fractions.
  std::int64_t held_vertices = 0;
  std::int64_t measurements = 0;  ///< how often the fractions were measured
};

/// Moves vertices along their dual edges towards the parabolic patches of their two rings
/// (curvature.hpp). In each step the fractions of all cells under the surface are measured exactly
/// (fractions_from_mesh.hpp). Where one differs by more than the tolerance from that under the
/// surface as it was given, the moves of the vertices whose triangles reach the cell are halved
/// until none does, and at last undone.
/// Guaranteed, because measured: no cell's fraction changes by more than the tolerance. Guaranteed,
/// because the vertices stay on their dual edges: the surface stays manifold and does not cut
/// itself.
/// All cells may change the same way, so the volume of the whole may drift; the patches do not make
/// it: ten steps change the volume of a ball of radius 24 cells by less than 1e-4 of itself.
///
/// \param mesh from reconstruct() with options.edge_ids, closed
/// \param grid that of the reconstruction
/// \throw Error invalid_argument for options out of range, a mesh without edge_ids or with others
///   than the grid has, a position off its edge (the vertex is named), an open mesh, and what
///   fractions_from_mesh() does not take; invalid_grid; too_large; cancelled
/// Cost: one to ten measurements, as the tolerance demands, and 2 µs per vertex in each step.
/// Memory: two fields of float64 and some 200 bytes per vertex. Thread safety: concurrent calls are
/// safe. Source: in the spirit of smoothing under the constraint that the field is met: S. F. F.
/// Gibson, Constrained elastic surface nets, MICCAI 1998.
[[nodiscard]] ConstrainedSmoothing smooth_within_fractions(
    const Mesh& mesh, const Grid& grid, const ConstrainedSmoothingOptions& options = {});

}  // namespace difmesh
