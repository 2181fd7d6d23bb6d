#pragma once
/// \file nrrd_axes.hpp
/// The axes of an NRRD header, of which three are those of the field.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nrrd_header.hpp"

namespace difmesh::detail {

/// A header field that has a word for each axis, and where it stands.
struct NrrdAxisField {
  std::string name;  ///< as the file has it
  std::int64_t line = 0;
  std::vector<std::string_view> words;
};

/// What the header says of all axes.
struct NrrdAxes {
  std::int64_t dimension = 0;
  /// sizes, spacings, axismins, axismaxs, centers and kinds
  std::map<std::string, NrrdAxisField, std::less<>> fields;
  std::vector<std::optional<Vec3>> directions;  ///< none for axes that are not in space
  std::int64_t directions_line = 0;             ///< 0: there are no directions
  /// Of the data in each of several files; 0 where the header does not tell.
  std::optional<std::int64_t> file_dimension;
};

/// Sets what the header says of the three axes of the field, and holds the number of data files
/// against the sizes. \throw Error file_format, naming the line
void set_axes(const std::filesystem::path& path, const NrrdAxes& axes, NrrdHeader& header);

}  // namespace difmesh::detail
