#pragma once
/// \file value_cells.hpp
/// From the elements of a file to those of a field, and which axes of an array are the field's.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "difmesh/io/field_file.hpp"

namespace difmesh::detail {

/// Elements as a file has them, in its order, without gaps.
struct RawCells {
  ValueType type = ValueType::float64;
  bool big_endian = false;
  bool boolean = false;  ///< uint8 of which all but 0 are true, that is 1
  Array<std::byte> bytes;
};

/// Puts bytes in order and makes fractions of the values: sets `type`, `file_type` and `cells` of
/// `field`, and warns of integers whose values are too small to be meant as they are taken.
/// \throw Error invalid_argument, OutOfMemory
void set_cells(const std::filesystem::path& path, RawCells raw, const ReadFieldOptions& options,
               FieldFile& field);

/// \throw Error invalid_argument for options that contradict each other or are out of range
void check_options(const std::filesystem::path& path, const ReadFieldOptions& options);

/// Puts the origin and the spacing of the options in place of the file's.
void override_grid(const ReadFieldOptions& options, FieldFile& field);

/// Three axes of an array, ascending, so that all others have one element; nothing where there are
/// none, or where others would give another shape. Only those that `possible` marks count.
[[nodiscard]] std::optional<std::array<std::size_t, 3>> axes_of_field(
    std::span<const std::int64_t> sizes, const std::vector<bool>& possible);

}  // namespace difmesh::detail
