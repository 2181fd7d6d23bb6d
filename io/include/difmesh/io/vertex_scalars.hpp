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
};

}  // namespace difmesh
