#pragma once
/// \file surfaces.hpp
/// What the tests of the adapters send through other libraries.

#include <cstdint>
#include <string>
#include <vector>

#include "difmesh/adapters/mesh_view.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::test {

struct Surface {
  std::string name;
  Mesh mesh;
};

/// Surfaces of solvers' fields, with open boundaries and closed, with normals and edge ids; shared
/// triangle meshes and the surfaces of their fractions; noise, of many components; no surface at
/// all. Made once. Says so where the shared data are absent.
const std::vector<Surface>& all_surfaces();

/// Two of these, of white noise and of halves at random; quick to make.
Mesh closed_noise();
Mesh open_noise();

/// A soup that no halfedge structure holds as it is, and what has to go.
struct BrokenSoup {
  std::string name;
  Mesh mesh;
  std::vector<RefusedFace> refused;
};
std::vector<BrokenSoup> broken_soups();

/// Triangles between few vertices, at random: conflicts everywhere.
Mesh random_soup(std::uint32_t vertices, std::uint32_t triangles, std::uint64_t seed);

/// The mesh without the refused faces.
Mesh without(const Mesh& mesh, const std::vector<RefusedFace>& refused);

/// Checks with measure() that the faces kept are an oriented manifold.
void check_kept_part(const Mesh& mesh, const std::vector<RefusedFace>& refused);

/// Six squares about [0,1]^3 as polygons, and an L-shaped prism with concave caps.
struct PolygonMesh {
  std::vector<Vec3> positions;
  std::vector<std::vector<std::uint32_t>> faces;
};
PolygonMesh cube_of_squares();
PolygonMesh prism_with_concave_caps();

/// The mesh with values at its vertices that are not alike.
Mesh with_scalar(Mesh mesh, const std::string& name);

}  // namespace difmesh::test
