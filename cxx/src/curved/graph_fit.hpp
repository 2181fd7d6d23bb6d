#pragma once
// Surfaces fitted to fractions.

#include <optional>

#include "curved/local_surface.hpp"
#include "curved/neighbourhood.hpp"

namespace difmesh::detail {

/// The graph of a polynomial whose fractions differ least, in weighted squares, from those of the
/// cells up to two steps away; none where it does not explain them, or passes the cell at more than
/// 1.8 cells.
/// \tparam kDegree 2 or 4, of the polynomial
/// \param m a normal in the unit cell, not 0: see UnitNormal
template <int kDegree>
[[nodiscard]] std::optional<Graph> fitted_graph(const Neighbourhood& cells, const Vec3& m);

}  // namespace difmesh::detail
