#include "sample_grid.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "text.hpp"

namespace difmesh::cli {
namespace {

constexpr std::array<char, 3> kAxes{'x', 'y', 'z'};

/// What the grid has to hold, and how many cells it has beyond that.
struct Need {
  Vec3 length{};
  std::int64_t margin = 0;  ///< cells on both sides together
};

Need need_of(const Bounds& body, const GridWish& wish) {
  Need need;
  need.margin = wish.origin ? kMarginCells : 2 * kMarginCells;
  for (std::size_t a = 0; a < 3; ++a) {
    need.length[a] = body.high[a] - (wish.origin ? (*wish.origin)[a] : body.low[a]);
    if (wish.origin && !(need.length[a] > 0.0)) {
      throw CLI::ValidationError("--origin", exact((*wish.origin)[a]) + " along " + kAxes[a] +
                                                 " is beyond the body, which ends at " +
                                                 exact(body.high[a]));
    }
  }
  return need;
}

/// How many of the cells along an axis are left for the body.
double cells_inside(std::int64_t cells, std::int64_t margin) {
  if (cells <= margin) {
    throw CLI::ValidationError("--cells", "'" + std::to_string(cells) +
                                              "' is too few: " + std::to_string(margin) +
                                              " cells stay free beside the body");
  }
  return static_cast<double>(cells - margin);
}

/// So many cells as hold the length; one more for a length that only rounding makes longer would
/// break the symmetry of, say, a sphere.
std::int64_t cells_over(double length, double spacing, std::int64_t margin) {
  constexpr double kRounding = 1e-9;
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  const double cells = std::max(std::ceil(length / spacing - kRounding), 1.0);
  if (!(cells < kMost)) {
    throw CLI::ValidationError(
        "--spacing", "'" + exact(spacing) + "' is too small for a length of " + exact(length));
  }
  return static_cast<std::int64_t>(cells) + margin;
}

/// So that so many cells, the margin included, go over the length.
double spacing_over(double length, std::int64_t cells, std::int64_t margin) {
  const double spacing = length / cells_inside(cells, margin);
  if (!(spacing > 0.0)) {
    throw CLI::ValidationError("--cells", "the body is flat; --spacing is needed in its place");
  }
  return spacing;
}

Vec3 spacing_of(const Need& need, const GridWish& wish) {
  if (wish.spacing) {
    return *wish.spacing;
  }
  Vec3 spacing{};
  if (wish.cells) {
    const double longest = *std::max_element(need.length.begin(), need.length.end());
    spacing.fill(spacing_over(longest, *wish.cells, need.margin));
    return spacing;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    spacing[a] = spacing_over(need.length[a], (*wish.cells_by_axis)[a], need.margin);
  }
  return spacing;
}

}  // namespace

Grid grid_around(const Bounds& body, const GridWish& wish) {
  const Need need = need_of(body, wish);
  Grid grid;
  grid.spacing = spacing_of(need, wish);
  for (std::size_t a = 0; a < 3; ++a) {
    if (wish.cells_by_axis) {
      grid.dims[a] = (*wish.cells_by_axis)[a];
    } else {
      grid.dims[a] = cells_over(need.length[a], grid.spacing[a], need.margin);
    }
  }
  if (wish.origin) {
    grid.origin = *wish.origin;
    return grid;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const double half = 0.5 * static_cast<double>(grid.dims[a]) * grid.spacing[a];
    grid.origin[a] = std::midpoint(body.low[a], body.high[a]) - half;
  }
  return grid;
}

}  // namespace difmesh::cli
