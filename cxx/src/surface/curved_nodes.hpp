#pragma once
// On which side of the curved surfaces the nodes of the dual grid are.

#include "curved/surface_table.hpp"
#include "grid/node_bits.hpp"
#include "surface/dual_grid.hpp"

namespace difmesh::detail {

/// A centre is inside where its cell's surface says so, whatever the fraction: with γ >= 1/2 alone
/// the true surface would leave edges next to cells with γ near 1/2. Only where the fraction is in
/// [0.3, 0.7], and the surfaces of the cell and its six neighbours agree with each other. Returns
/// how many centres of the block's own cells changed sides.
std::int64_t settle_centres(SurfaceTable& table, NodeBits& nodes);

/// The same for nodes on open domain faces that the surface may run on to: what the surface of
/// their cell says of the face.
void settle_faces(const SurfaceTable& table, DualGrid& grid);

}  // namespace difmesh::detail
