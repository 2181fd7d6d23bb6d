#pragma once
/// \file gltf_write.hpp

#include <cstdint>
#include <filesystem>

namespace difmesh::detail {

/// The size of a .glb file whose JSON and data have so many bytes, padding and headers included.
/// \throw Error too_large beyond what its 32-bit lengths can say
[[nodiscard]] std::uint64_t glb_size(const std::filesystem::path& path, std::uint64_t json_bytes,
                                     std::uint64_t data_bytes);

}  // namespace difmesh::detail
