#pragma once
/// \file drc.hpp

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "difmesh/io/mesh_reading.hpp"

namespace difmesh::detail {

/// The mesh in the bytes of a .drc file. \throw Error file_format; `path` is for messages
[[nodiscard]] MeshFile decode_drc(const std::filesystem::path& path, std::span<const char> bytes);

/// Whole numbers from `count` digits each to the base 65536, lowest first.
/// \throw Error file_format if a digit is none
[[nodiscard]] Array<std::uint64_t> joined_digits(const std::filesystem::path& path,
                                                 const Array<double>& digits, std::size_t count);

}  // namespace difmesh::detail
