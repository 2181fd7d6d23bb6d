#pragma once
/// \file gltf_primitive.hpp
/// The triangles of the primitives of one mesh, with what goes with their vertices.

#include <cstdint>

#include "difmesh/io/mesh_reading.hpp"
#include "gltf_source.hpp"

namespace difmesh::detail {

/// A surface in the coordinates of its node. Arrays other than positions may be empty.
struct GltfSurface {
  MeshFile content;
  Array<std::uint64_t> whole_index;  ///< `_VERTEX`: the index in the mesh before it was split

  /// The memory that a copy takes.
  [[nodiscard]] std::uint64_t bytes() const;
};

/// Keeps a file from asking for more memory than its size makes plausible: primitives may share
/// their data and nodes their meshes, and so a small file describe a huge scene.
class Budget {
 public:
  explicit Budget(const GltfSource& source) : source_(source) {}
  /// Before memory is taken. \throw Error file_format
  void take(const JsonPlace& place, std::uint64_t bytes);
  /// Before Draco's data of that size are decoded; they may be a hundred times as large then.
  void take_compressed(const JsonPlace& place, std::uint64_t bytes);
  /// What came out of Draco may be copied a few times, too.
  void allow(std::uint64_t bytes) { extra_ += bytes; }

 private:
  const GltfSource& source_;
  std::uint64_t taken_ = 0;
  std::uint64_t compressed_ = 0;
  std::uint64_t extra_ = 0;
};

/// All primitives of meshes[i] in one, in their order; joined where `_VERTEX` says how.
[[nodiscard]] GltfSurface read_gltf_mesh(GltfSource& source, const JsonPlace& mesh, Budget& budget);

/// Appends a surface; what one of them lacks both lose, unless nothing was appended before.
/// \throw Error too_large beyond 2^32 - 1 vertices
void append(GltfSurface& to, GltfSurface&& from, const std::filesystem::path& path);

}  // namespace difmesh::detail
