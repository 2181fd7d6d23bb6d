#pragma once
/// \file read_mesh_options.hpp

namespace difmesh {

struct ReadMeshOptions {
  /// Whether buffers of glTF may lie outside the folder of the file; otherwise they must be named
  /// relative to it and lie in it or below, after symbolic links are resolved.
  bool outside_files = false;
};

}  // namespace difmesh
