#pragma once
// Manson, Smith & Schaefer, Eurographics 2011.

namespace difmesh::detail {

/// The position by their four cases, exact for lines in two dimensions; see
/// PlacementPart::position.
[[nodiscard]] double manson_position(double outer, double inner);

}  // namespace difmesh::detail
