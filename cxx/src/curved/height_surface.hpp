#pragma once
// Surfaces from heights.

#include <cstddef>
#include <optional>

#include "curved/local_surface.hpp"
#include "curved/neighbourhood.hpp"

namespace difmesh::detail {

/// Which columns, and when the surface is steep enough to be compared with one of nine columns, and
/// how far from it it may be then, in the unit of local_surface.hpp along the normal.
struct HeightRule {
  bool is_biquartic;  ///< 25 columns, else 13
  std::int64_t reach;
  double steep;
  double most_apart;
};
inline constexpr HeightRule kPositionHeights{false, kPositionReach, 0.5, 2e-4};
inline constexpr HeightRule kCurvatureHeights{true, kCurvatureReach, 0.7, 5e-5};

/// The graph over the plane across an axis whose averages over the columns are the heights; none
/// where a column is inconsistent, or where the graph does not explain the cells around.
/// \param sense 1 where the material is below, -1 where it is above
[[nodiscard]] std::optional<Graph> height_surface(const Neighbourhood& cells, std::size_t axis,
                                                  int sense, const HeightRule& rule);

}  // namespace difmesh::detail
