#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <difmesh/adapters/cgal.hpp>

#include "tetrahedron.hpp"

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

int main() {
  difmesh::Mesh curved = tetrahedron();
  curved.scalars = {{"curvature", {1.0, 2.0, 3.0, 4.0}}};
  auto [mesh, report] = difmesh::to_cgal<SurfaceMesh>(tetrahedron());
  const bool round_trip = same(difmesh::mesh_from_cgal(mesh), tetrahedron());
  report = difmesh::append_to_cgal(mesh, curved);
  const auto polyhedron = difmesh::to_cgal<Polyhedron>(tetrahedron()).mesh;
  return round_trip && report.refused.empty() && mesh.number_of_faces() == 8 &&
                 difmesh::mesh_from_cgal(polyhedron).triangles.size() == 4
             ? 0
             : 1;
}
