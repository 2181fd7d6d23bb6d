#pragma once
// Where surfaces of neighbouring cells contradict each other.

#include "curved/surface_table.hpp"

namespace difmesh::detail {

/// Whether the surface of a cell passes a kink, or a place that is too badly resolved to tell:
/// whether the surfaces of interfacial cells within 1.6 cells of its foot pass the foot at more
/// than their bend explains, or one of these cells owns nothing though all that do are nearly flat.
[[nodiscard]] bool is_kinked(const SurfaceTable& table, const Index3& cell,
                             const OwnedSurface& surface);

}  // namespace difmesh::detail
