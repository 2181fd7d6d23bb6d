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

void validate_faces(const Grid& grid, int axis) {
  const std::vector<double>& faces = grid.faces[static_cast<std::size_t>(axis)];
  const auto fail = [axis](std::size_t n, const std::string& what) {
    throw Error(ErrorCode::invalid_grid,
                "faces in " + axis_name(axis) + ": number " + std::to_string(n) + " " + what);
  };
  const auto cells = static_cast<std::size_t>(grid.dims[static_cast<std::size_t>(axis)]);
  if (faces.size() != cells + 1) {
    throw Error(ErrorCode::invalid_grid, "faces in " + axis_name(axis) + ": " +
                                             std::to_string(faces.size()) + " for " +
                                             std::to_string(cells) + " cells, which have one more");
  }
  double largest = 0.0;
  for (std::size_t n = 0; n < faces.size(); ++n) {
    if (!std::isfinite(faces[n])) {
      fail(n, "is not finite");
    }
    largest = std::max(largest, std::abs(faces[n]));
  }
  for (std::size_t n = 1; n < faces.size(); ++n) {
    const double width = faces[n] - faces[n - 1];
    if (!(width > 0.0)) {
      fail(n, "is not greater than the one before");
    }
    if (width < kLeastSpacing || width > kGreatestSpacing) {
      fail(n, "is " + detail::rounded_text(width) +
                  " from the one before; 2^-300 to 2^300 are possible");
    }
    if (width < largest * 0x1p-40) {
      fail(n, "is " + detail::rounded_text(width) +
                  " from the one before, too little against coordinates of " +
                  detail::rounded_text(largest) +
                  ": cells could not be told apart in double precision");
    }
  }
}

void validate_axis(const Grid& grid, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  if (grid.dims[a] < 1 || grid.dims[a] > kMaxDim) {
    throw Error(ErrorCode::invalid_grid, "dims: " + std::to_string(grid.dims[a]) + " cells in " +
                                             axis_name(axis) + "; 1 to 2^31 - 3 are possible");
  }
  if (!grid.is_uniform(a)) {
    validate_faces(grid, axis);
    return;
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

double Grid::width(std::size_t axis, std::int64_t index) const noexcept {
  if (is_uniform(axis)) {
    return spacing[axis];
  }
  const auto n = static_cast<std::size_t>(std::clamp<std::int64_t>(index, 0, dims[axis] - 1));
  return faces[axis][n + 1] - faces[axis][n];
}

double Grid::least_width(std::size_t axis) const noexcept {
  double least = width(axis, 0);
  for (std::size_t n = 1; n < faces[axis].size(); ++n) {
    least = std::min(least, faces[axis][n] - faces[axis][n - 1]);
  }
  return least;
}

Vec3 Grid::cell_centre(const Index3& cell) const noexcept {
  Vec3 centre;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!is_uniform(a)) {
      const std::int64_t near = std::clamp<std::int64_t>(cell[a], 0, dims[a] - 1);
      const auto n = static_cast<std::size_t>(near);
      centre[a] =
          faces[a][n] + 0.5 * width(a, near) + static_cast<double>(cell[a] - near) * width(a, near);
      continue;
    }
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

void require_uniform(const Grid& grid, const char* what) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!grid.is_uniform(static_cast<std::size_t>(axis))) {
      throw Error(ErrorCode::unsupported, std::string(what) + ": the grid is stretched in " +
                                              axis_name(axis) + "; uniform axes are needed");
    }
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
