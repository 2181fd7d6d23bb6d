#pragma once
/// \file dual_edges.hpp
/// From the name of a vertex to its dual edge.

#include <cstdint>

#include "difmesh/grid.hpp"

namespace difmesh::test {

/// A dual edge runs from the lower node to its neighbour along the axis. Nodes -1 and n of an axis
/// lie on the domain faces or beyond.
struct DualEdge {
  Index3 node{0, 0, 0};
  std::size_t axis = 0;

  [[nodiscard]] Index3 upper() const {
    Index3 other = node;
    ++other[axis];
    return other;
  }
};

/// Takes an id of Mesh::edge_ids apart.
[[nodiscard]] inline DualEdge dual_edge(std::uint64_t id, const Index3& dims) {
  DualEdge edge;
  edge.axis = static_cast<std::size_t>(id % 3);
  auto rest = static_cast<std::int64_t>(id / 3);
  for (std::size_t a = 0; a < 3; ++a) {
    edge.node[a] = rest % (dims[a] + 2) - 1;
    rest /= dims[a] + 2;
  }
  return edge;
}

/// Element of a cell in an array with x fastest.
[[nodiscard]] inline std::size_t element(const Index3& cell, const Index3& dims) {
  return static_cast<std::size_t>((cell[2] * dims[1] + cell[1]) * dims[0] + cell[0]);
}

}  // namespace difmesh::test
