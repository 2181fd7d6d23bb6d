// Attacks the library with ugly fields, and has CGAL look at each surface with exact predicates.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

#include "campaign.hpp"
#include "text.hpp"

namespace {

using namespace difmesh::attack;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

Finding check_by_cgal(const Trial& trial) {
  const Surface surface = surface_of(trial.mesh());
  SurfaceMesh mesh;
  std::vector<SurfaceMesh::Vertex_index> vertices;
  for (std::size_t v = 0; v < surface.vertices(); ++v) {
    const double* p = surface.positions.data() + 3 * v;
    vertices.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
  }
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    const std::uint32_t* corner = surface.triangles.data() + t;
    if (mesh.add_face(vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]) ==
        SurfaceMesh::null_face()) {
      return {"a face that CGAL refuses", text("triangle %zu", t / 3)};
    }
  }
  if (CGAL::is_closed(mesh) != (trial.report().closed != 0)) {
    return {"CGAL and the report disagree about closed", ""};
  }
  if (CGAL::Polygon_mesh_processing::does_self_intersect(mesh)) {
    return {"a surface that intersects itself", ""};
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  return run_campaign(argc, argv, check_by_cgal);
}
