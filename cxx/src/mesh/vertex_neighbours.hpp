#pragma once
// Which vertices are joined by edges.

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// The neighbours of each vertex, each once: first those along the boundary, that is over edges
/// that have other than two triangles, then the others, both ascending. Triangles with an index
/// twice have no part.
class VertexNeighbours {
 public:
  /// \pre indices in range, at most 2^32 - 1 vertices
  VertexNeighbours(std::size_t vertices, std::span<const Triangle> triangles, Workers& workers);

  [[nodiscard]] std::size_t size() const { return count_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t vertex) const {
    return {entries_.data() + first_[vertex], count_[vertex]};
  }
  /// Place of of(vertex)[0] in arrays with an entry for each neighbour of each vertex, entries() in
  /// all, some of them unused.
  [[nodiscard]] std::size_t first(std::size_t vertex) const { return first_[vertex]; }
  [[nodiscard]] std::size_t entries() const { return entries_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> along_boundary(std::size_t vertex) const {
    return of(vertex).first(on_boundary_[vertex]);
  }
  [[nodiscard]] bool on_boundary(std::size_t vertex) const { return on_boundary_[vertex] != 0; }

 private:
  std::vector<std::uint64_t> first_;
  std::vector<std::uint32_t> count_;
  std::vector<std::uint32_t> on_boundary_;  ///< how many neighbours
  Array<std::uint32_t> entries_;
};

}  // namespace difmesh::detail
