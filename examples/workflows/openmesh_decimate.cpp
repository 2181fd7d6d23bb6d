// OpenMesh: smooth a solver's surface and decimate it to a tenth, and keep its volume within 2 %.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <cmath>
#include <difmesh/adapters/openmesh.hpp>
#include <difmesh/difmesh.hpp>
#include <difmesh/io/field_file.hpp>
#include <difmesh/io/mesh_file.hpp>
#include <iostream>

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using MyMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::cerr << "use: openmesh_decimate FIELD.nrrd [OUT.ply]\n";
    return 2;
  }
  const difmesh::FieldFile file = difmesh::read_field(argv[1]);
  const auto [surface, facts] = difmesh::reconstruct(file.view(), file.grid());
  auto [mesh, report] = difmesh::to_openmesh<MyMesh>(surface);

  using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<MyMesh>;
  Smoother smoother(mesh);  // along the surface only: along normals, it would shrink
  smoother.initialize(Smoother::Tangential, Smoother::C0);
  smoother.smooth(5);

  OpenMesh::Decimater::DecimaterT<MyMesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<MyMesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to(mesh.n_vertices() / 10);
  mesh.garbage_collection();

  const difmesh::Mesh result = difmesh::mesh_from_openmesh(mesh);
  const difmesh::Measure measure = difmesh::measure(result);
  const double change = measure.volume / facts.enclosed_volume - 1.0;
  std::cout << surface.triangles.size() << " triangles became " << result.triangles.size()
            << ", the volume changed by " << 100.0 * change << " %\n";
  if (argc > 2) {
    difmesh::write_mesh(argv[2], result);
  }
  return report.refused.empty() && measure.closed &&
                 9 * result.triangles.size() < surface.triangles.size() && std::abs(change) < 0.02
             ? 0
             : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
