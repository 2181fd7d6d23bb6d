#pragma once
/// \file blocks.hpp
/// Reconstruction of a field in pieces.

#include <algorithm>
#include <vector>

#include "difmesh/reconstruct.hpp"
#include "difmesh/weld.hpp"
#include "support/fields.hpp"

namespace difmesh::test {

/// The cells of a block with its ghost layers, copied out of the whole field. Beyond a periodic side
// the ghosts are wrapped.
struct BlockData {
  Block block;
  OwnedField cells{{0, 0, 0}};
};

inline BlockData cut_out(const OwnedField& field, const Index3& low, const Index3& high,
                         const Options& options) {
  BlockData data;
  Index3 from{};
  Index3 size{};
  for (std::size_t a = 0; a < 3; ++a) {
    const bool periodic = options.sides[2 * a] == Side::periodic;
    const bool whole = low[a] == 0 && high[a] == field.dims[a];
    data.block.offset[a] = low[a];
    data.block.dims[a] = high[a] - low[a];
    data.block.ghost_low[a] =
        periodic ? (whole ? 0 : kGhostLayers) : std::min(kGhostLayers, low[a]);
    data.block.ghost_high[a] =
        periodic ? (whole ? 0 : kGhostLayers) : std::min(kGhostLayers, field.dims[a] - high[a]);
    from[a] = low[a] - data.block.ghost_low[a];
    size[a] = data.block.dims[a] + data.block.ghost_low[a] + data.block.ghost_high[a];
  }
  data.cells = OwnedField(size);
  const auto wrapped = [&](std::size_t a, std::int64_t n) {
    return (from[a] + n + 4 * field.dims[a]) % field.dims[a];
  };
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        data.cells.at(i, j, k) = field.values[static_cast<std::size_t>(
            (wrapped(2, k) * field.dims[1] + wrapped(1, j)) * field.dims[0] + wrapped(0, i))];
      }
    }
  }
  return data;
}

/// The field reconstructed in eight blocks that meet at the cut, welded.
inline Mesh in_blocks(const OwnedField& field, const Grid& grid, const Index3& cut,
                      const Options& options) {
  std::vector<Mesh> meshes;
  // Blocks in an order that is not that of the mesh.
  for (int b = 7; b >= 0; --b) {
    Index3 low{};
    Index3 high{};
    bool exists = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const bool upper = (b >> a & 1) != 0;
      low[a] = upper ? cut[a] : 0;
      high[a] = upper ? field.dims[a] : cut[a];
      exists = exists && low[a] < high[a];
    }
    if (!exists) {
      continue;
    }
    const BlockData data = cut_out(field, low, high, options);
    meshes.push_back(reconstruct_block(data.cells.view(), data.block, grid, options).mesh);
  }
  return weld(meshes, grid);
}

}  // namespace difmesh::test
