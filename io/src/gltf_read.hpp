#pragma once
/// \file gltf_read.hpp

#include <filesystem>

#include "difmesh/io/mesh_reading.hpp"

namespace difmesh::detail {

[[nodiscard]] MeshFile read_gltf(const std::filesystem::path& path, const ReadMeshOptions& options);

/// The same of bytes; no other files are opened. `path` is for messages.
[[nodiscard]] MeshFile decode_gltf(const std::filesystem::path& path, Array<char> bytes);

}  // namespace difmesh::detail
