#pragma once
// Normals where cells differ in size: stretched axes.

#include "difmesh/options.hpp"
#include "planes/normal_stencil.hpp"

namespace difmesh::detail {

/// The normal of a cell in its own unit cube, as NormalStencil gives it on uniform axes: gradients
/// use the distances between centres, heights are lengths, slopes are those of the parabola whose
/// means over the columns, of unequal widths, are their heights, and planes are fitted to fractions
/// of cells of their own sizes. So a plane comes out exactly wherever it does on uniform axes.
/// \pre the cell and, as far as the domain reaches, its stencil are in memory
[[nodiscard]] UnitNormal stretched_normal(const BlockField& field, Normals normals,
                                          const Index3& cell);

}  // namespace difmesh::detail
