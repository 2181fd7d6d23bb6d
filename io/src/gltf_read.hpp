#pragma once
/// \file gltf_read.hpp

#include <filesystem>

#include "difmesh/io/vertex_scalars.hpp"

namespace difmesh::detail {

/// read_gltf() of bytes; no other files are opened. `path` is for messages.
[[nodiscard]] ScalarMesh decode_gltf(const std::filesystem::path& path, Array<char> bytes);

}  // namespace difmesh::detail
