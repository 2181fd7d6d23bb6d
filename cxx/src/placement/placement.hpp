#pragma once
// Placements that need the two fractions of a dual edge alone.

namespace difmesh::detail {

/// Position from the outer cell (outer < 1/2) to the inner one (inner >= 1/2), in [0,1], by linear
/// interpolation to 1/2.
[[nodiscard]] double linear_position(double outer, double inner);

/// The same by Manson, Smith & Schaefer, Eurographics 2011: exact for lines in two dimensions.
[[nodiscard]] double manson_position(double outer, double inner);

}  // namespace difmesh::detail
