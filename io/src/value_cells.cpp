#include "value_cells.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "difmesh/error.hpp"
#include "elements.hpp"
#include "memory.hpp"
#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

bool is_scalar_type(ValueType type) {
  return type <= ValueType::uint16;
}

/// The raw elements as one long row.
ValueView row_of(const RawCells& raw) {
  const auto count = static_cast<std::int64_t>(raw.bytes.size()) / size_of(raw.type);
  return {raw.bytes.data(), raw.type, {count, 1, 1}, {1, count, count}};
}

void set_labels(const std::filesystem::path& path, const RawCells& raw,
                const ReadFieldOptions& options, FieldFile& field) {
  const ValueView values = row_of(raw);
  field.type = ScalarType::uint8;
  make_room(path, field.cells, values.dims[0]);
  fractions_from_labels(values, options.labels,
                        reinterpret_cast<std::uint8_t*>(field.cells.data()));
}

void set_fractions(const std::filesystem::path& path, const RawCells& raw, const ValueRange& range,
                   FieldFile& field) {
  const ValueView values = row_of(raw);
  const bool narrow = size_of(raw.type) <= 2 || raw.type == ValueType::float32;
  field.type = narrow ? ScalarType::float32 : ScalarType::float64;
  make_room(path, field.cells, values.dims[0] * size_of(field.type));
  if (narrow) {
    fractions_from_values(values, range, reinterpret_cast<float*>(field.cells.data()));
  } else {
    fractions_from_values(values, range, reinterpret_cast<double*>(field.cells.data()));
  }
}

void warn_of_scale(const std::filesystem::path& path, const RawCells& raw, FieldFile& field) {
  const std::string doubt = doubt_of_scale(row_of(raw));
  if (!doubt.empty()) {
    add_warning(field.warnings, path, doubt);
  }
}

}  // namespace

void set_cells(const std::filesystem::path& path, RawCells raw, const ReadFieldOptions& options,
               FieldFile& field) {
  if (raw.big_endian != kBigEndianHost) {
    swap_bytes(raw.bytes.data(), static_cast<std::int64_t>(raw.bytes.size()), size_of(raw.type));
  }
  const bool as_it_is = options.labels.empty() && !options.values;
  if (raw.boolean) {
    const std::byte full{as_it_is ? std::uint8_t{255} : std::uint8_t{1}};
    for (std::byte& cell : raw.bytes) {
      cell = cell == std::byte{0} ? std::byte{0} : full;
    }
  }
  field.file_type = raw.type;
  if (!options.labels.empty()) {
    set_labels(path, raw, options, field);
  } else if (options.values) {
    set_fractions(path, raw, *options.values, field);
  } else if (is_scalar_type(raw.type)) {
    field.type = static_cast<ScalarType>(raw.type);
    field.cells = std::move(raw.bytes);
  } else {
    warn_of_scale(path, raw, field);
    set_fractions(path, raw, {0.0, largest_value(raw.type), false}, field);
  }
}

void check_options(const std::filesystem::path& path, const ReadFieldOptions& options) {
  const auto fail = [&](const std::string& matter) {
    throw Error(ErrorCode::invalid_argument, "cannot read " + quoted(path) + ": " + matter);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (options.origin && !std::isfinite((*options.origin)[axis])) {
      fail("the origin " + to_text(*options.origin) + " is not finite");
    }
    const double spacing = options.spacing ? (*options.spacing)[axis] : 1.0;
    if (!(std::isfinite(spacing) && spacing > 0.0)) {
      fail("the spacing " + to_text(*options.spacing) + " must be finite and above 0");
    }
  }
  if (options.values && !options.labels.empty()) {
    fail("labels exclude a full value");
  }
  const ValueRange range = options.values.value_or(ValueRange{});
  if (!std::isfinite(range.full - range.empty) || range.full == range.empty) {
    fail("the empty value " + to_text(range.empty) + " and the full value " + to_text(range.full) +
         " must be finite and differ");
  }
}

void override_grid(const ReadFieldOptions& options, FieldFile& field) {
  field.origin = options.origin ? options.origin : field.origin;
  field.spacing = options.spacing ? options.spacing : field.spacing;
}

std::optional<std::array<std::size_t, 3>> axes_of_field(std::span<const std::int64_t> sizes,
                                                        const std::vector<bool>& possible) {
  std::vector<std::size_t> wide;  // these must be among the three
  std::vector<std::size_t> thin;
  for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
    if (sizes[axis] != 1) {
      wide.push_back(axis);
    }
    if (sizes[axis] != 1 && !possible[axis]) {
      return std::nullopt;
    }
    if (sizes[axis] == 1 && possible[axis]) {
      thin.push_back(axis);
    }
  }
  if (wide.size() > 3 || wide.size() + thin.size() < 3) {
    return std::nullopt;
  }
  std::optional<std::array<std::size_t, 3>> found;
  Index3 shape{};
  // All ways to take so many of the thin axes, those further back first.
  const std::size_t wanted = 3 - wide.size();
  for (std::uint32_t chosen = std::uint32_t{1} << thin.size(); chosen-- > 0;) {
    std::vector<std::size_t> axes = wide;
    for (std::size_t n = 0; n < thin.size(); ++n) {
      if ((chosen >> n & 1U) != 0) {
        axes.push_back(thin[n]);
      }
    }
    if (axes.size() != wide.size() + wanted) {
      continue;
    }
    std::sort(axes.begin(), axes.end());
    const Index3 this_shape{sizes[axes[0]], sizes[axes[1]], sizes[axes[2]]};
    if (!found) {
      found = {axes[0], axes[1], axes[2]};
      shape = this_shape;
    } else if (this_shape != shape) {
      return std::nullopt;
    }
  }
  return found;
}

}  // namespace difmesh::detail
