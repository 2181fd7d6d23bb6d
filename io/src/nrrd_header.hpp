#pragma once
/// \file nrrd_header.hpp
/// The header of an NRRD file. Source: G. Kindlmann, "Definition of NRRD File Format", Teem.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/values.hpp"
#include "input_file.hpp"

namespace difmesh::detail {

enum class NrrdEncoding : std::uint8_t { raw, gzip, ascii };

/// Key under which our files keep the low corner of the grid beside the centre of the first sample:
/// the half spacing between them rounds. Other readers ignore it.
inline constexpr std::string_view kLowCornerKey = "difmesh_low_corner";

/// What the header says of the three axes of the field, in the order of the file, checked for form
/// but not for sense.
struct NrrdHeader {
  ValueType type = ValueType::float64;
  Index3 sizes{0, 0, 0};
  std::optional<Vec3> spacings;
  std::optional<Vec3> axis_mins;
  std::optional<Vec3> axis_maxs;
  std::array<bool, 3> node_centred{false, false, false};
  std::optional<std::array<Vec3, 3>> space_directions;
  std::optional<Vec3> space_origin;
  std::optional<Vec3> low_corner;  ///< see kLowCornerKey
  NrrdEncoding encoding = NrrdEncoding::raw;
  std::optional<bool> big_endian;
  std::int64_t line_skip = 0;
  std::int64_t byte_skip = 0;  ///< -1: the data are the end of the file, or of what it inflates to
  /// Each with as much of the data as the others; empty if the data follow the header.
  std::vector<std::string> data_files;
  std::int64_t data_offset = 0;  ///< where they do
};

/// \throw Error file_format, naming the line or the field.
[[nodiscard]] NrrdHeader read_nrrd_header(const InputFile& file);

}  // namespace difmesh::detail
