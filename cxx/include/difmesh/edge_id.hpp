#pragma once
/// \file edge_id.hpp
/// The names of dual edges, by which vertices of blocks are told apart: Mesh::edge_ids.

#include <cstddef>
#include <cstdint>

#include "difmesh/block.hpp"
#include "difmesh/vec3.hpp"

namespace difmesh {

/// A dual edge of a whole grid: from `lower` to the next node along `axis`. Nodes are cell centres,
/// by the index of their cell; -1 and n are the nodes beyond or on the sides of the domain.
struct DualEdgeName {
  Index3 lower{0, 0, 0};
  int axis = 0;  ///< 0, 1, 2 for x, y, z

  bool operator==(const DualEdgeName&) const = default;
};

/// 3 (((k+1)(ny+2) + (j+1))(nx+2) + (i+1)) + axis. Ids ascend with k, then j, then i, then the
/// axis, so that slabs in z have ids one after another.
/// \param dims of the whole grid, each at least 1 and such that validate() takes the grid
/// \pre lower is in [-1, n] along each axis, and in [-1, n - 1] along the edge's own
/// Cost: nanoseconds. Thread safety: pure.
[[nodiscard]] constexpr std::uint64_t edge_id(const Index3& dims,
                                              const DualEdgeName& edge) noexcept {
  std::uint64_t number = 0;
  for (std::size_t t = 3; t-- > 0;) {
    number = number * static_cast<std::uint64_t>(dims[t] + 2) +
             static_cast<std::uint64_t>(edge.lower[t] + 1);
  }
  return 3 * number + static_cast<std::uint64_t>(edge.axis);
}

/// The inverse of edge_id(). \pre id < edge_id_end(dims)
[[nodiscard]] constexpr DualEdgeName edge_of(const Index3& dims, std::uint64_t id) noexcept {
  DualEdgeName edge;
  edge.axis = static_cast<int>(id % 3);
  std::uint64_t rest = id / 3;
  for (std::size_t t = 0; t < 3; ++t) {
    const auto nodes = static_cast<std::uint64_t>(dims[t] + 2);
    edge.lower[t] = static_cast<std::int64_t>(rest % nodes) - 1;
    rest /= nodes;
  }
  return edge;
}

/// All ids of a grid are below this.
[[nodiscard]] constexpr std::uint64_t edge_id_end(const Index3& dims) noexcept {
  std::uint64_t nodes = 1;
  for (const std::int64_t cells : dims) {
    nodes *= static_cast<std::uint64_t>(cells + 2);
  }
  return 3 * nodes;
}

/// True for the one block that owns an edge, of blocks that cover the grid without overlap: the
/// block that holds the cell at the lower node, or the cell nearest to it where the node is none.
/// Reconstructions of neighbouring blocks have vertices in common; each is owned once.
[[nodiscard]] constexpr bool owns(const Block& block, const Index3& dims,
                                  const DualEdgeName& edge) noexcept {
  for (std::size_t t = 0; t < 3; ++t) {
    const std::int64_t first = edge.lower[t] < 0 ? 0 : edge.lower[t];
    const std::int64_t cell = first < dims[t] ? first : dims[t] - 1;
    if (cell < block.offset[t] || cell >= block.offset[t] + block.dims[t]) {
      return false;
    }
  }
  return true;
}

}  // namespace difmesh
