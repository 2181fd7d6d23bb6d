#pragma once
/// \file roughness.hpp
/// How crumpled a mesh is.

#include <optional>

#include "difmesh/mesh.hpp"

namespace difmesh::cli {

/// Root mean square, over the edges with two triangles, of the angle between the normals of the
/// two, in degrees: 0 for a plane, and proportional to the size of the triangles on a smooth
/// surface. Triangles without area have no normal; their edges do not count. Nothing where no edge
/// counts. Cost: O(n log n). \pre indices in range
[[nodiscard]] std::optional<double> roughness_degrees(const Mesh& mesh);

/// For each vertex the largest such angle along its edges, in degrees; 0 without any. Cost and \pre
/// as above.
[[nodiscard]] Array<double> largest_angles(const Mesh& mesh);

}  // namespace difmesh::cli
