#pragma once
// The plane that suits the neighbours' fractions best, for cells whose stencils the domain cuts
// short.

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// Fractions of 3x3x3 cells, [z][y][x], where is_there says so.
struct NeighbourFractions {
  double fraction[3][3][3];
  bool is_there[3][3][3];
};

/// Turns m, the normal in the unit cell of the centre, to lessen the sum of squared differences
/// between the fractions that the centre's plane gives its neighbours and theirs; the plane keeps
/// the centre's fraction. Planes are found exactly from starts some ten degrees off. |m|₁ = 1.
/// Source: LVIRA: Pilliod & Puckett, J. Comput. Phys. 199 (2004) 465-502; by Gauss-Newton steps.
/// \pre m is not zero; the centre's fraction is in (0,1)
[[nodiscard]] Vec3 fit_to_neighbours(const NeighbourFractions& hood, const Vec3& m);

}  // namespace difmesh::detail
