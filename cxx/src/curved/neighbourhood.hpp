#pragma once
// The cells around one with their fractions, sizes and places.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "curved/axis_averages.hpp"
#include "grid/block_field.hpp"
#include "planes/cells_around.hpp"

namespace difmesh::detail {

/// Cells on each side of the middle one in a column of heights: for positions, and for curvature.
inline constexpr std::int64_t kPositionReach = 5;
inline constexpr std::int64_t kCurvatureReach = 6;

/// The unit of local_surface.hpp: the cube root of a cell's volume.
[[nodiscard]] inline double unit_length(const Vec3& size) {
  return std::cbrt(size[0]) * std::cbrt(size[1]) * std::cbrt(size[2]);
}
[[nodiscard]] inline double unit_length(const BlockField& field, const Index3& cell) {
  return unit_length(field.cell_size(cell));
}

/// Fractions, sizes and centres. Along each axis lengths are counted in widths of the middle cell;
/// size() gives these in the unit of local_surface.hpp.
class Neighbourhood : public CellsAround<kCurvatureReach> {
 public:
  /// \param reach of columns; cells further away are not looked at
  Neighbourhood(const BlockField& field, const Index3& cell, std::int64_t reach)
      : CellsAround(field, cell, reach), purity_tolerance_(field.purity_tolerance) {
    const Vec3 own = field.cell_size(cell);
    const double length = unit_length(own);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size_[axis] = own[axis] / length;
      is_uniform_[axis] = field.grid.is_uniform(axis);
      set_axis(field, axis, cell[axis], own[axis]);
      if (!is_uniform_[axis]) {
        averages_[axis] = stretched_averages(axis);
      }
    }
  }

  [[nodiscard]] double purity_tolerance() const { return purity_tolerance_; }
  [[nodiscard]] const Vec3& size() const { return size_; }
  [[nodiscard]] double width(std::size_t axis, std::int64_t step) const {
    return widths_[axis][static_cast<std::size_t>(step + kCurvatureReach)];
  }
  [[nodiscard]] double centre(std::size_t axis, std::int64_t step) const {
    return centres_[axis][static_cast<std::size_t>(step + kCurvatureReach)];
  }
  /// Those of the cells across columns, for polynomials along the axis.
  [[nodiscard]] const AxisAverages& averages(std::size_t axis) const {
    return is_uniform_[axis] ? AxisAverages::uniform() : *averages_[axis];
  }

 private:
  static constexpr std::size_t kCells = 2 * kCurvatureReach + 1;

  void set_axis(const BlockField& field, std::size_t axis, std::int64_t index, double own) {
    constexpr std::int64_t kReach = kCurvatureReach;
    const auto at = [](std::int64_t step) { return static_cast<std::size_t>(step + kReach); };
    auto& widths = widths_[axis];
    auto& centres = centres_[axis];
    for (std::int64_t step = -kReach; step <= kReach; ++step) {
      widths[at(step)] = is_uniform_[axis] ? 1.0 : field.width(axis, index + step) / own;
    }
    centres[at(0)] = 0.0;
    for (std::int64_t step = 1; step <= kReach; ++step) {
      centres[at(step)] = centres[at(step - 1)] + 0.5 * (widths[at(step - 1)] + widths[at(step)]);
      centres[at(-step)] = centres[at(1 - step)] - 0.5 * (widths[at(1 - step)] + widths[at(-step)]);
    }
  }

  [[nodiscard]] AxisAverages stretched_averages(std::size_t axis) const {
    std::array<double, kAcross> centres;
    std::array<double, kAcross> widths;
    for (std::size_t n = 0; n < kAcross; ++n) {
      const std::int64_t step = static_cast<std::int64_t>(n) - kAcrossReach;
      centres[n] = centre(axis, step);
      widths[n] = width(axis, step);
    }
    return {centres, widths};
  }

  double purity_tolerance_;
  Vec3 size_{};
  std::array<bool, 3> is_uniform_{};
  std::array<std::array<double, kCells>, 3> widths_;
  std::array<std::array<double, kCells>, 3> centres_;
  std::array<std::optional<AxisAverages>, 3> averages_;
};

}  // namespace difmesh::detail
