#pragma once
/// \file blocks.hpp
/// Reconstruction of a field in pieces.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "difmesh/reconstruct.hpp"
#include "difmesh/weld.hpp"
#include "support/fields.hpp"

namespace difmesh::test {

/// The cells of a block with its ghost layers, copied out of the whole field. Beyond a periodic
/// side
// the ghosts are wrapped.
struct BlockData {
  Block block;
  OwnedField cells{{0, 0, 0}};
};

inline BlockData cut_out(const OwnedField& field, const Index3& low, const Index3& high,
                         const Options& options) {
  BlockData data;
  const std::int64_t layers = ghost_layers(options.placement);
  Index3 from{};
  Index3 size{};
  for (std::size_t a = 0; a < 3; ++a) {
    const bool periodic = options.boundary[2 * a] == Side::periodic;
    const bool whole = low[a] == 0 && high[a] == field.dims[a];
    data.block.offset[a] = low[a];
    data.block.dims[a] = high[a] - low[a];
    data.block.ghost_low[a] = periodic ? (whole ? 0 : layers) : std::min(layers, low[a]);
    data.block.ghost_high[a] =
        periodic ? (whole ? 0 : layers) : std::min(layers, field.dims[a] - high[a]);
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

/// Where blocks begin along each axis, beside 0, ascending.
using Cuts = std::array<std::vector<std::int64_t>, 3>;

/// The blocks of a cut field, each with its ghost layers, in an order that is not that of the mesh.
inline std::vector<BlockData> cut_up(const OwnedField& field, Cuts cuts, const Options& options) {
  for (std::size_t a = 0; a < 3; ++a) {
    cuts[a].insert(cuts[a].begin(), 0);
    cuts[a].push_back(field.dims[a]);
  }
  std::vector<BlockData> blocks;
  for (std::size_t i = cuts[0].size() - 1; i-- > 0;) {
    for (std::size_t j = cuts[1].size() - 1; j-- > 0;) {
      for (std::size_t k = cuts[2].size() - 1; k-- > 0;) {
        const Index3 low{cuts[0][i], cuts[1][j], cuts[2][k]};
        const Index3 high{cuts[0][i + 1], cuts[1][j + 1], cuts[2][k + 1]};
        blocks.push_back(cut_out(field, low, high, options));
      }
    }
  }
  return blocks;
}

/// The field reconstructed in blocks, welded, and their reports merged.
inline Reconstruction in_cut_blocks(const OwnedField& field, const Grid& grid, const Cuts& cuts,
                                    const Options& options) {
  std::vector<Mesh> meshes;
  Reconstruction whole;
  for (const BlockData& data : cut_up(field, cuts, options)) {
    Reconstruction part = reconstruct_block(data.cells.view(), data.block, grid, options);
    meshes.push_back(std::move(part.mesh));
    merge(whole.report, part.report);
  }
  whole.mesh = weld(meshes, grid);
  return whole;
}

/// The field reconstructed in eight blocks that meet at the cut, or fewer if it lies at the end of
/// an axis.
inline Reconstruction in_blocks(const OwnedField& field, const Grid& grid, const Index3& cut,
                                const Options& options) {
  Cuts cuts;
  for (std::size_t a = 0; a < 3; ++a) {
    if (cut[a] < field.dims[a]) {
      cuts[a].push_back(cut[a]);
    }
  }
  return in_cut_blocks(field, grid, cuts, options);
}

}  // namespace difmesh::test
