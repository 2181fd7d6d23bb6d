#pragma once
// The field as the phases see it: cells of the whole grid by global index, of which a block with
// its ghost layers is in memory, and what stands beyond the sides of the domain.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "difmesh/block.hpp"
#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/options.hpp"

namespace difmesh::detail {

/// What a cell index outside the cells in memory stands for.
inline constexpr std::int64_t kMissing = std::numeric_limits<std::int64_t>::min();
inline constexpr std::int64_t kEmptyBeyond = kMissing + 1;
inline constexpr std::int64_t kFullBeyond = kMissing + 2;
/// True where resolve() found a cell in memory.
[[nodiscard]] constexpr bool is_cell(std::int64_t resolved) {
  return resolved > kFullBeyond;
}

/// One axis of the domain and of the cells in memory.
struct AxisCells {
  std::int64_t count = 0;  ///< cells of the whole grid
  std::int64_t low = 0;    ///< cells in memory: [low, high), in global indices
  std::int64_t high = 0;
  std::array<Side, 2> boundary{Side::open, Side::open};

  /// The cell in memory that stands for any global index, or one of the constants above.
  [[nodiscard]] std::int64_t resolve(std::int64_t index) const {
    while ((index < low || index >= high) && is_cell(index)) {
      index = beyond(index);
    }
    return index;
  }
  /// What stands for a cell beyond a side: one nearer to the domain, or one of the constants.
  [[nodiscard]] std::int64_t beyond(std::int64_t index) const {
    const bool below = index < 0;
    switch (boundary[below ? 0 : 1]) {
      case Side::open:
        return kMissing;
      case Side::empty:
        return kEmptyBeyond;
      case Side::full:
        break;
      case Side::mirror:
        return below ? -1 - index : 2 * count - 1 - index;
      case Side::periodic:
        return index + (below ? count : -count);
    }
    return kFullBeyond;
  }
};

/// Elements as fractions in [0,1]; what is no number counts as 0.
template <class T>
[[nodiscard]] inline double fraction_of(T value) {
  if constexpr (std::is_integral_v<T>) {
    return static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max());
  } else {
    const auto wide = static_cast<double>(value);
    return wide > 0.0 ? (wide < 1.0 ? wide : 1.0) : 0.0;
  }
}

/// Field, block, grid and sides of one reconstruction. \pre checked by make_block_field().
struct BlockField {
  Grid grid;
  Block block;
  Boundary boundary{};
  FieldView view;  ///< as given: its cell 0 is the first in memory
  std::array<AxisCells, 3> axes;
  double purity_tolerance = 0.0;
  bool is_stretched = false;  ///< some axis of the grid is not uniform

  /// Sizes of a cell by its global index, which may be beyond the sides: behind mirrors and
  /// periodic sides that of the cell that stands there, elsewhere that of the nearest one.
  [[nodiscard]] Vec3 cell_size(const Index3& cell) const {
    return is_stretched ? Vec3{width(0, cell[0]), width(1, cell[1]), width(2, cell[2])}
                        : grid.spacing;
  }
  [[nodiscard]] double width(std::size_t axis, std::int64_t index) const;

  /// True for the block's cells, which are no ghosts.
  [[nodiscard]] bool is_own(const Index3& cell) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t local = cell[axis] - block.offset[axis];
      if (local < 0 || local >= block.dims[axis]) {
        return false;
      }
    }
    return true;
  }
  [[nodiscard]] Side side(int axis, int high) const {
    return boundary[static_cast<std::size_t>(2 * axis + high)];
  }
  /// Element offset of a cell in memory from view.data.
  [[nodiscard]] std::int64_t element(const Index3& cell) const {
    return (cell[0] - axes[0].low) * view.strides[0] + (cell[1] - axes[1].low) * view.strides[1] +
           (cell[2] - axes[2].low) * view.strides[2];
  }
  /// Cells in memory between an index of an axis and the nearer end of what is there; negative
  /// beyond the ends.
  [[nodiscard]] std::int64_t margin(std::size_t axis, std::int64_t index) const {
    return std::min(index - axes[axis].low, axes[axis].high - 1 - index);
  }
  /// Fraction of a cell in memory, or beyond `empty` and `full` sides; `empty` wins where both
  /// meet. \pre no index is kMissing
  [[nodiscard]] double fraction(const Index3& resolved) const;
  /// True where 0 and 1 are further away than the tolerance.
  [[nodiscard]] bool is_interfacial(double fraction) const {
    return fraction > purity_tolerance && fraction < 1.0 - purity_tolerance;
  }
};

/// The grid with axes whose tables of faces are uniform but for rounding made uniform.
[[nodiscard]] Grid with_uniform_axes(const Grid& grid);
/// Checks that a field is there and has a known type. \throw Error
void check_view(const FieldView& field);
/// Checks block, grid and options against each other. \throw Error
void check_block(const Block& block, const Grid& grid, const Options& options);
/// Checks field, block, grid and options against each other. \throw Error
[[nodiscard]] BlockField make_block_field(const FieldView& field, const Block& block,
                                          const Grid& grid, const Options& options);

/// Calls body with a value of the C++ type of the elements.
template <class Body>
decltype(auto) with_scalar(ScalarType type, Body&& body) {
  switch (type) {
    case ScalarType::float32:
      return body(float{});
    case ScalarType::uint8:
      return body(std::uint8_t{});
    case ScalarType::uint16:
      return body(std::uint16_t{});
    case ScalarType::float64:
      break;
  }
  return body(double{});
}

}  // namespace difmesh::detail
