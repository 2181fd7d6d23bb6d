#pragma once
/// \file mesh_stream.hpp
/// Writes a mesh file from portions of the mesh, which need never be in memory together.

#include <filesystem>
#include <memory>

#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/io/write_mesh_options.hpp"
#include "difmesh/mesh_portion.hpp"

namespace difmesh {

/// Makes the same bytes as write_mesh() of the whole mesh. How many vertices and triangles come
/// need not be known: what cannot be written in its place yet waits in temporary files without a
/// name, beside the file or, for targets that are no regular files, where the system has such. The
/// file appears under its name at finish() and not before; without finish(), nothing is left.
///
/// What the file holds is told by the first portion that has vertices: normals, edge ids, the names
/// of scalars. The others must have the same.
///
/// Memory: some buffers of 256 KiB; for STL, whose triangles repeat their corners, 24 bytes per
/// vertex too. Thread safety: none of one stream; several are independent.
class MeshStream {
 public:
  /// Opens the file. \throw Error invalid_argument for a format whose MeshFormat is not `streamed`,
  /// and as write_mesh()
  explicit MeshStream(const std::filesystem::path& path, const WriteMeshOptions& options = {});
  ~MeshStream();
  MeshStream(MeshStream&&) noexcept;
  MeshStream& operator=(MeshStream&&) noexcept;

  /// Writes what follows.
  /// \throw Error as write_mesh(), with vertices and triangles counted over all portions; also
  ///   invalid_argument for arrays other than those of the first portion, and for a triangle before
  ///   its vertices. The stream can then only be destroyed.
  void add(const MeshPortion& portion);

  /// Puts the file in its place, once, as the last call. \throw Error file_write
  MeshFileReport finish();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace difmesh
