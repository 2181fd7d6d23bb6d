#include "roughness.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/triangle_meshes.hpp"

namespace {

using difmesh::Mesh;
using difmesh::cli::roughness_degrees;
using difmesh::test::TriangleMesh;

Mesh as_mesh(const TriangleMesh& soup) {
  Mesh mesh;
  mesh.positions.assign(soup.positions.begin(), soup.positions.end());
  mesh.triangles.assign(soup.triangles.begin(), soup.triangles.end());
  return mesh;
}

/// Two triangles that share an edge, bent by an angle.
Mesh hinge(double angle) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {-std::cos(angle), 0.5, std::sin(angle)}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("roughness of a cube and of a regular tetrahedron") {
  // Twelve edges of 90 degrees, six diagonals of 0.
  CHECK(roughness_degrees(as_mesh(difmesh::test::box_mesh({0, 0, 0}, {2, 3, 1}))).value() ==
        doctest::Approx(90.0 * std::sqrt(12.0 / 18.0)).epsilon(1e-14));
  // Six edges whose normals are 180 degrees - acos(1/3) apart.
  const TriangleMesh tetrahedron =
      difmesh::test::tetrahedron_mesh({{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}});
  CHECK(roughness_degrees(as_mesh(tetrahedron)).value() ==
        doctest::Approx(180.0 - std::acos(1.0 / 3.0) * 180.0 / std::numbers::pi).epsilon(1e-14));
}

TEST_CASE("roughness of a hinge is its angle however small") {
  for (const double angle : {3.0, 1.0, 1e-3, 1e-9}) {
    CAPTURE(angle);
    CHECK(roughness_degrees(hinge(angle)).value() ==
          doctest::Approx(angle * 180.0 / std::numbers::pi).epsilon(1e-6));
  }
  CHECK(roughness_degrees(hinge(0.0)).value() == 0.0);
}

TEST_CASE("roughness does not depend on the unit of length") {
  Mesh mesh = hinge(0.5);
  for (difmesh::Vec3& p : mesh.positions) {
    p = {1e-200 * p[0], 1e-200 * p[1], 1e-200 * p[2]};
  }
  CHECK(roughness_degrees(mesh).value() ==
        doctest::Approx(0.5 * 180.0 / std::numbers::pi).epsilon(1e-12));
}

TEST_CASE("edges without two proper triangles do not count") {
  CHECK(!roughness_degrees(Mesh{}));
  Mesh mesh = hinge(1.0);
  mesh.triangles.resize(1);
  CHECK(!roughness_degrees(mesh));
  mesh = hinge(1.0);
  mesh.positions[3] = {0, 2, 0};  // in line with the shared edge: no area
  CHECK(!roughness_degrees(mesh));
  mesh = hinge(1.0);
  mesh.positions.push_back({0, 0.5, 1});
  mesh.triangles.push_back({1, 0, 4});  // a third triangle at the only edge
  CHECK(!roughness_degrees(mesh));
}
