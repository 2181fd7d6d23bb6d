#pragma once
/// \file mesh_format.hpp
/// What formats of mesh files there are, and what each keeps of a mesh.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace difmesh {

/// Whether WriteMeshOptions::draco has a meaning.
enum class Compression : std::uint8_t {
  none,
  optional,  ///< where it is set
  always,
};

/// One row of the table of formats.
struct MeshFormat {
  std::string_view extension;  ///< with its dot, in small letters
  std::string_view name;       ///< for messages: "PLY"
  bool exact = false;          ///< positions and normals come back bit for bit
  bool normals = false;        ///< per vertex
  bool edge_ids = false;       ///< Mesh::edge_ids
  bool scalars = false;        ///< Mesh::scalars
  bool colors = false;         ///< WriteMeshOptions::color
  bool scene = false;          ///< the options of scenes in WriteMeshOptions
  bool streamed = false;       ///< MeshStream writes it
  Compression compression = Compression::none;
  std::string_view needs = {};  ///< what this build lacks for it: "glTF (DIFMESH_WITH_GLTF)"

  [[nodiscard]] constexpr bool is_available() const { return needs.empty(); }
};

/// All formats, those too that this build lacks. Valid until the program ends.
[[nodiscard]] std::span<const MeshFormat> mesh_formats() noexcept;

/// The format of an extension, in any case of letters, with its dot or without; nullptr if there is
/// none.
[[nodiscard]] const MeshFormat* find_mesh_format(std::string_view extension);
/// The format of a path's extension; nullptr if there is none.
[[nodiscard]] const MeshFormat* mesh_format_of(const std::filesystem::path& path);

}  // namespace difmesh
