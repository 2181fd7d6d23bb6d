#pragma once
// Whether triangles bound something: every edge run along as often one way as the other.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

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

/// What is wrong with a mesh whose edges are not in balance.
struct EdgeDefect {
  std::string message;  ///< names the first such edge, its place and its triangles
  bool open = false;    ///< there may be a hole, not orientation alone
};

/// Looks for an edge that is out of balance. Edges match by the positions of their ends. O(n log
/// n). \pre indices in range, positions finite
[[nodiscard]] std::optional<EdgeDefect> find_edge_defect(std::span<const Vec3> positions,
                                                         std::span<const Triangle> triangles);

}  // namespace difmesh::detail
