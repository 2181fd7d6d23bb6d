#pragma once
// Normals whose planes suit the neighbours' fractions: ELVIRA and LVIRA.

#include "grid/block_field.hpp"
#include "planes/normal_stencil.hpp"

namespace difmesh::detail {

/// Whether these are normals that fitted_normal() makes.
[[nodiscard]] constexpr bool is_fitted(Normals normals) {
  return normals == Normals::elvira || normals == Normals::lvira;
}

/// The normal in the unit cell that suits the fractions of 3x3x3 cells best, among differences of
/// columns of five and `start` (elvira), or among all near `start` (lvira). The plane is to keep
/// the cell's fraction; neighbours beyond open sides have no say. `start` is returned where it has
/// no direction, and for pure cells.
/// \pre is_fitted(normals); the cell and, as far as the domain reaches, two more all round are in
///   memory
[[nodiscard]] UnitNormal fitted_normal(const BlockField& field, Normals normals, const Index3& cell,
                                       const UnitNormal& start);

}  // namespace difmesh::detail
