#pragma once
/// \file mesh_encoder.hpp
/// How a format turns portions of a mesh into bytes.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "byte_output.hpp"
#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/mesh_portion.hpp"

namespace difmesh::detail {

/// What of a mesh is written beside positions and triangles.
struct MeshContents {
  bool normals = false;
  bool edge_ids = false;
  std::vector<std::string> scalars = {};  ///< their names

  bool operator==(const MeshContents&) const = default;
};

/// What an encoder is made for.
struct EncoderRequest {
  const std::filesystem::path& path;  ///< for messages
  MeshContents contents;
  bool is_whole;  ///< the mesh comes as one portion
};

struct MeshCounts {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
};

/// A file is a header, sections of vertices and a section of triangles. Portions were checked.
class MeshEncoder {
 public:
  MeshEncoder() = default;
  virtual ~MeshEncoder() = default;
  MeshEncoder(const MeshEncoder&) = delete;
  MeshEncoder& operator=(const MeshEncoder&) = delete;

  [[nodiscard]] virtual std::size_t vertex_sections() const = 0;
  virtual void header(ByteOutput& output, const MeshCounts& counts) = 0;
  /// What a section, from 0, tells of the vertices of a portion.
  virtual void vertices(ByteOutput& output, std::size_t section, const MeshPortion& portion) = 0;
  /// Called once per portion, after its vertices.
  virtual void triangles(ByteOutput& output, const MeshPortion& portion) = 0;
  /// Adds what the format did to the mesh to the report of a file, whose counts are those of the
  /// mesh.
  virtual void complete(MeshFileReport& /*report*/) const {}
};

}  // namespace difmesh::detail
