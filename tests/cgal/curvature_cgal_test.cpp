// Cross-check with CGAL's jet fitting, which is under the GPL: for tests only.
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "difmesh/curvature.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "support/vec3.hpp"

namespace {

using namespace difmesh;
using Kernel = CGAL::Simple_cartesian<double>;
using Jets = CGAL::Monge_via_jet_fitting<Kernel>;

/// The two principal curvatures of each vertex, the larger first, bodies convex for positive ones.
struct Principal {
  double largest = 0.0;
  double smallest = 0.0;
};

std::vector<std::set<std::uint32_t>> neighbours_of(const Mesh& mesh) {
  std::vector<std::set<std::uint32_t>> neighbours(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      neighbours[t[c]].insert({t[(c + 1) % 3], t[(c + 2) % 3]});
    }
  }
  return neighbours;
}

/// Jets of second order over the same two rings.
std::vector<Principal> by_jets(const Mesh& mesh) {
  const auto neighbours = neighbours_of(mesh);
  std::vector<Principal> result;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    std::set<std::uint32_t> near;
    for (const std::uint32_t first : neighbours[v]) {
      near.insert(neighbours[first].begin(), neighbours[first].end());
    }
    near.insert(neighbours[v].begin(), neighbours[v].end());
    near.erase(v);
    std::vector<Kernel::Point_3> points;
    const auto add = [&](std::uint32_t n) {
      points.emplace_back(mesh.positions[n][0], mesh.positions[n][1], mesh.positions[n][2]);
    };
    add(v);  // the point that the jet is about comes first
    std::for_each(near.begin(), near.end(), add);
    auto form = Jets()(points.begin(), points.end(), 2, 2);
    // Heights along the normal out of the material: there convex bodies have negative curvatures.
    form.comply_wrt_given_normal({mesh.normals[v][0], mesh.normals[v][1], mesh.normals[v][2]});
    result.push_back({-form.principal_curvatures(1), -form.principal_curvatures(0)});
  }
  return result;
}

Mesh ellipsoid(double size) {
  const auto cells = static_cast<std::int64_t>(2.0 * size) + 6;
  const double middle = 0.5 * static_cast<double>(cells);
  const Grid grid{.dims = {cells, cells, cells}};
  const Shape shape = make_shape({.kind = ShapeKind::ellipsoid,
                                  .centre = {middle + 0.2, middle - 0.1, middle + 0.3},
                                  .rotation_degrees = {11, 23, 37},
                                  .semi_axes = {size, 0.8 * size, 0.6 * size}});
  const auto fractions = fractions_from_shape(grid, shape).fractions;
  Options options;
  options.vertex_normals = true;
  return reconstruct(FieldView::x_fastest(fractions.data(), grid.dims), grid, options).mesh;
}

}  // namespace

TEST_CASE("curvature by patches agrees with CGAL's by jets") {
  const double size = 20.0;
  const Mesh mesh = ellipsoid(size);
  CurvatureOptions options;
  options.principal = true;
  const Curvature ours = curvature(mesh, options);
  const std::vector<Principal> theirs = by_jets(mesh);
  double mean_square = 0.0;
  double gaussian_square = 0.0;
  double principal_square = 0.0;
  for (std::size_t v = 0; v < theirs.size(); ++v) {
    const auto [largest, smallest] = theirs[v];
    mean_square += std::pow(ours.mean[v] - 0.5 * (largest + smallest), 2);
    gaussian_square += std::pow(ours.gaussian[v] - largest * smallest, 2);
    principal_square += std::pow(ours.largest[v] - largest, 2);
    principal_square += std::pow(ours.smallest[v] - smallest, 2);
  }
  const double count = static_cast<double>(theirs.size());
  // Both err by a percent or two, CGAL's without weights by more; curvatures range over 0.6 to 2.8
  // in this unit.
  const double mean = size * std::sqrt(mean_square / count);
  const double gaussian = size * size * std::sqrt(gaussian_square / count);
  const double principal = size * std::sqrt(principal_square / (2.0 * count));
  CAPTURE(mean);
  CAPTURE(gaussian);
  CAPTURE(principal);
  CHECK(mean < 0.02);
  CHECK(gaussian < 0.04);
  CHECK(principal < 0.03);
}
