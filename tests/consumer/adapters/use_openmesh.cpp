#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <difmesh/adapters/openmesh.hpp>

#include "tetrahedron.hpp"

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Triangles = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<>;

int main() {
  difmesh::Mesh curved = tetrahedron();
  curved.scalars = {{"curvature", {1.0, 2.0, 3.0, 4.0}}};
  auto [mesh, report] = difmesh::to_openmesh<Triangles>(tetrahedron());
  const bool round_trip = same(difmesh::mesh_from_openmesh(mesh), tetrahedron());
  report = difmesh::append_to_openmesh(mesh, curved);
  const auto polygons = difmesh::to_openmesh<Polygons>(tetrahedron()).mesh;
  return round_trip && report.refused.empty() && mesh.n_faces() == 8 && polygons.n_edges() == 6 ? 0
                                                                                                : 1;
}
