#pragma once
/// \file format_part.hpp
/// What a format of meshes consists of. To add one: a file that defines its FormatPart, constinit
/// and const, and a line in format_list.hpp.
///
/// Why our own and not OpenMesh's: OpenMesh 9.0 passes every position and normal through float32.
/// Its readers and writers of PLY, OBJ and OFF, binary and text, with a mesh of float64 points and
/// 17 digits asked for, give back 0.1 as 0.10000000149011612. Its reader of STL drops triangles
/// whose corners coincide, and its writer speaks through a log that the whole program shares.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "difmesh/error.hpp"
#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/io/mesh_format.hpp"
#include "difmesh/io/mesh_reading.hpp"
#include "difmesh/io/write_mesh_options.hpp"
#include "difmesh/mesh.hpp"
#include "input_file.hpp"
#include "mesh_encoder.hpp"

namespace difmesh::detail {

/// A format has a `write` or an `encoder`.
struct FormatPart {
  MeshFormat facts;
  bool float32_positions = false;  ///< positions are written as float32 as they are
  MeshFile (*read)(const std::filesystem::path& path, const ReadMeshOptions& options) = nullptr;
  /// Of a mesh that check_mesh() and check_scalars() took.
  MeshFileReport (*write)(const std::filesystem::path& path, const Mesh& mesh,
                          const WriteMeshOptions& options) = nullptr;
  /// For the formats that are written portion by portion.
  std::unique_ptr<MeshEncoder> (*encoder)(const EncoderRequest& request) = nullptr;
};

#define DIFMESH_MESH_FORMAT(name) extern const FormatPart name##_format;
#include "format_list.hpp"
#undef DIFMESH_MESH_FORMAT

/// The row of an extension, for reading or writing the path.
/// \throw Error with that code, naming what formats there are; unsupported if the build lacks it
[[nodiscard]] const FormatPart& format_part(const std::filesystem::path& path,
                                            const std::string& extension, ErrorCode unknown);

/// The row for writing a path. \throw Error invalid_argument, unsupported
[[nodiscard]] const FormatPart& format_to_write(const std::filesystem::path& path,
                                                const WriteMeshOptions& options);

/// What is written of a portion with vertices.
[[nodiscard]] MeshContents contents_of(const MeshPortion& portion, const MeshFormat& format,
                                       const WriteMeshOptions& options);

/// A `read` of a function that takes the open file.
template <MeshFile (*kRead)(const InputFile& file)>
[[nodiscard]] MeshFile read_open(const std::filesystem::path& path,
                                 const ReadMeshOptions& /*options*/) {
  return kRead(InputFile(path));
}

/// An `encoder` of a class that takes the request.
template <class Encoder>
[[nodiscard]] std::unique_ptr<MeshEncoder> make_encoder(const EncoderRequest& request) {
  return std::make_unique<Encoder>(request);
}

[[nodiscard]] MeshFile read_ply(const InputFile& file);
[[nodiscard]] MeshFile read_stl(const InputFile& file);

}  // namespace difmesh::detail
