#pragma once
// Linear interpolation, as plain marching cubes has it.

namespace difmesh::detail {

/// The position where the fractions, interpolated, are 1/2; see FractionBatch::position.
[[nodiscard]] double linear_position(double outer, double inner);

}  // namespace difmesh::detail
