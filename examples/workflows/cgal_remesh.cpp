// CGAL: triangles of equal size instead of the slivers of marching cubes.
// Polygon_mesh_processing and Surface_mesh are under the GPL, and so is this program with them.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <difmesh/adapters/cgal.hpp>
#include <difmesh/difmesh.hpp>
#include <difmesh/io/field_file.hpp>
#include <difmesh/io/mesh_file.hpp>
#include <iostream>

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using MyMesh = CGAL::Surface_mesh<Kernel::Point_3>;

double shortest_edge(const MyMesh& mesh) {
  double shortest = 1e300;
  for (const auto edge : mesh.edges()) {
    const auto h = mesh.halfedge(edge);
    shortest = std::min(
        shortest, CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
  }
  return std::sqrt(shortest);
}

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::cerr << "use: cgal_remesh FIELD.nrrd [OUT.ply]\n";
    return 2;
  }
  const difmesh::FieldFile file = difmesh::read_field(argv[1]);
  const auto [surface, facts] = difmesh::reconstruct(file.view(), file.grid());
  MyMesh mesh = difmesh::to_cgal<MyMesh>(surface).mesh;
  const double spacing = file.grid().spacing[0];
  const double before = shortest_edge(mesh) / spacing;
  pmp::isotropic_remeshing(faces(mesh), 0.8 * spacing, mesh,
                           CGAL::parameters::number_of_iterations(3));
  mesh.collect_garbage();
  const double after = shortest_edge(mesh) / spacing;

  const difmesh::Mesh result = difmesh::mesh_from_cgal(mesh);
  const difmesh::Measure measure = difmesh::measure(result);
  const double change = measure.volume / facts.enclosed_volume - 1.0;
  std::cout << "shortest edge, in cells: before " << before << ", after " << after
            << "; the volume changed by " << 100.0 * change << " %\n";
  if (argc > 2) {
    difmesh::write_mesh(argv[2], result);
  }
  return measure.closed && after > 0.3 && std::abs(change) < 0.005 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
