#pragma once
/// \file vertex_scalars.hpp
/// Numbers that go with the vertices of a mesh: curvature, errors and the like.

#include <string>
#include <vector>

#include "difmesh/mesh.hpp"

namespace difmesh {

/// One number per vertex. Files hold them as float32.
struct VertexScalars {
  std::string name;  ///< letters, digits and underscores, for instance "mean_curvature"
  Array<double> values;
};

/// A mesh with the scalars that came with it.
struct ScalarMesh {
  Mesh mesh;
  std::vector<VertexScalars> scalars;
  /// What a reader left out of the file or took otherwise than it says, one English sentence each
  /// that names the file: UTF-8 of at most 1000 bytes, without control characters.
  std::vector<std::string> warnings = {};
};

}  // namespace difmesh
