#pragma once
// Fractions from a function of which more is known in some cells.

#include <functional>
#include <optional>

#include "difmesh/fractions_from_function.hpp"

namespace difmesh::detail {

/// The fraction of a cell by its low corner and size, where it is known without quadrature. Called
/// from several threads at once.
using KnownFraction = std::function<std::optional<double>(const Vec3& low, const Vec3& size)>;

/// As fractions_from_function(). \param known may be empty
[[nodiscard]] FractionsFromFunction fractions_with_known_cells(
    const Grid& grid, const FunctionBatch& f, const FractionsFromFunctionOptions& options,
    const KnownFraction& known);

}  // namespace difmesh::detail
