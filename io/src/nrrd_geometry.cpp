#include "nrrd_geometry.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "text.hpp"
#include "value_cells.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

/// Off-axis parts of a direction up to this share of it are rounding of some other program.
constexpr double kRotationTolerance = 1e-6;
/// Spacings given twice over may differ by the digits that a text was written with.
constexpr double kSpacingTolerance = 1e-5;

constexpr std::array<const char*, 3> kAxisNames{"x", "y", "z"};

bool is_spacing(double spacing) {
  return std::isfinite(spacing) && spacing > 0.0;
}

/// Why a spacing cannot be used; empty if it can.
std::string spacing_problem(double spacing, std::size_t axis) {
  return is_spacing(spacing) ? ""
                             : "the spacing along axis " + std::to_string(axis) + " is " +
                                   to_text(spacing) + "; it must be finite and above 0";
}

/// The axes of the file by their direction in space.
struct AxisOrder {
  std::array<std::size_t, 3> axis{0, 1, 2};
  std::array<bool, 3> descends{false, false, false};
  std::string problem;  ///< why there is none; empty if there is
};

std::size_t largest_part(const Vec3& direction) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    largest = std::abs(direction[i]) > std::abs(direction[largest]) ? i : largest;
  }
  return largest;
}

/// Why a direction is none along an axis; empty if it is one.
std::string direction_problem(const Vec3& direction, std::size_t file_axis) {
  const std::string shown =
      "space direction " + to_text(direction) + " of axis " + std::to_string(file_axis);
  for (const double part : direction) {
    if (!std::isfinite(part)) {
      return shown + " is not finite";
    }
  }
  const std::size_t largest = largest_part(direction);
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != largest &&
        std::abs(direction[i]) > kRotationTolerance * std::abs(direction[largest])) {
      return shown + " is rotated; a grid lies along the axes";
    }
  }
  return spacing_problem(std::abs(direction[largest]), file_axis);
}

AxisOrder order_of(const std::array<Vec3, 3>& directions) {
  AxisOrder order;
  std::array<bool, 3> taken{false, false, false};
  for (std::size_t file_axis = 0; file_axis < 3 && order.problem.empty(); ++file_axis) {
    const Vec3& direction = directions[file_axis];
    order.problem = direction_problem(direction, file_axis);
    const std::size_t axis = largest_part(direction);
    if (order.problem.empty() && taken[axis]) {
      order.problem = std::string("two space directions lie along ") + kAxisNames[axis];
    }
    taken[axis] = true;
    order.axis[file_axis] = axis;
    order.descends[file_axis] = direction[axis] < 0.0;
  }
  return order;
}

class Placer {
 public:
  Placer(const std::filesystem::path& path, const NrrdHeader& header,
         const ReadFieldOptions& options, FieldFile& field)
      : path_(path), header_(header), options_(options), field_(field) {}

  void place() {
    const Index3& n = header_.sizes;
    field_.dims = n;
    field_.strides = {1, n[0], n[0] * n[1]};
    field_.first = 0;
    std::optional<Vec3> centre = header_.space_origin;
    if (header_.space_directions) {
      centre = by_directions();
    } else {
      by_ranges();
    }
    if (!options_.origin) {
      set_origin(centre);
    }
    override_grid(options_, field_);
  }

 private:
  /// Sorts the axes into x, y, z and turns descending ones round. Gives the centre of the first
  /// cell in ascending order.
  std::optional<Vec3> by_directions() {
    if (!options_.spacing && (header_.spacings || header_.axis_mins || header_.axis_maxs)) {
      fail_format(path_, "'space directions' exclude 'spacings', 'axis mins' and 'axis maxs'");
    }
    const AxisOrder order = order_of(*header_.space_directions);
    if (!order.problem.empty()) {
      do_without_order(order.problem);
      return std::nullopt;
    }
    const Index3 file_strides = field_.strides;
    std::optional<Vec3> centre = header_.space_origin;
    field_.spacing.emplace();
    for (std::size_t file_axis = 0; file_axis < 3; ++file_axis) {
      const std::size_t axis = order.axis[file_axis];
      const double step = (*header_.space_directions)[file_axis][axis];
      field_.dims[axis] = header_.sizes[file_axis];
      field_.strides[axis] = file_strides[file_axis];
      (*field_.spacing)[axis] = std::abs(step);
      if (order.descends[file_axis]) {
        const std::int64_t last = header_.sizes[file_axis] - 1;
        field_.strides[axis] = -file_strides[file_axis];
        field_.first += last * file_strides[file_axis];
        if (centre) {
          (*centre)[axis] += step * static_cast<double>(last);
        }
      }
    }
    return centre;
  }

