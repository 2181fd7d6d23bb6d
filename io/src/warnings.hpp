#pragma once
/// \file warnings.hpp
/// What readers tell beside their result: no error, but a user must know.

#include <filesystem>
#include <string>
#include <vector>

namespace difmesh::detail {

/// Adds "'path': matter.", printable, unless it is there already. What exceeds 1000 bytes is cut
/// off.
void add_warning(std::vector<std::string>& warnings, const std::filesystem::path& path,
                 const std::string& matter);

}  // namespace difmesh::detail
