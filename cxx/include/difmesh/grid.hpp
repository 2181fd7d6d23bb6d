#pragma once
/// \file grid.hpp
/// The Cartesian grid of cells on which fractions live.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "difmesh/vec3.hpp"

namespace difmesh {

/// A Cartesian grid of dims[0] x dims[1] x dims[2] cuboid cells. Cell (i,j,k) covers
/// origin + [i,i+1] dx x [j,j+1] dy x [k,k+1] dz, or on stretched axes what lies between two faces
/// of a table. Lengths are in the caller's unit.
struct Grid {
  Index3 dims{0, 0, 0};         ///< cells in x, y, z; each >= 1, at most 2^31 - 3 each
  Vec3 origin{0.0, 0.0, 0.0};   ///< low corner of cell (0,0,0)
  Vec3 spacing{1.0, 1.0, 1.0};  ///< dx, dy, dz; each in [2^-300, 2^300], not necessarily equal

  /// Stretched axes: by axis the dims + 1 faces between cells, strictly increasing, in place of
  /// origin and spacing. Empty: the axis is uniform.
  std::array<std::vector<double>, 3> faces = {};

  [[nodiscard]] bool is_uniform(std::size_t axis) const noexcept { return faces[axis].empty(); }
  /// All three axes.
  [[nodiscard]] bool is_uniform() const noexcept {
    return is_uniform(0) && is_uniform(1) && is_uniform(2);
  }
  /// Coordinate of the low face of the cell of that index, in [0, dims].
  [[nodiscard]] double face(std::size_t axis, std::int64_t index) const noexcept {
    return is_uniform(axis) ? origin[axis] + static_cast<double>(index) * spacing[axis]
                            : faces[axis][static_cast<std::size_t>(index)];
  }
  /// Width of the cells of an index; outside the grid, that of the nearest ones.
  [[nodiscard]] double width(std::size_t axis, std::int64_t index) const noexcept;
  /// Of all cells along an axis. Cost: one look at each face.
  [[nodiscard]] double least_width(std::size_t axis) const noexcept;
  /// Position of the centre of cell (i,j,k); defined for indices outside the grid as well, where
  /// cells are as wide as the nearest ones.
  [[nodiscard]] Vec3 cell_centre(const Index3& cell) const noexcept;
  [[nodiscard]] Vec3 cell_size(const Index3& cell) const noexcept {
    return {width(0, cell[0]), width(1, cell[1]), width(2, cell[2])};
  }
  /// dx dy dz, of all cells. \pre is_uniform()
  [[nodiscard]] double cell_volume() const noexcept { return spacing[0] * spacing[1] * spacing[2]; }
  /// Number of cells. \pre the grid is valid.
  [[nodiscard]] std::int64_t cell_count() const noexcept { return dims[0] * dims[1] * dims[2]; }
};

/// Checks a grid before anything is allocated from it.
/// \throw Error invalid_grid if a dim is < 1, the origin is not finite, a spacing is outside its
///   range or so small against the origin that neighbouring nodes would coincide in float64 (<
///   2^-40 relative), or a table of faces has another length than dims + 1, is not finite, does not
///   increase, or has cells for which the same holds; too_large if three ids per node of the grid
///   would overflow 63 bits.
void validate(const Grid& grid);

/// \throw Error unsupported, saying that `what` needs uniform axes, if one is stretched.
void require_uniform(const Grid& grid, const char* what);

}  // namespace difmesh
