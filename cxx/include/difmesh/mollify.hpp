#pragma once
/// \file mollify.hpp
/// Smoothing of a field by convolution with a compact kernel.

#include "difmesh/field_view.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

struct MollifyOptions {
  /// Where the kernel ends, in cells; [1, 8]. At 1 nothing changes.
  double radius = 2.0;
  /// What lies beyond the sides, as in Options; but nothing being known beyond `open` sides, they
  /// count as mirrors here.
  Boundary boundary{Side::open, Side::open, Side::open, Side::open, Side::open, Side::open};
  int threads = 0;         ///< at most this many, 0: as the machine has; changes no bit
  Progress progress = {};  ///< may be empty; see options.hpp
};

/// Convolution of a field with the kernel (1 - r²/radius²)^4, r < radius, whose sum over the cells
/// is made 1: what is done to fractions before they are contoured linearly or differentiated.
/// - r counts cells, along each axis alike: with different spacings the kernel's support is an
///   ellipsoid of `radius` spacings along each axis; on stretched axes what is kept is the sum, not
///   the volume. Radius 2, as in E19 (options.hpp), reaches the 3 x 3 x 3 cells.
/// - Kept: constants, to the bit; fields that are linear in the cells' indices, but for cells
///   within a radius of a side that is not periodic; the sum over all cells, up to rounding, unless
///   a side is `empty` or `full`, through which material leaves or enters; [0,1].
/// - The kernel is the same along all axes and both ways.
/// - Values are taken as they are: neither clamped nor held against a bound.
/// A surface of radius R with sharp fractions moves inwards by 0.32 Δx²/R at radius 2.
///
/// \return one value per cell, x fastest
/// \throw Error invalid_grid for dims < 1; invalid_argument (field or options); invalid_value for
///   the first cell, in the order z, y, x, that is not finite; too_large; cancelled
/// Cost: O(cells) for the rows that are uniform as far as the kernel reaches; elsewhere some 15 ns
/// per cell at radius 2, growing with its cube. Memory: the result and 16 bytes per row. Thread
/// safety: concurrent calls are safe.
/// Source: E19, figure 2c; the kernel: M. W. Williams, D. B. Kothe, E. G. Puckett, in Fluid
/// Dynamics at Interfaces, Cambridge 1999 (K8).
[[nodiscard]] Array<double> mollify(const FieldView& field, const MollifyOptions& options = {});

}  // namespace difmesh
