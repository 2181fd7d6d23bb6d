#pragma once
// Whether triangles bound something: every edge run along as often one way as the other.

#include <cstdint>
#include <span>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// A number that stands for a position; equal positions have equal ones, and others do not by all
/// odds.
[[nodiscard]] std::uint64_t position_key(const Vec3& position) noexcept;

/// Sum over the edges of some triangles of a random number for each edge, plus one way, minus the
/// other, modulo 2^64. Over a whole mesh it is 0 if every edge is run along as often one way as the
/// other, and otherwise not, but for one case in 2^64. Sums of parts may be added in any order.
[[nodiscard]] std::uint64_t edge_balance(std::span<const std::uint64_t> position_keys,
                                         std::span<const Triangle> triangles) noexcept;

/// Looks for an edge that is out of balance and throws Error invalid_argument naming it, its place
/// and its triangles; returns if there is none. Edges match by the positions of their ends. O(n log
/// n). \pre indices in range, positions finite
void throw_first_unbalanced_edge(std::span<const Vec3> positions,
                                 std::span<const Triangle> triangles);

}  // namespace difmesh::detail
