// CGAL: smoothing by mean-curvature flow, which evens out bumps and barely moves the rest.
// Polygon_mesh_processing and Surface_mesh are under the GPL, and so is this program with them.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <difmesh/adapters/cgal.hpp>
#include <difmesh/difmesh.hpp>
#include <difmesh/io/field_file.hpp>
#include <difmesh/io/mesh_file.hpp>
#include <iostream>

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using MyMesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Rms angle between neighbouring facets, in degrees.
double roughness(const MyMesh& mesh) {
  double sum = 0.0;
  for (const auto edge : mesh.edges()) {
    const auto h = mesh.halfedge(edge);
    const auto g = mesh.opposite(h);
    const auto point = [&mesh](auto halfedge) { return mesh.point(mesh.target(halfedge)); };
    const double angle = 180.0 - std::abs(CGAL::approximate_dihedral_angle(
                                     point(g), point(h), point(mesh.next(h)), point(mesh.next(g))));
    sum += angle * angle;
  }
  return std::sqrt(sum / static_cast<double>(mesh.number_of_edges()));
}

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::cerr << "use: cgal_curvature_flow FIELD.nrrd [OUT.ply]\n";
    return 2;
  }
  const difmesh::FieldFile file = difmesh::read_field(argv[1]);
  const auto [surface, facts] = difmesh::reconstruct(file.view(), file.grid());
  MyMesh mesh = difmesh::to_cgal<MyMesh>(surface).mesh;
  const double before = roughness(mesh);
  const double spacing = file.grid().spacing[0];
  pmp::smooth_shape(mesh, 0.2 * spacing * spacing, CGAL::parameters::number_of_iterations(2));
  const double after = roughness(mesh);

  const difmesh::Mesh result = difmesh::mesh_from_cgal(mesh);
  const double change = difmesh::measure(result).volume / facts.enclosed_volume - 1.0;
  std::cout << "roughness: before " << before << ", after " << after
            << " degrees; the volume changed by " << 100.0 * change << " %\n";
  if (argc > 2) {
    difmesh::write_mesh(argv[2], result);
  }
  return after < 0.9 * before && std::abs(change) < 0.01 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
