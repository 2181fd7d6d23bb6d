#include "mesh/vertex_neighbours.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "mesh/mesh_arrays.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kVerticesPerPortion = 4096;

}  // namespace

// Every triangle enters the other two vertices at each of its corners, so that a neighbour stands
// there as often as their edge has triangles.
VertexNeighbours::VertexNeighbours(std::size_t vertices, std::span<const Triangle> triangles,
                                   Workers& workers)
    : first_(vertices + 2, 0), count_(vertices, 0), on_boundary_(vertices, 0) {
  for (const Triangle& t : triangles) {
    if (!index_twice(t)) {
      for (const std::uint32_t v : t) {
        first_[std::size_t{v} + 2] += 2;
      }
    }
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  entries_.resize(first_.back());
  for (const Triangle& t : triangles) {
    if (!index_twice(t)) {
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint64_t& next = first_[std::size_t{t[c]} + 1];
        entries_[next++] = t[(c + 1) % 3];
        entries_[next++] = t[(c + 2) % 3];
      }
    }
  }
  first_.pop_back();
  const auto count = static_cast<std::int64_t>(vertices);
  workers.for_portions(count, kVerticesPerPortion, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint32_t> inner;
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      std::uint32_t* const from = entries_.data() + first_[v];
      std::uint32_t* const to = entries_.data() + first_[v + 1];
      std::sort(from, to);
      inner.clear();
      std::uint32_t* kept = from;
      for (std::uint32_t* run = from; run != to;) {
        const std::uint32_t neighbour = *run;
        std::uint32_t* const next =
            std::find_if(run, to, [&](std::uint32_t other) { return other != neighbour; });
        if (next - run == 2) {
          inner.push_back(neighbour);
        } else {
          *kept++ = neighbour;
        }
        run = next;
      }
      on_boundary_[v] = static_cast<std::uint32_t>(kept - from);
      kept = std::copy(inner.begin(), inner.end(), kept);
      count_[v] = static_cast<std::uint32_t>(kept - from);
    }
  });
}

}  // namespace difmesh::detail
