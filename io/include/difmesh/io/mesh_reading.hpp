#pragma once
/// \file mesh_reading.hpp
/// What readers of mesh files take and give.

#include <string>
#include <vector>

#include "difmesh/mesh.hpp"

namespace difmesh {

struct ReadMeshOptions {
  /// Whether buffers of glTF may lie outside the folder of the file; otherwise they must be named
  /// relative to it and lie in it or below, after symbolic links are resolved.
  bool outside_files = false;
};

/// A mesh from a file, and what there is to know of the reading.
struct MeshFile {
  Mesh mesh;
  /// What the reader left out of the file or took otherwise than it says, one English sentence each
  /// that names the file: UTF-8 of at most 1000 bytes, without control characters.
  std::vector<std::string> warnings = {};
};

}  // namespace difmesh
