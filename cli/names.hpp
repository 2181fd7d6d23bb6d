#pragma once
/// \file names.hpp
/// The ranges of options, and the extensions of files, that the command line speaks of. Words of
/// choices: difmesh/names.hpp and difmesh/io/names.hpp.

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/io/mesh_format.hpp"
#include "difmesh/io/names.hpp"
#include "difmesh/names.hpp"

namespace difmesh::cli {

/// Both ends belong to it.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// What the library takes; see options.hpp and mollify.hpp.
inline constexpr Range kPurityToleranceRange{0.0, 0.1};
inline constexpr Range kOvershootBoundRange{0.0, 1.0};
inline constexpr Range kClearanceRange{1e-13, 0.25};
inline constexpr Range kMollifyRange{1.0, 8.0};

/// Extensions that the field files of difmesh::io have, in lower case.
inline constexpr std::array<std::string_view, 3> kFieldExtensions{".npy", ".nrrd", ".nhdr"};

/// Whether a path has one of these extensions, in any case of letters.
[[nodiscard]] bool has_extension(const std::string& path,
                                 std::span<const std::string_view> extensions);
/// The words with commas between.
[[nodiscard]] std::string joined(std::span<const std::string_view> words);

/// Whether the extension is that of a mesh.
[[nodiscard]] bool is_mesh_file(const std::string& path);
/// Tells one thing of a format.
using HasFormat = bool (*)(const MeshFormat& format);
/// The extensions of all formats of meshes, or of those that have something.
[[nodiscard]] std::vector<std::string_view> mesh_extensions(HasFormat has = nullptr);
/// ".ply, .obj, .off": the same, joined.
[[nodiscard]] std::string mesh_extensions_text(HasFormat has = nullptr);

}  // namespace difmesh::cli
