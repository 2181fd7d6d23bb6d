#include "difmesh/vertex_normals.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/error.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/smoothing.hpp"

namespace {

using difmesh::Array;
using difmesh::ErrorCode;
using difmesh::Grid;
using difmesh::Mesh;
using difmesh::Triangle;
using difmesh::Vec3;

double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The corner of a box: three squares of sides 1, 2 and 3 meet in vertex 0, each of two triangles.
Mesh box_corner() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 2, 0}, {0, 2, 3}, {1, 0, 3}};
  mesh.triangles = {{0, 2, 1}, {2, 4, 1}, {0, 3, 2}, {3, 5, 2}, {0, 1, 3}, {1, 6, 3}};
  return mesh;
}

const Grid kGrid{{20, 20, 20}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};

/// The surface of a ball about (10, 10, 10), closed, with all that a mesh may have.
Mesh ball() {
  Array<double> fractions;
  for (int n = 0; n < 8000; ++n) {
    const double r = std::hypot(n % 20 - 9.5, n / 20 % 20 - 9.5, n / 400 - 9.5);
    fractions.push_back(r < 5.8 ? 1.0 : r > 6.8 ? 0.0 : 6.8 - r);
  }
  difmesh::Options options;
  options.vertex_normals = true;
  options.edge_ids = true;
  Mesh mesh =
      reconstruct(difmesh::FieldView::x_fastest(fractions.data(), kGrid.dims), kGrid, options).mesh;
  mesh.scalars = {{"number", Array<double>(mesh.positions.size(), 1.0)}};
  return mesh;
}

/// Unit normals that are those of the triangles around, and point out.
void check_normals(const Mesh& mesh, const Mesh& given) {
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  const Array<Vec3> wanted = vertex_normals(mesh.positions, mesh.triangles);
  bool changed = false;
  for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      REQUIRE(std::abs(mesh.normals[v][axis] - wanted[v][axis]) < 1e-14);
    }
    REQUIRE(dot(mesh.normals[v], {p[0] - 10.0, p[1] - 10.0, p[2] - 10.0}) > 5.0);
    changed = changed || mesh.normals[v] != given.normals[v];
  }
  CHECK(changed);
  CHECK(mesh.triangles == given.triangles);
  CHECK(mesh.edge_ids == given.edge_ids);
  CHECK(mesh.scalars.empty());
}

std::string failure(const Array<Vec3>& positions, const Array<Triangle>& triangles) {
  try {
    (void)difmesh::vertex_normals(positions, triangles);
  } catch (const difmesh::Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("normals of vertices are weighted by the areas around") {
  const Mesh mesh = box_corner();
  // Of the corner: areas 1, 3 and 1.5 of the triangles that meet there.
  const Vec3 areas{-3.0, -1.5, -1.0};
  const double length = std::hypot(areas[0], areas[1], areas[2]);
  // Lengths whose squares leave the range of numbers change nothing.
  for (const double size : {1.0, 0x1p-600, 0x1p+900, 1e-160}) {
    CAPTURE(size);
    Array<Vec3> positions = mesh.positions;
    for (Vec3& p : positions) {
      p = {p[0] * size, p[1] * size, p[2] * size};
    }
    const Array<Vec3> normals = difmesh::vertex_normals(positions, mesh.triangles);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(normals[0][axis] == doctest::Approx(areas[axis] / length).epsilon(1e-14));
    }
    CHECK(normals[4] == Vec3{0.0, 0.0, -1.0});
    CHECK(normals[6] == Vec3{0.0, -1.0, 0.0});
  }
}

TEST_CASE("vertices without area around have no normal") {
  const Array<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}, {0, 1, 0}};
  // A flat triangle, a vertex of none, and one seen from both sides.
  const Array<Vec3> normals =
      difmesh::vertex_normals(positions, Array<Triangle>{{0, 1, 2}, {0, 1, 4}, {0, 4, 1}});
  for (const Vec3& normal : normals) {
    CHECK(normal == Vec3{0.0, 0.0, 0.0});
  }
  CHECK(difmesh::vertex_normals({}, {}).empty());
}

TEST_CASE("normals of what is no mesh are refused by name") {
  const Array<Vec3> good{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK(failure(good, {{0, 1, 2}}).empty());
  CHECK(failure(good, {{0, 1, 2}, {0, 1, 3}}).find("triangle 1") != std::string::npos);
  Array<Vec3> bad = good;
  bad[2][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(failure(bad, {{0, 1, 2}}).find("2") != std::string::npos);
  CHECK_THROWS_AS((void)with_positions(box_corner(), good), difmesh::Error);
}

TEST_CASE("vertices that lose their direction keep their normal") {
  Mesh mesh = box_corner();
  mesh.normals.assign(7, {0.0, 0.6, 0.8});
  Array<Vec3> flat = mesh.positions;
  for (Vec3& p : flat) {
    p = {p[0] + p[1] + p[2], 0.0, 0.0};
  }
  const Mesh moved = with_positions(mesh, flat);
  CHECK(moved.positions == flat);
  CHECK(moved.normals == mesh.normals);
  mesh.normals.clear();
  CHECK(with_positions(mesh, mesh.positions).normals.empty());
}

TEST_CASE("smoothing renews normals whoever calls it") {
  const Mesh mesh = ball();
  check_normals(difmesh::smooth_laplacian(mesh), mesh);
  check_normals(difmesh::smooth_taubin(mesh), mesh);
  check_normals(difmesh::smooth_by_curvature_flow(mesh), mesh);
  check_normals(difmesh::smooth_within_fractions(mesh, kGrid).mesh, mesh);
  CHECK(difmesh::smooth_taubin(mesh).positions ==
        difmesh::smooth_taubin(mesh.positions, mesh.triangles));
  Mesh bare = mesh;
  bare.normals.clear();
  CHECK(difmesh::smooth_laplacian(bare).normals.empty());
}
