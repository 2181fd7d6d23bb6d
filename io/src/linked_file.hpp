#pragma once
/// \file linked_file.hpp
/// Files that a file names: the data of an NRRD header, the buffers of a glTF file.
///
/// A file from a stranger must not read others: what it names must lie in its folder or below,
/// after symbolic links are resolved, and be named relative to it. Those who trust their files may
/// allow any place.

#include <filesystem>
#include <string>

#include "input_file.hpp"

namespace difmesh::detail {

/// Why a name cannot stand for a file in the folder or below, as "is absolute"; empty if it can.
/// Looks at the name only.
[[nodiscard]] std::string why_outside(const std::filesystem::path& name);

/// Opens the file that `path` names `name`. Where `outside` is not allowed the file is found
/// without following a symbolic link that came after the look at them.
/// \throw Error file_missing; file_format where it lies outside or is no regular file
[[nodiscard]] InputFile open_linked(const std::filesystem::path& path,
                                    const std::filesystem::path& name, bool outside);

}  // namespace difmesh::detail
