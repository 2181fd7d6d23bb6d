#pragma once
/// \file nrrd_geometry.hpp
/// From the axes of an NRRD header to the grid of a field.

#include <filesystem>

#include "difmesh/io/field_file.hpp"
#include "nrrd_header.hpp"

namespace difmesh::detail {

/// Sets dims, strides, first, origin and spacing of `field`, of the latter those that the options
/// do not give; what they replace is not judged.
/// \throw Error file_format if the axes are rotated, contradict each other or are not finite.
void place(const std::filesystem::path& path, const NrrdHeader& header,
           const ReadFieldOptions& options, FieldFile& field);

}  // namespace difmesh::detail
