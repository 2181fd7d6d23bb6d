#pragma once
/// \file sample_grid.hpp
/// The grid on which a body is sampled, from its box and what the command line tells.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "difmesh/grid.hpp"
#include "difmesh/shapes.hpp"

namespace difmesh::cli {

/// Either cells or spacing is set.
struct GridWish {
  std::optional<std::int64_t> cells;  ///< along the longest side, cubes
  std::optional<Index3> cells_by_axis;
  std::optional<Vec3> spacing;
  std::optional<Vec3> origin;
};

/// Cells that stay free between a body and each side of the grid, unless the origin is given.
inline constexpr std::int64_t kMarginCells = 3;

/// A grid that holds `body` with that margin, and has it in its middle. If the origin is given the
/// grid starts there, cuts off what lies before, and keeps the margin at its far sides only.
/// \throw CLI::ValidationError naming the option that asks for what cannot be
[[nodiscard]] Grid grid_around(const Bounds& body, const GridWish& wish);

}  // namespace difmesh::cli
