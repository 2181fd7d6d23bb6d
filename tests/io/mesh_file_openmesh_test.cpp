// Meshes across the border to OpenMesh: it reads what we write and we read what it writes.

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cmath>
#include <string>

#include "difmesh/io/mesh_file.hpp"
#include "io/files.hpp"
#include "support/parametric_meshes.hpp"

namespace {

using difmesh::Mesh;
using difmesh::Vec3;
using difmesh::test::parametric_mesh;
using test::TempFolder;

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OtherMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using OtherOptions = OpenMesh::IO::Options;

/// OpenMesh talks to the standard log.
class Quiet {
 public:
  Quiet() { omlog().disable(); }
  ~Quiet() { omlog().enable(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

/// A bumpy sheet, open, with normals.
Mesh sheet(std::uint32_t n) {
  const auto sheet = parametric_mesh({n, n}, [](std::uint32_t i, std::uint32_t j) {
    return Vec3{0.1 * i, 0.1 * j, 0.05 * std::sin(1.7 * i) * std::cos(0.9 * j)};
  });
  Mesh mesh;
  mesh.positions.assign(sheet.positions.begin(), sheet.positions.end());
  mesh.triangles.assign(sheet.triangles.begin(), sheet.triangles.end());
  for (std::uint32_t v = 0; v < n * n; ++v) {
    const double i = v % n;
    mesh.normals.push_back({0.6 * std::sin(i), 0.6 * std::cos(i), 0.8});
  }
  return mesh;
}

bool close(const OpenMesh::Vec3d& a, const Vec3& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) < 1e-6;
}

}  // namespace

TEST_CASE("OpenMesh reads what we write") {
  const Quiet quiet;
  const TempFolder folder;
  const Mesh mesh = sheet(12);
  for (const std::string name : {"m.ply", "m.obj", "m.off", "m.stl"}) {
    CAPTURE(name);
    difmesh::write_mesh(folder / name, mesh);
    OtherMesh other;
    other.request_vertex_normals();
    OtherOptions options(OtherOptions::VertexNormal);
    REQUIRE(OpenMesh::IO::read_mesh(other, (folder / name).string(), options));
    REQUIRE(other.n_vertices() == mesh.positions.size());
    REQUIRE(other.n_faces() == mesh.triangles.size());
    bool equal = true;
    for (const auto face : other.faces()) {
      std::size_t corner = 0;
      // Its faces may start at another corner, its STL vertices stand in another order.
      for (const auto vertex : other.fv_range(face)) {
        const difmesh::Triangle& t = mesh.triangles[static_cast<std::size_t>(face.idx())];
        equal = equal && (close(other.point(vertex), mesh.positions[t[0]]) ||
                          close(other.point(vertex), mesh.positions[t[1]]) ||
                          close(other.point(vertex), mesh.positions[t[2]]));
        ++corner;
      }
      equal = equal && corner == 3;
    }
    CHECK(equal);
    if (name != "m.stl") {
      CHECK(options.check(OtherOptions::VertexNormal));
      for (const auto vertex : other.vertices()) {
        const auto v = static_cast<std::size_t>(vertex.idx());
        equal = equal && close(other.point(vertex), mesh.positions[v]) &&
                close(other.normal(vertex), mesh.normals[v]);
      }
      CHECK(equal);
    }
  }
}

TEST_CASE("we read what OpenMesh writes") {
  const Quiet quiet;
  const TempFolder folder;
  const Mesh mesh = sheet(9);
  OtherMesh other;
  other.request_vertex_normals();
  std::vector<OpenMesh::VertexHandle> handles;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    const Vec3& n = mesh.normals[v];
    handles.push_back(other.add_vertex({p[0], p[1], p[2]}));
    other.set_normal(handles.back(), {n[0], n[1], n[2]});
  }
  for (const difmesh::Triangle& t : mesh.triangles) {
    other.add_face(handles[t[0]], handles[t[1]], handles[t[2]]);
  }
  using O = OtherOptions;
  const auto check = [&](const std::string& name, O options) {
    CAPTURE(name);
    REQUIRE(OpenMesh::IO::write_mesh(other, (folder / name).string(), options, 9));
    const Mesh back = difmesh::read_mesh(folder / name);
    REQUIRE(back.triangles.size() == mesh.triangles.size());
    REQUIRE(back.positions.size() == mesh.positions.size());
    bool equal = true;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& p = back.positions[back.triangles[t][c]];
        equal = equal && close({p[0], p[1], p[2]}, mesh.positions[mesh.triangles[t][c]]);
      }
    }
    CHECK(equal);
    if (options.check(O::VertexNormal)) {
      REQUIRE(back.normals.size() == mesh.normals.size());
      for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
        const Vec3& n = back.normals[v];
        equal = equal && close({n[0], n[1], n[2]}, mesh.normals[v]);
      }
      CHECK(equal);
    }
  };
  check("m.ply", O(O::Binary | O::LSB | O::VertexNormal));
  check("m.ply", O(O::Binary | O::MSB));
  check("m.ply", O(O::VertexNormal));
  check("m.obj", O(O::VertexNormal));
  check("m.obj", O());
  check("m.off", O(O::VertexNormal));
  check("m.off", O());
  check("m.stl", O(O::Binary));
  check("m.stl", O());
}
