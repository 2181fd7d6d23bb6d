#pragma once
// What the triangles around each vertex say of its normal.

#include <span>

#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// Sums of the triangles' vector areas, twice, at each vertex, in the order of the triangles.
/// \param scale what all sides are multiplied by before
[[nodiscard]] Array<Vec3> area_vectors(std::span<const Vec3> positions,
                                       std::span<const Triangle> triangles, double scale = 1.0);

}  // namespace difmesh::detail
