#include "mesh/closed_surface.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "base/position_text.hpp"

namespace difmesh::detail {
namespace {

/// The output function of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): every bit of the argument
/// moves every bit of the result.
std::uint64_t mix(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// One run of a triangle along an edge, ends by their place in space.
struct HalfEdge {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  bool forward = false;  ///< from low to high

  [[nodiscard]] bool same_edge(const HalfEdge& other) const noexcept {
    return low == other.low && high == other.high;
  }
};

/// For each vertex, the first one at the same position.
std::vector<std::uint32_t> first_at_position(std::span<const Vec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return positions[a] != positions[b] ? positions[a] < positions[b] : a < b;
  });
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && positions[order[i]] == positions[order[i - 1]];
    first[order[i]] = again ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::vector<HalfEdge> sorted_half_edges(std::span<const std::uint32_t> first,
                                        std::span<const Triangle> triangles) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = first[triangles[t][corner]];
      const std::uint32_t to = first[triangles[t][(corner + 1) % 3]];
      if (from != to) {
        half_edges.push_back(
            {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(t), from < to});
      }
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.low != b.low) {
      return a.low < b.low;
    }
    return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  });
  return half_edges;
}

std::string describe(std::span<const HalfEdge> uses, std::span<const Vec3> positions) {
  const auto end = [&](std::uint32_t vertex) {
    return "vertex " + std::to_string(vertex) + " at " + rounded_text(positions[vertex]);
  };
  const std::string edge = "the edge from " + end(uses[0].low) + " to " + end(uses[0].high);
  if (uses.size() == 1) {
    return "the mesh is open: " + edge + " belongs to triangle " +
           std::to_string(uses[0].triangle) + " only";
  }
  if (uses.size() == 2) {
    return "the mesh has mixed orientation: triangles " + std::to_string(uses[0].triangle) +
           " and " + std::to_string(uses[1].triangle) + " run the same way along " + edge;
  }
  const auto forward =
      std::count_if(uses.begin(), uses.end(), [](const HalfEdge& use) { return use.forward; });
  return "the mesh is open or has mixed orientation: " + std::to_string(forward) +
         " triangles run one way along " + edge + " and " +
         std::to_string(static_cast<std::ptrdiff_t>(uses.size()) - forward) +
         " the other way, among them triangle " + std::to_string(uses[0].triangle);
}

}  // namespace

std::uint64_t position_key(const Vec3& position) noexcept {
  std::uint64_t key = 0;
  for (const double coordinate : position) {
    // Adding 0 turns -0, which equals 0, into 0.
    key = mix(key + 0x9e3779b97f4a7c15U + std::bit_cast<std::uint64_t>(coordinate + 0.0));
  }
  return key;
}

std::uint64_t edge_balance(std::span<const std::uint64_t> position_keys,
                           std::span<const Triangle> triangles) noexcept {
  std::uint64_t sum = 0;
  for (const Triangle& triangle : triangles) {
    std::uint64_t from = position_keys[triangle[2]];
    for (const std::uint32_t vertex : triangle) {
      const std::uint64_t to = position_keys[vertex];
      const std::uint64_t number = mix(std::min(from, to) + mix(std::max(from, to)));
      sum += from < to ? number : std::uint64_t{0} - number;
      // An edge from a point to itself is none.
      sum += from == to ? number : 0;
      from = to;
    }
  }
  return sum;
}

std::optional<EdgeDefect> find_edge_defect(std::span<const Vec3> positions,
                                           std::span<const Triangle> triangles) {
  const std::vector<std::uint32_t> first = first_at_position(positions);
  const std::vector<HalfEdge> half_edges = sorted_half_edges(first, triangles);
  std::span<const HalfEdge> found;
  std::int64_t unbalanced = 0;
  for (std::size_t begin = 0; begin < half_edges.size();) {
    std::size_t end = begin;
    std::int64_t balance = 0;
    for (; end < half_edges.size() && half_edges[end].same_edge(half_edges[begin]); ++end) {
      balance += half_edges[end].forward ? 1 : -1;
    }
    if (balance != 0) {
      if (unbalanced == 0) {
        found = {half_edges.data() + begin, end - begin};
      }
      ++unbalanced;
    }
    begin = end;
  }
  if (unbalanced == 0) {
    return std::nullopt;
  }
  return EdgeDefect{describe(found, positions) + " (" + std::to_string(unbalanced) +
                        (unbalanced == 1 ? " such edge)" : " such edges)"),
                    found.size() != 2};
}

}  // namespace difmesh::detail
