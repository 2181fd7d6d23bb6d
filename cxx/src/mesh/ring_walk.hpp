#pragma once
// The vertices within so many edges of a vertex.

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/vertex_neighbours.hpp"

namespace difmesh::detail {

/// Walks away from one vertex after the other, ring by ring. One per thread.
class RingWalk {
 public:
  explicit RingWalk(const VertexNeighbours& neighbours) : neighbours_(neighbours) {}

  void start(std::uint32_t vertex);
  /// Adds the next ring. \return false if there is none
  bool add_ring();
  /// The vertex itself, then its rings, each in the order of the ring before.
  [[nodiscard]] std::span<const std::uint32_t> vertices() const { return vertices_; }

 private:
  bool insert(std::uint32_t vertex);
  void grow();

  const VertexNeighbours& neighbours_;
  std::vector<std::uint32_t> vertices_;
  std::size_t ring_ = 0;  ///< where the last ring starts in vertices_
  /// Hash table of what is in vertices_: walk << 32 | vertex. Entries of earlier walks are free.
  std::vector<std::uint64_t> table_ = std::vector<std::uint64_t>(256, 0);
  std::uint64_t walk_ = 0;
};

}  // namespace difmesh::detail
