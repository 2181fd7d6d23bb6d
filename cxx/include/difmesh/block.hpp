#pragma once
/// \file block.hpp
/// Parts of a grid.

#include <cstdint>

#include "difmesh/options.hpp"
#include "difmesh/vec3.hpp"

namespace difmesh {

/// Ghost cells that a block needs beyond each of its faces, as far as the domain reaches (and
/// beyond it on periodic sides): one for the dual cell and four for the column of heights.
inline constexpr std::int64_t kGhostLayers = 5;
/// The same for Placement::curved: one for the dual cell, one for the neighbours that say on which
/// side a node is, one for the surfaces that say whether these are kinked, and five for the heights
/// of those.
inline constexpr std::int64_t kCurvedGhostLayers = 8;

[[nodiscard]] constexpr std::int64_t ghost_layers(Placement placement) {
  return placement == Placement::curved ? kCurvedGhostLayers : kGhostLayers;
}

/// A block of a larger grid. The field view given with it covers the cells
/// [offset - ghost_low, offset + dims + ghost_high) of the whole grid.
struct Block {
  Index3 offset{0, 0, 0};      ///< first cell of the block in the whole grid
  Index3 dims{0, 0, 0};        ///< cells of the block
  Index3 ghost_low{0, 0, 0};   ///< ghost cells before the block in x, y, z
  Index3 ghost_high{0, 0, 0};  ///< ghost cells after it
};

}  // namespace difmesh
