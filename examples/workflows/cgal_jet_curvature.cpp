// CGAL: curvature by fitting jets to the vertices round each vertex, on a ball where it is known.
// Jet fitting and Surface_mesh are under the GPL, and so is this program with them.
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <difmesh/adapters/cgal.hpp>
#include <difmesh/difmesh.hpp>
#include <iostream>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using MyMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = MyMesh::Vertex_index;

std::vector<Kernel::Point_3> neighbours(const MyMesh& mesh, Vertex centre, int rings) {
  std::vector<Vertex> all{centre};  // the vertex itself is to be the first
  for (std::size_t first = 0; rings > 0; --rings) {
    for (const std::size_t last = all.size(); first < last; ++first) {
      for (const Vertex v : mesh.vertices_around_target(mesh.halfedge(all[first]))) {
        if (std::ranges::find(all, v) == all.end()) {
          all.push_back(v);
        }
      }
    }
  }
  std::vector<Kernel::Point_3> points(all.size());
  std::ranges::transform(all, points.begin(), [&mesh](Vertex v) { return mesh.point(v); });
  return points;
}

// Rms of the relative error of the mean curvature of a ball.
double curvature_error(difmesh::Placement placement) {
  const double radius = 12.0;
  const auto ball = difmesh::make_shape({.centre = {16.1, 15.9, 16.3}, .radius = radius});
  const difmesh::Grid grid{.dims = {32, 32, 32}};
  const auto fractions = difmesh::fractions_from_function(grid, ball.function()).fractions;
  const auto field = difmesh::FieldView::x_fastest(fractions.data(), grid.dims);
  difmesh::Options options;
  options.placement = placement;
  const auto mesh = difmesh::to_cgal<MyMesh>(difmesh::reconstruct(field, grid, options).mesh).mesh;
  double sum = 0.0;
  for (const Vertex v : mesh.vertices()) {
    const auto near = neighbours(mesh, v, 3);
    const auto form = CGAL::Monge_via_jet_fitting<Kernel>()(near.begin(), near.end(), 2, 2);
    const double twice = form.principal_curvatures(0) + form.principal_curvatures(1);
    sum += std::pow(0.5 * std::abs(twice) * radius - 1.0, 2);
  }
  return std::sqrt(sum / static_cast<double>(mesh.number_of_vertices()));
}

int main() {
  const double plic = curvature_error(difmesh::Placement::plic);
  const double linear = curvature_error(difmesh::Placement::linear);
  std::cout << "rms error of the curvature: plic " << plic << ", linear " << linear << '\n';
  return plic < 0.02 && 4.0 * plic < linear ? 0 : 1;
}
