#pragma once
/// \file mesh.hpp
/// The surface: an indexed triangle soup whose arrays can be handed to any mesh library.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "difmesh/array.hpp"
#include "difmesh/grid.hpp"

namespace difmesh {

using Triangle = std::array<std::uint32_t, 3>;

/// A named number per vertex: curvature, errors and the like.
struct VertexScalar {
  std::string name;      ///< letters, digits and underscores, for instance "mean_curvature"
  Array<double> values;  ///< one per vertex
};

/// A triangle mesh. Triangles are counter-clockwise seen from the empty side (γ < 1/2). What
/// reconstruct() returns is edge-manifold and vertex-manifold; boundaries lie on domain sides only.
struct Mesh {
  Array<Vec3> positions;      ///< one per vertex, in the unit of the grid
  Array<Triangle> triangles;  ///< three indices into positions each
  Array<Vec3> normals;        ///< empty, or one unit vector per vertex, out of the material
  /// Empty, or one per vertex: the name of its dual edge, strictly ascending over the vertices.
  /// edge_id.hpp makes these names and takes them apart: they hold the edge's lower node and axis,
  /// in the indices of the whole grid.
  Array<std::uint64_t> edge_ids;
  std::vector<VertexScalar> scalars = {};  ///< of different names
};

}  // namespace difmesh
