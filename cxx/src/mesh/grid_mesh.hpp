#pragma once
// A triangle mesh in the units of a grid, checked.

#include <cstdint>
#include <optional>
#include <span>

#include "base/parallel.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "mesh/closed_surface.hpp"

namespace difmesh::detail {

/// Coordinates in spacings are less than this, in absolute value. Rounding grows with the
/// coordinate: here it is 2^-20 of a cell, and indices of cells are safe in 64 bits.
inline constexpr double kGreatestCoordinate = 0x1p32;

struct GridMesh {
  Array<Vec3> corners;         ///< positions in spacings from the grid's origin
  Array<std::uint64_t> names;  ///< of the corners; equal ones at equal positions
  double volume = 0.0;         ///< inside the whole mesh, in cells
  /// Only where edges were to be checked; nothing is known of the volume then.
  std::optional<EdgeDefect> defect;
};

struct MeshRules {
  bool flip = false;        ///< triangles are clockwise seen from outside
  bool check_edges = true;  ///< demand that edges match
};

/// Share of the progress that checked_mesh() takes.
inline constexpr double kCheckWeight = 0.12;

/// Checks that a mesh is finite, within 2^32 spacings of the grid's origin, has its indices in
/// range, is closed and right way out, and moves it to grid units. \throw Error invalid_argument,
/// naming the vertex or the triangle; edges that do not match are told in the result. \pre not
/// empty
[[nodiscard]] GridMesh checked_mesh(const Grid& grid, std::span<const Vec3> positions,
                                    std::span<const Triangle> triangles, const MeshRules& rules,
                                    Phases& phases);

}  // namespace difmesh::detail
