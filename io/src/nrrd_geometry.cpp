#include "nrrd_geometry.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "text.hpp"

namespace difmesh::detail {
namespace {

/// Off-axis parts of a direction below this share of it are rounding of some other program.
constexpr double kRotationTolerance = 1e-9;
/// Spacings given twice over may differ by the digits that a text was written with.
constexpr double kSpacingTolerance = 1e-5;

constexpr std::array<const char*, 3> kAxisNames{"x", "y", "z"};

void check_spacing(const std::filesystem::path& path, double spacing, std::size_t axis) {
  if (!(std::isfinite(spacing) && spacing > 0.0)) {
    fail_format(path, "the spacing along axis " + std::to_string(axis) + " is " + to_text(spacing) +
                          "; it must be finite and above 0");
  }
}

/// The axis of space along which a direction lies.
std::size_t axis_along(const std::filesystem::path& path, const Vec3& direction,
                       std::size_t file_axis) {
  const std::string shown = to_text(direction);
  std::size_t largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(direction[i])) {
      fail_format(path, "space direction " + shown + " of axis " + std::to_string(file_axis) +
                            " is not finite");
    }
    largest = std::abs(direction[i]) > std::abs(direction[largest]) ? i : largest;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (i != largest &&
        std::abs(direction[i]) > kRotationTolerance * std::abs(direction[largest])) {
      fail_format(path, "space direction " + shown + " of axis " + std::to_string(file_axis) +
                            " is rotated; a grid lies along the axes");
    }
  }
  check_spacing(path, std::abs(direction[largest]), file_axis);
  return largest;
}

/// Axes by `space directions`: sorts them into x, y, z and turns descending ones round. Gives the
/// centre of the first cell in ascending order.
std::optional<Vec3> place_by_directions(const std::filesystem::path& path, const NrrdHeader& header,
                                        FieldFile& field) {
  const Index3& n = header.sizes;
  const Index3 file_strides{1, n[0], n[0] * n[1]};
  std::optional<Vec3> centre = header.space_origin;
  std::array<bool, 3> taken{false, false, false};
  field.spacing.emplace();
  for (std::size_t file_axis = 0; file_axis < 3; ++file_axis) {
    const Vec3& direction = (*header.space_directions)[file_axis];
    const std::size_t axis = axis_along(path, direction, file_axis);
    if (taken[axis]) {
      fail_format(path, std::string("two space directions lie along ") + kAxisNames[axis]);
    }
    taken[axis] = true;
    field.dims[axis] = n[file_axis];
    field.strides[axis] = file_strides[file_axis];
    (*field.spacing)[axis] = std::abs(direction[axis]);
    if (direction[axis] < 0.0) {
      const std::int64_t last = n[file_axis] - 1;
      field.strides[axis] = -file_strides[file_axis];
      field.first += last * file_strides[file_axis];
      if (centre) {
        (*centre)[axis] += direction[axis] * static_cast<double>(last);
      }
    }
  }
  return centre;
}

/// Spacing by `axis mins` and `axis maxs`.
double spacing_between(const std::filesystem::path& path, const NrrdHeader& header,
                       std::size_t axis) {
  const std::int64_t steps = header.sizes[axis] - (header.node_centred[axis] ? 1 : 0);
  const double spacing =
      ((*header.axis_maxs)[axis] - (*header.axis_mins)[axis]) / static_cast<double>(steps);
  check_spacing(path, spacing, axis);
  return spacing;
}

void space_by_ranges(const std::filesystem::path& path, const NrrdHeader& header,
                     FieldFile& field) {
  field.spacing = header.spacings;
  if (header.axis_mins && header.axis_maxs) {
    Vec3 spacing{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      spacing[axis] = spacing_between(path, header, axis);
      const double given = header.spacings ? (*header.spacings)[axis] : spacing[axis];
      if (!(std::abs(given - spacing[axis]) <= kSpacingTolerance * spacing[axis])) {
        fail_format(path, "along axis " + std::to_string(axis) + " the spacing is " +
                              to_text(given) + ", but axis mins and maxs give " +
                              to_text(spacing[axis]));
      }
    }
    field.spacing = header.spacings ? header.spacings : std::optional<Vec3>(spacing);
  }
  for (std::size_t axis = 0; field.spacing && axis < 3; ++axis) {
    check_spacing(path, (*field.spacing)[axis], axis);
  }
}

/// The low corner of the first cell, from the centre of its first sample.
Vec3 low_corner(const NrrdHeader& header, const Vec3& centre, const Vec3& spacing) {
  Vec3 low{};
  bool kept = header.low_corner.has_value();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * spacing[axis];
    low[axis] = centre[axis] - half;
    // Unless the file was cropped or moved since, the key differs by rounding only.
    const double rounding = std::numeric_limits<double>::epsilon() * (std::abs(low[axis]) + half);
    kept = kept && std::abs((*header.low_corner)[axis] - low[axis]) <= rounding;
  }
  return kept ? *header.low_corner : low;
}

}  // namespace

void place(const std::filesystem::path& path, const NrrdHeader& header, FieldFile& field) {
  const Index3& n = header.sizes;
  field.dims = n;
  field.strides = {1, n[0], n[0] * n[1]};
  field.first = 0;
  std::optional<Vec3> centre = header.space_origin;
  if (header.space_directions) {
    if (header.spacings || header.axis_mins || header.axis_maxs) {
      fail_format(path, "'space directions' exclude 'spacings', 'axis mins' and 'axis maxs'");
    }
    centre = place_by_directions(path, header, field);
  } else {
    space_by_ranges(path, header, field);
  }
  const Vec3 spacing = field.spacing.value_or(Vec3{1.0, 1.0, 1.0});
  if (centre) {
    field.origin = low_corner(header, *centre, spacing);
  } else if (header.axis_mins) {
    field.origin = header.axis_mins;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      (*field.origin)[axis] -= header.node_centred[axis] ? 0.5 * spacing[axis] : 0.0;
    }
  }
  for (std::size_t axis = 0; field.origin && axis < 3; ++axis) {
    if (!std::isfinite((*field.origin)[axis])) {
      fail_format(path, std::string("the origin is not finite in ") + kAxisNames[axis]);
    }
  }
}

}  // namespace difmesh::detail
