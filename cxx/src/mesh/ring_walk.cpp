#include "mesh/ring_walk.hpp"

#include <cstddef>

namespace difmesh::detail {

void RingWalk::start(std::uint32_t vertex) {
  ++walk_;
  vertices_.clear();
  ring_ = 0;
  insert(vertex);
}

bool RingWalk::add_ring() {
  const std::size_t end = vertices_.size();
  for (; ring_ < end; ++ring_) {
    for (const std::uint32_t neighbour : neighbours_.of(vertices_[ring_])) {
      insert(neighbour);
    }
  }
  return vertices_.size() > end;
}

bool RingWalk::insert(std::uint32_t vertex) {
  const std::uint64_t entry = walk_ << 32 | vertex;
  const std::size_t mask = table_.size() - 1;
  std::size_t at = (vertex * 0x9E3779B1U >> 8) & mask;
  while (table_[at] >> 32 == walk_) {
    if (table_[at] == entry) {
      return false;
    }
    at = (at + 1) & mask;
  }
  table_[at] = entry;
  vertices_.push_back(vertex);
  if (2 * vertices_.size() > table_.size()) {
    grow();
  }
  return true;
}

void RingWalk::grow() {
  table_.assign(2 * table_.size(), 0);
  const std::size_t mask = table_.size() - 1;
  for (const std::uint32_t vertex : vertices_) {
    std::size_t at = (vertex * 0x9E3779B1U >> 8) & mask;
    while (table_[at] != 0) {
      at = (at + 1) & mask;
    }
    table_[at] = walk_ << 32 | vertex;
  }
}

}  // namespace difmesh::detail
