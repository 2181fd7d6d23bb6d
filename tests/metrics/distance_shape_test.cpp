#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "difmesh/shapes.hpp"
#include "metrics/surfaces.hpp"

using namespace difmesh;
using namespace difmesh::test;
using doctest::Approx;

TEST_CASE("the shapes of the library are measured by their own distance") {
  // A net on a torus: all vertices on it, the facets inside by their sagitta where it bulges.
  ShapeOptions options;
  options.kind = ShapeKind::torus;
  options.radius = 2.0;
  options.tube_radius = 0.5;
  options.centre = {0.3, -0.2, 0.1};
  const Shape torus = make_shape(options);
  TriangleMesh mesh;
  const std::uint32_t n = 48;
  const std::uint32_t m = 24;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double theta = 2.0 * std::numbers::pi * i / n;
    for (std::uint32_t j = 0; j < m; ++j) {
      const double phi = 2.0 * std::numbers::pi * j / m;
      const double rho = 2.0 + 0.5 * std::cos(phi);
      mesh.positions.push_back(
          add(options.centre, {rho * std::cos(theta), rho * std::sin(theta), 0.5 * std::sin(phi)}));
      const std::uint32_t next_i = (i + 1) % n * m;
      const std::uint32_t next_j = (j + 1) % m;
      mesh.triangles.push_back({i * m + j, next_i + j, i * m + next_j});
      mesh.triangles.push_back({i * m + next_j, next_i + j, next_i + next_j});
    }
  }
  const Distance d = distance_of(mesh, torus);
  CHECK(d.vertices.maximum < 1e-12);
  // Deepest on the outer equator: the sagitta of a step round the ring and of one round the tube.
  const double ring = 2.5 * (1.0 - std::cos(std::numbers::pi / n));
  const double tube = 0.5 * (1.0 - std::cos(std::numbers::pi / m));
  CHECK(-d.facets.lowest == Approx(ring + tube).epsilon(0.03));
  const auto formula = [&](const Vec3& p) {
    const Vec3 q = subtract(p, options.centre);
    return std::hypot(std::hypot(q[0], q[1]) - 2.0, q[2]) - 0.5;
  };
  CHECK(difference(d.facets, distance_of(mesh, formula).facets) < 1e-12);
  Mesh copy;
  copy.positions.assign(mesh.positions.begin(), mesh.positions.end());
  copy.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  CHECK(distance(copy, torus).facets.rms == d.facets.rms);
}
