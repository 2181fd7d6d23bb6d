#pragma once
/// \file grid.hpp
/// The Cartesian grid of cells on which fractions live.

#include <cstdint>

#include "difmesh/vec3.hpp"

namespace difmesh {

/// A Cartesian grid of dims[0] x dims[1] x dims[2] cuboid cells. Cell (i,j,k) covers
/// origin + [i,i+1] dx x [j,j+1] dy x [k,k+1] dz. Lengths are in the caller's unit.
struct Grid {
  Index3 dims{0, 0, 0};         ///< cells in x, y, z; each >= 1, at most 2^31 - 3 each
  Vec3 origin{0.0, 0.0, 0.0};   ///< low corner of cell (0,0,0)
  Vec3 spacing{1.0, 1.0, 1.0};  ///< dx, dy, dz; each in [2^-300, 2^300], not necessarily equal

  /// Position of the centre of cell (i,j,k); defined for indices outside the grid as well.
  [[nodiscard]] Vec3 cell_centre(const Index3& cell) const noexcept;
  /// dx dy dz.
  [[nodiscard]] double cell_volume() const noexcept { return spacing[0] * spacing[1] * spacing[2]; }
  /// Number of cells. \pre the grid is valid.
  [[nodiscard]] std::int64_t cell_count() const noexcept { return dims[0] * dims[1] * dims[2]; }
};

/// Checks a grid before anything is allocated from it.
/// \throw Error invalid_grid if a dim is < 1, the origin is not finite, a spacing is outside its
///   range or so small against the origin that neighbouring nodes would coincide in float64 (<
///   2^-40 relative); too_large if three ids per node of the grid would overflow 63 bits.
void validate(const Grid& grid);

}  // namespace difmesh
