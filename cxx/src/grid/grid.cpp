#include "difmesh/grid.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/position_text.hpp"
#include "difmesh/error.hpp"
#include "difmesh/field_view.hpp"

namespace difmesh {
namespace {

constexpr char kAxisNames[] = "xyz";
constexpr std::int64_t kMaxDim = (std::int64_t{1} << 31) - 3;
// Volumes of cells, and quotients of spacings, are far from the ends of float64's range.
constexpr double kLeastSpacing = 0x1p-300;
constexpr double kGreatestSpacing = 0x1p300;
// Three edges start at each node, and ids are kept below 2^63.
constexpr std::int64_t kMaxNodes = (std::int64_t{1} << 61);

std::string axis_name(int axis) {
  return {kAxisNames[axis]};
}

void validate_axis(const Grid& grid, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  if (grid.dims[a] < 1 || grid.dims[a] > kMaxDim) {
    throw Error(ErrorCode::invalid_grid, "dims: " + std::to_string(grid.dims[a]) + " cells in " +
                                             axis_name(axis) + "; 1 to 2^31 - 3 are possible");
  }
  const double spacing = grid.spacing[a];
  if (!std::isfinite(spacing) || spacing <= 0.0) {
    throw Error(ErrorCode::invalid_grid, "spacing in " + axis_name(axis) + " is " +
                                             detail::rounded_text(spacing) +
                                             "; it must be finite and greater than 0");
  }
  if (spacing < kLeastSpacing || spacing > kGreatestSpacing) {
    throw Error(ErrorCode::invalid_grid, "spacing in " + axis_name(axis) + " is " +
                                             detail::rounded_text(spacing) +
                                             "; 2^-300 to 2^300 are possible");
  }
  if (!std::isfinite(grid.origin[a])) {
    throw Error(ErrorCode::invalid_grid, "origin in " + axis_name(axis) + " is not finite");
  }
  const double extent = spacing * static_cast<double>(grid.dims[a]);
  const double largest = std::max(std::abs(grid.origin[a]), std::abs(grid.origin[a] + extent));
  if (!std::isfinite(extent) || !std::isfinite(largest) || spacing < largest * 0x1p-40) {
    throw Error(ErrorCode::invalid_grid,
                "spacing in " + axis_name(axis) + " is " + detail::rounded_text(spacing) +
                    ", too small against coordinates of " + detail::rounded_text(largest) +
                    ": cells could not be told apart in double precision");
  }
}

}  // namespace

Vec3 Grid::cell_centre(const Index3& cell) const noexcept {
  Vec3 centre;
  for (std::size_t a = 0; a < 3; ++a) {
    centre[a] = origin[a] + (static_cast<double>(cell[a]) + 0.5) * spacing[a];
  }
  return centre;
}

void validate(const Grid& grid) {
  for (int axis = 0; axis < 3; ++axis) {
    validate_axis(grid, axis);
  }
  std::int64_t nodes = 1;
  for (const std::int64_t dim : grid.dims) {
    if (nodes > kMaxNodes / (dim + 2)) {
      throw Error(ErrorCode::too_large,
                  "dims: " + std::to_string(grid.dims[0]) + " x " + std::to_string(grid.dims[1]) +
                      " x " + std::to_string(grid.dims[2]) + " cells are more than 2^61");
    }
    nodes *= dim + 2;
  }
}

FieldView FieldView::sub(const Index3& low, const Index3& size) const {
  std::int64_t shift = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (low[a] < 0 || size[a] < 0 || low[a] > dims[a] - size[a]) {
      throw Error(ErrorCode::invalid_argument,
                  "sub-view: cells " + std::to_string(low[a]) + " to " +
                      std::to_string(low[a] + size[a]) + " in " + axis_name(static_cast<int>(a)) +
                      " are not inside the field's " + std::to_string(dims[a]));
    }
    shift += low[a] * strides[a];
  }
  return {static_cast<const char*>(data) + shift * size_of(type), type, size, strides};
}

}  // namespace difmesh