  /// With spacing and origin from elsewhere the directions would tell no more than the order.
  void do_without_order(const std::string& problem) {
    if (!options_.spacing || (header_.space_origin && !options_.origin)) {
      fail_format(path_,
                  problem + "; with a spacing and an origin given, its axes are taken as x, y, z");
    }
    add_warning(field_.warnings, path_, problem + "; its axes are taken as x, y, z");
  }

  /// Spacing by `axis mins` and `axis maxs`.
  [[nodiscard]] double spacing_between(std::size_t axis) const {
    const std::int64_t steps = header_.sizes[axis] - (header_.node_centred[axis] ? 1 : 0);
    return ((*header_.axis_maxs)[axis] - (*header_.axis_mins)[axis]) / static_cast<double>(steps);
  }

  void by_ranges() {
    field_.spacing = header_.spacings;
    if (!field_.spacing && header_.axis_mins && header_.axis_maxs) {
      field_.spacing = {spacing_between(0), spacing_between(1), spacing_between(2)};
    }
    for (std::size_t axis = 0; !options_.spacing && field_.spacing && axis < 3; ++axis) {
      check_spacing(axis);
    }
  }

  void check_spacing(std::size_t axis) const {
    const double given = (*field_.spacing)[axis];
    std::string problem = spacing_problem(given, axis);
    if (problem.empty() && header_.axis_mins && header_.axis_maxs) {
      const double between = spacing_between(axis);
      problem = spacing_problem(between, axis);
      if (problem.empty() && !(std::abs(given - between) <= kSpacingTolerance * between)) {
        problem = "along axis " + std::to_string(axis) + " the spacing is " + to_text(given) +
                  ", but axis mins and maxs give " + to_text(between);
      }
    }
    if (!problem.empty()) {
      fail_format(path_, problem);
    }
  }

  /// The file's, or where it has none that can be used the user's, or 1.
  [[nodiscard]] double spacing_along(std::size_t axis) const {
    if (field_.spacing && is_spacing((*field_.spacing)[axis])) {
      return (*field_.spacing)[axis];
    }
    return options_.spacing ? (*options_.spacing)[axis] : 1.0;
  }

  /// From the centre of the first cell, or from `axis mins`.
  void set_origin(const std::optional<Vec3>& centre) {
    if (centre) {
      field_.origin = low_corner(*centre);
    } else if (header_.axis_mins && !header_.space_directions) {
      field_.origin = header_.axis_mins;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        (*field_.origin)[axis] -= header_.node_centred[axis] ? 0.5 * spacing_along(axis) : 0.0;
      }
    }
    for (std::size_t axis = 0; field_.origin && axis < 3; ++axis) {
      if (!std::isfinite((*field_.origin)[axis])) {
        fail_format(path_, std::string("the origin is not finite in ") + kAxisNames[axis]);
      }
    }
  }

  /// The low corner of the first cell, from the centre of its first sample.
  [[nodiscard]] Vec3 low_corner(const Vec3& centre) const {
    Vec3 low{};
    bool kept = header_.low_corner.has_value();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double half = 0.5 * spacing_along(axis);
      low[axis] = centre[axis] - half;
      // Unless the file was cropped or moved since, the key differs by rounding only.
      const double rounding = std::numeric_limits<double>::epsilon() * (std::abs(low[axis]) + half);
      kept = kept && std::abs((*header_.low_corner)[axis] - low[axis]) <= rounding;
    }
    return kept ? *header_.low_corner : low;
  }

  const std::filesystem::path& path_;
  const NrrdHeader& header_;
  const ReadFieldOptions& options_;
  FieldFile& field_;
};

}  // namespace

void place(const std::filesystem::path& path, const NrrdHeader& header,
           const ReadFieldOptions& options, FieldFile& field) {
  Placer(path, header, options, field).place();
}

}  // namespace difmesh::detail
