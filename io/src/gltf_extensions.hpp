#pragma once
/// \file gltf_extensions.hpp
/// What extensions of glTF mean to a reader of surfaces.

#include <string_view>

namespace difmesh::detail {

enum class ExtensionKind : unsigned char {
  known,     ///< read, or looked for where it stands
  harmless,  ///< leaves surfaces where and as they are: materials, textures, lights, metadata
  unknown,   ///< may change what there is to see
};

[[nodiscard]] ExtensionKind kind_of_extension(std::string_view name);

/// Whether a file that requires the extension can be read.
[[nodiscard]] bool can_be_required(std::string_view name);

}  // namespace difmesh::detail
