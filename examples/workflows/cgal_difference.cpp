// CGAL: what of a body is not in another one. Both are surfaces of a solver's drops, one moved.
// Polygon_mesh_processing and Surface_mesh are under the GPL, and so is this program with them.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
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

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::cerr << "use: cgal_difference FIELD.nrrd [OUT.ply]\n";
    return 2;
  }
  const difmesh::FieldFile file = difmesh::read_field(argv[1]);
  difmesh::Grid grid = file.grid();
  const auto body = difmesh::to_cgal<MyMesh>(difmesh::reconstruct(file.view(), grid).mesh).mesh;
  grid.origin[0] += 5.3 * grid.spacing[0];
  grid.origin[2] += 2.1 * grid.spacing[2];
  const auto other = difmesh::to_cgal<MyMesh>(difmesh::reconstruct(file.view(), grid).mesh).mesh;

  // Corefinement cuts both of its operands.
  MyMesh a = body;
  MyMesh b = other;
  MyMesh difference;
  MyMesh common;
  const bool done = pmp::corefine_and_compute_difference(a, b, difference) &&
                    pmp::corefine_and_compute_intersection(a, b, common);

  const difmesh::Mesh result = difmesh::mesh_from_cgal(difference);
  const double whole = difmesh::measure(difmesh::mesh_from_cgal(body)).volume;
  const double rest = difmesh::measure(result).volume;
  const double shared = difmesh::measure(difmesh::mesh_from_cgal(common)).volume;
  const double gap = (rest + shared) / whole - 1.0;
  std::cout << "of the volume, " << rest / whole << " is left and " << shared / whole
            << " is shared; together they miss the whole by " << gap << '\n';
  if (argc > 2) {
    difmesh::write_mesh(argv[2], result);
  }
  return done && rest > 0.1 * whole && shared > 0.1 * whole && std::abs(gap) < 1e-9 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
