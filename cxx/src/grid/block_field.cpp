#include "grid/block_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/position_text.hpp"
#include "difmesh/error.hpp"
#include "difmesh/names.hpp"

namespace difmesh::detail {
namespace {

constexpr char kAxisNames[] = "xyz";

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, message);
}

void require_range(double value, double low, double high, const std::string& name) {
  if (!(value >= low && value <= high)) {
    fail("options: " + name + " is " + rounded_text(value) + "; possible is " + rounded_text(low) +
         " to " + rounded_text(high));
  }
}

void check_options(const Options& options) {
  require_range(options.purity_tolerance, 0.0, 0.1, "purity_tolerance");
  require_range(options.overshoot_bound, 0.0, 1.0, "overshoot_bound");
  if (!(options.clearance >= 1e-13 && options.clearance <= 0.25)) {
    fail("options: clearance must be 1e-13 to 0.25");
  }
  if (options.threads < 0) {
    fail("options: threads must not be negative, got " + std::to_string(options.threads));
  }
  if (name_of(kPlacements, options.placement).empty() ||
      name_of(kNormals, options.normals).empty()) {
    fail("options: unknown placement or normals");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Side low = options.boundary[2 * axis];
    const Side high = options.boundary[2 * axis + 1];
    if (name_of(kSides, low).empty() || name_of(kSides, high).empty()) {
      fail("options: unknown side");
    }
    if ((low == Side::periodic) != (high == Side::periodic)) {
      fail(std::string("options: boundary in ") + kAxisNames[axis] +
           ": periodic needs both sides of the axis");
    }
  }
}

// Ghost layers must reach as far as the stencils do, or to the end of the domain.
AxisCells check_axis(std::size_t axis, const Block& block, const Grid& grid,
                     const Options& options) {
  const Boundary& boundary = options.boundary;
  const std::int64_t count = grid.dims[axis];
  const std::int64_t offset = block.offset[axis];
  const std::int64_t dims = block.dims[axis];
  const std::int64_t low = block.ghost_low[axis];
  const std::int64_t high = block.ghost_high[axis];
  const std::string where = std::string("block: in ") + kAxisNames[axis];
  if (dims < 1 || offset < 0 || dims > count || offset > count - dims) {
    fail(where + ": cells " + std::to_string(offset) + " to " + std::to_string(offset) + " + " +
         std::to_string(dims) + " are not inside the grid's " + std::to_string(count));
  }
  const bool periodic = boundary[2 * axis] == Side::periodic;
  const bool whole = dims == count && low == 0 && high == 0;
  const std::int64_t layers = ghost_layers(options.placement);
  const std::int64_t below = periodic && !whole ? layers : std::min(layers, offset);
  const std::int64_t above = periodic && !whole ? layers : std::min(layers, count - offset - dims);
  if (low < below || high < above) {
    fail(where + ": " + std::to_string(low) + " and " + std::to_string(high) +
         " ghost layers are given; " + std::to_string(below) + " and " + std::to_string(above) +
         " are needed");
  }
  // Sums of cells and ghosts stay far from the ends of 64 bits.
  constexpr std::int64_t kMostGhosts = std::int64_t{1} << 60;
  if (periodic && (low > kMostGhosts || high > kMostGhosts)) {
    fail(where + ": more than 2^60 ghost layers");
  }
  if (!periodic && (low > offset || high > count - offset - dims)) {
    fail(where + ": ghost layers reach beyond the grid");
  }
  return {count, offset - low, offset + dims + high, {boundary[2 * axis], boundary[2 * axis + 1]}};
}

}  // namespace

double BlockField::fraction(const Index3& resolved) const {
  bool full = false;
  for (const std::int64_t index : resolved) {
    if (index == kEmptyBeyond) {
      return 0.0;
    }
    full = full || index == kFullBeyond;
  }
  if (full) {
    return 1.0;
  }
  return with_scalar(view.type, [&](auto type) {
    using T = decltype(type);
    return fraction_of(static_cast<const T*>(view.data)[element(resolved)]);
  });
}

Grid with_uniform_axes(const Grid& grid) {
  constexpr double kRounding = 1e-15;  // of the largest coordinate: some units in the last place
  Grid result = grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& faces = grid.faces[axis];
    if (faces.empty()) {
      continue;
    }
    const double spacing = (faces.back() - faces.front()) / static_cast<double>(grid.dims[axis]);
    const double largest = std::max(std::abs(faces.front()), std::abs(faces.back()));
    bool is_uniform = true;
    for (std::size_t n = 0; n < faces.size(); ++n) {
      const double at = faces.front() + static_cast<double>(n) * spacing;
      is_uniform = is_uniform && std::abs(faces[n] - at) <= kRounding * (largest + spacing);
    }
    if (is_uniform) {
      result.origin[axis] = faces.front();
      result.spacing[axis] = spacing;
      result.faces[axis].clear();
    }
  }
  return result;
}

void check_view(const FieldView& field) {
  if (field.data == nullptr) {
    fail("field: no data");
  }
  if (field.type > ScalarType::uint16) {
    fail("field: unknown element type");
  }
}

void check_block(const Block& block, const Grid& grid, const Options& options) {
  validate(grid);
  check_options(options);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    (void)check_axis(axis, block, grid, options);
  }
}

double BlockField::width(std::size_t axis, std::int64_t index) const {
  const AxisCells& cells = axes[axis];
  while (index < 0 || index >= cells.count) {
    const std::int64_t nearer = cells.beyond(index);
    if (!is_cell(nearer)) {
      break;
    }
    index = nearer;
  }
  return grid.width(axis, index);
}

BlockField make_block_field(const FieldView& field, const Block& block, const Grid& grid,
                            const Options& options) {
  validate(grid);
  check_options(options);
  check_view(field);
  BlockField result;
  result.grid = with_uniform_axes(grid);
  result.is_stretched = !result.grid.is_uniform();
  result.block = block;
  result.boundary = options.boundary;
  result.view = field;
  result.purity_tolerance = options.purity_tolerance;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.axes[axis] = check_axis(axis, block, grid, options);
    const std::int64_t in_memory = result.axes[axis].high - result.axes[axis].low;
    if (field.dims[axis] != in_memory) {
      fail(std::string("field: ") + std::to_string(field.dims[axis]) + " cells in " +
           kAxisNames[axis] + " where the grid or block has " + std::to_string(in_memory));
    }
  }
  return result;
}

}  // namespace difmesh::detail
