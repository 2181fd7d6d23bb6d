#include "difmesh/io/mesh_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/measure.hpp"
#include "io/files.hpp"

namespace {

using difmesh::Mesh;
using difmesh::Triangle;
using difmesh::Vec3;
using test::TempFolder;

/// Numbers that a careless text or a float32 would change, in a soup that no half-edge mesh takes:
/// three triangles on one edge, one flipped, one degenerate, an isolated vertex.
Mesh awkward_mesh() {
  Mesh mesh;
  mesh.positions = {{0.1, 0.2, 0.3},
                    {1.0 / 3.0, -2.0 / 7.0, 1e-17},
                    {1e300, -1e-300, 4.9406564584124654e-324},
                    {-0.0, 123456789.12345679, 1.7976931348623157e308},
                    {2.0, 3.0, 5.0},
                    {0.1 + 1e-16, 0.30000000000000004, -1e22}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}, {4, 3, 2}};
  mesh.normals = {{1, 0, 0},         {0, -1, 0},          {0.6, 0.8, 0},
                  {0.1, 0.2, -0.97}, {1.0 / 3.0, 0, 0.5}, {0, 0, 1}};
  mesh.edge_ids = {0, 1, 4294967295, 4294967296, 1000000000000000, 18446744073709551615U};
  return mesh;
}

bool equal_bits(const difmesh::Array<Vec3>& a, const difmesh::Array<Vec3>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0);
}

/// A sphere of rows of latitude: closed, with coordinates that float32 cannot hold.
Mesh sphere(std::uint32_t rows) {
  Mesh mesh;
  const std::uint32_t around = 2 * rows;
  mesh.positions.push_back({0, 0, 1});
  for (std::uint32_t i = 1; i < rows; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const double theta = 3.14159265358979323846 * i / rows;
      const double phi = 3.14159265358979323846 * 2.0 * j / around;
      mesh.positions.push_back(
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  mesh.positions.push_back({0, 0, -1});
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return 1 + (i - 1) * around + j % around;
  };
  const auto south = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (std::uint32_t j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < rows; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({south, at(rows - 1, j + 1), at(rows - 1, j)});
  }
  return mesh;
}

Mesh read(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  return difmesh::read_mesh(folder.file(name, bytes));
}

const difmesh::Array<Triangle> kTwoTriangles{{0, 1, 2}, {0, 2, 3}};
const difmesh::Array<Vec3> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};

void check_square(const Mesh& mesh) {
  CHECK(mesh.positions == kSquare);
  CHECK(mesh.triangles == kTwoTriangles);
}

}  // namespace

TEST_CASE("scalars come back from ply bit for bit") {
  const TempFolder folder;
  Mesh mesh = awkward_mesh();
  const std::vector<difmesh::VertexScalar> scalars{
      {"mean_curvature", {0.1, -2.0 / 7.0, 1e-300, 3e38, -0.0, 5.0}},
      {"Error_2", {1, 2, 3, 4, 5, 6}}};
  mesh.scalars = scalars;
  difmesh::write_mesh(folder / "m.ply", mesh);
  const difmesh::MeshFile back = difmesh::read_mesh_file(folder / "m.ply");
  CHECK(equal_bits(back.mesh.positions, mesh.positions));
  CHECK(equal_bits(back.mesh.normals, mesh.normals));
  CHECK(back.mesh.edge_ids == mesh.edge_ids);
  CHECK(back.mesh.triangles == mesh.triangles);
  REQUIRE(back.mesh.scalars.size() == 2);
  for (std::size_t n = 0; n < 2; ++n) {
    CHECK(back.mesh.scalars[n].name == scalars[n].name);
    CHECK(back.mesh.scalars[n].values == scalars[n].values);
  }
  // Formats without a place for them leave them out.
  for (const std::string name : {"m.obj", "m.off"}) {
    difmesh::write_mesh(folder / name, mesh);
    CHECK(difmesh::read_mesh_file(folder / name).mesh.scalars.empty());
  }
}

TEST_CASE("float properties of foreign ply files are scalars and others are not") {
  const TempFolder folder;
  const difmesh::MeshFile surface = difmesh::read_mesh_file(folder.file(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty float quality\nproperty double u-v\n"
      "property float hole\nproperty float quality\nproperty float nx\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 255 0.5 9 1 7 0\n1 0 0 0 1.5 9 nan 7 0\n0 1 0 3 -2 9 2 7 1\n3 0 1 2\n"));
  REQUIRE(surface.mesh.scalars.size() == 1);
  CHECK(surface.mesh.scalars[0].name == "quality");
  CHECK(surface.mesh.scalars[0].values == difmesh::Array<double>{0.5, 1.5, -2.0});
  CHECK(surface.mesh.triangles.size() == 1);
}

TEST_CASE("scalars that do not fit a file are named") {
  const TempFolder folder;
  const Mesh mesh = awkward_mesh();
  const auto fails = [&](const difmesh::VertexScalar& scalars, const std::string& words) {
    try {
      Mesh with_scalars = mesh;
      with_scalars.scalars = {scalars};
      difmesh::write_mesh(folder / "m.ply", with_scalars);
    } catch (const difmesh::Error& error) {
      CAPTURE(error.what());
      CHECK(std::string(error.what()).find(words) != std::string::npos);
      CHECK_FALSE(std::filesystem::exists(folder / "m.ply"));
      return;
    }
    FAIL("no error was thrown");
  };
  fails({"nx", {1, 2, 3, 4, 5, 6}}, "the name 'nx' of scalars is taken");
  fails({"edge_id_low", {1, 2, 3, 4, 5, 6}}, "the name 'edge_id_low' of scalars is taken");
  fails({"two words", {1, 2, 3, 4, 5, 6}}, "letters, digits and underscores");
  fails({"short", {1, 2, 3}}, "3 values");
  fails({"infinite", {1, 2, 3, 4, HUGE_VAL, 6}}, "of vertex 4");
}

TEST_CASE("meshes come back from ply and obj and off bit for bit") {
  const TempFolder folder;
  const Mesh mesh = awkward_mesh();
  for (const std::string name : {"m.ply", "m.obj", "m.off", "M.PLY", "M.Obj", "M.oFF"}) {
    CAPTURE(name);
    difmesh::write_mesh(folder / name, mesh);
    const Mesh back = difmesh::read_mesh(folder / name);
    CHECK(equal_bits(back.positions, mesh.positions));
    CHECK(equal_bits(back.normals, mesh.normals));
    CHECK(back.triangles == mesh.triangles);
    const bool ply = name == "m.ply" || name == "M.PLY";
    CHECK(back.edge_ids == (ply ? mesh.edge_ids : difmesh::Array<std::uint64_t>{}));
  }
}

TEST_CASE("normals and edge ids are left out on demand and where there are none") {
  const TempFolder folder;
  Mesh mesh = awkward_mesh();
  for (const char* name : {"m.ply", "m.obj", "m.off"}) {
    difmesh::write_mesh(folder / name, mesh, {.normals = false, .edge_ids = false});
    const std::string without = test::read_bytes(folder / name);
    const Mesh back = difmesh::read_mesh(folder / name);
    CHECK(back.normals.empty());
    CHECK(back.edge_ids.empty());
    Mesh bare = mesh;
    bare.normals.clear();
    bare.edge_ids.clear();
    difmesh::write_mesh(folder / name, bare);
    CHECK(test::read_bytes(folder / name) == without);
  }
}

TEST_CASE("binary stl keeps the positions to float32 and welds equal corners") {
  const TempFolder folder;
  const Mesh mesh = sphere(20);
  difmesh::write_mesh(folder / "m.stl", mesh);
  const Mesh back = difmesh::read_mesh(folder / "m.stl");
  REQUIRE(back.triangles.size() == mesh.triangles.size());
  CHECK(back.positions.size() == mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& wanted = mesh.positions[mesh.triangles[t][c]];
      const Vec3& found = back.positions[back.triangles[t][c]];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        REQUIRE(found[axis] == static_cast<double>(static_cast<float>(wanted[axis])));
      }
    }
  }
  const difmesh::Measure m = difmesh::measure(back);
  CHECK(m.closed);
  CHECK(m.manifold);
  CHECK(m.euler_number == 2);
  CHECK(m.volume == doctest::Approx(difmesh::measure(mesh).volume).epsilon(1e-6));
}

TEST_CASE("stl bytes are those of the format") {
  const TempFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 1}};
  difmesh::write_mesh(folder / "m.stl", mesh);
  const std::string bytes = test::read_bytes(folder / "m.stl");
  REQUIRE(bytes.size() == 84 + 2 * 50);
  CHECK_FALSE(bytes.starts_with("solid"));
  std::string wanted = test::bytes_of(std::uint32_t{2});
  for (const float number : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 0.F, 3.F, 0.F}) {
    wanted += test::bytes_of(number);
  }
  wanted += std::string(2, '\0');
  // A triangle without area has the normal 0, not NaN.
  for (const float number : {0.F, 0.F, 0.F, 0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 2.F, 0.F, 0.F}) {
    wanted += test::bytes_of(number);
  }
  wanted += std::string(2, '\0');
  CHECK(bytes.substr(80) == wanted);
  const Mesh back = difmesh::read_mesh(folder / "m.stl");
  CHECK(back.triangles == difmesh::Array<Triangle>{{0, 1, 2}, {0, 1, 1}});
}

TEST_CASE("ply bytes are those of the format") {
  const TempFolder folder;
  Mesh mesh;
  mesh.positions = {{0.1, -2, 3}, {4, 5, 6}, {7, 8, 9}};
  mesh.triangles = {{2, 0, 1}};
  mesh.edge_ids = {7, 1, (std::uint64_t{9} << 32U) + 8};
  difmesh::write_mesh(folder / "m.ply", mesh);
  std::string wanted =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double "
      "y\n"
      "property double z\nproperty uint edge_id_low\nproperty uint edge_id_high\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::vector<std::array<std::uint32_t, 2>> ids{{7, 0}, {1, 0}, {8, 9}};
  for (std::size_t v = 0; v < 3; ++v) {
    for (const double coordinate : mesh.positions[v]) {
      wanted += test::bytes_of(coordinate);
    }
    wanted += test::bytes_of(ids[v][0]) + test::bytes_of(ids[v][1]);
  }
  wanted += '\3';
  for (const std::int32_t v : {2, 0, 1}) {
    wanted += test::bytes_of(v);
  }
  CHECK(test::read_bytes(folder / "m.ply") == wanted);
}

TEST_CASE("obj and off texts are those of the format") {
  const TempFolder folder;
  Mesh mesh;
  mesh.positions = {{0.1, -2, 3e-5}, {4, 5, 6}, {7, 8, 9}};
  mesh.triangles = {{2, 0, 1}};
  difmesh::write_mesh(folder / "m.obj", mesh);
  CHECK(test::read_bytes(folder / "m.obj") ==
        "# 3 vertices, 1 triangles\nv 0.1 -2 3e-05\nv 4 5 6\nv 7 8 9\nf 3 1 2\n");
  difmesh::write_mesh(folder / "m.off", mesh);
  CHECK(test::read_bytes(folder / "m.off") == "OFF\n3 1 0\n0.1 -2 3e-05\n4 5 6\n7 8 9\n3 2 0 1\n");
  mesh.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  difmesh::write_mesh(folder / "m.obj", mesh);
  CHECK(test::read_bytes(folder / "m.obj") ==
        "# 3 vertices, 1 triangles\nv 0.1 -2 3e-05\nv 4 5 6\nv 7 8 9\nvn 0 0 1\nvn 0 1 0\nvn 1 0 "
        "0\nf 3//3 1//1 2//2\n");
}

TEST_CASE("write_mesh tells what it wrote") {
  const TempFolder folder;
  // Small, and larger than what is written at once.
  for (const Mesh& mesh : {sphere(5), sphere(150)}) {
    for (const std::string name : {"m.ply", "m.obj", "m.off", "m.stl"}) {
      CAPTURE(name);
      const bool stl = name == "m.stl";
      const difmesh::MeshFileReport report = difmesh::write_mesh(folder / name, mesh);
      CHECK(report.bytes == static_cast<std::int64_t>(std::filesystem::file_size(folder / name)));
      CHECK(report.vertices ==
            static_cast<std::int64_t>(stl ? 3 * mesh.triangles.size() : mesh.positions.size()));
      CHECK(report.triangles == static_cast<std::int64_t>(mesh.triangles.size()));
      CHECK(report.primitives == 1);
      CHECK(report.position_bits == 0);
      CHECK(report.local_origin == Vec3{0, 0, 0});
      double error = 0.0;
      const Mesh back = difmesh::read_mesh(folder / name);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t c = 0; c < 3; ++c) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            error = std::max(error, std::abs(back.positions[back.triangles[t][c]][axis] -
                                             mesh.positions[mesh.triangles[t][c]][axis]));
          }
        }
      }
      CHECK(report.position_error == error);
      CHECK((error > 0.0) == stl);
    }
  }
}

TEST_CASE("the empty mesh is written and read in every format") {
  const TempFolder folder;
  for (const char* name : {"m.ply", "m.obj", "m.off", "m.stl"}) {
    CAPTURE(name);
    difmesh::write_mesh(folder / name, Mesh{});
    const Mesh back = difmesh::read_mesh(folder / name);
    CHECK(back.positions.empty());
    CHECK(back.triangles.empty());
  }
}

TEST_CASE("polygons become fans about their first corner") {
  check_square(read("m.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n4 0 1 2 3\n"));
  check_square(read("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\n"));
  check_square(read("m.ply",
                    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
                    "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 3\n"));
  const Mesh pentagon =
      read("m.off", "OFF 5 2\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 4 0 1 2 3\n3 0 1 2");
  CHECK(pentagon.triangles == difmesh::Array<Triangle>{{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {0, 1, 2}});
}

TEST_CASE("off: comments and colors and texture coordinates and counts on the first line") {
  check_square(
      read("m.off",
           "# a comment\r\n\r\nOFF # more\r\n4 2 5\r\n0 0 0\r\n\t1 0 0 # point\r\n\r\n1 1 0\r\n"
           "0 1 0.5\r\n3 0 1 2  255 0 0\r\n3 0 2 3 0.1 0.2 0.3 1\r\n"));
  check_square(read("m.off",
                    "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n1 1 0 0 0 0 0\n"
                    "0 1 0.5 0 0 0 0\n3 0 1 2\n3 0 2 3\n"));
  check_square(read("m.off",
                    "STCNOFF 4 2 0\n0 0 0 0 0 1 9 9 9 9 .5 .5\n1 0 0 0 0 1\n1 1 0 0 0 1\n"
                    "0 1 0.5 0 1 0\n3 0 1 2\n3 0 2 3\n"));
  const Mesh with_normals =
      read("m.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 1 0\n0 1 0 1 0 0\n3 0 1 2\n");
  CHECK(with_normals.normals == difmesh::Array<Vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
}

TEST_CASE("obj: negative and forward indices and textures and joined lines") {
  check_square(read("m.obj",
                    "o square\nf 1 2 3\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0.5\n"
                    "usemtl none\ns off\nf -4 -2 \\\n -1 # a comment\n"));
  check_square(read("m.obj",
                    "v 0 0 0\nv +1 0 0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
                    "f 1/1 2/2 3/1\nf 1/1/1 3/2/1 4//1\n"));
  // Normals that do not go with the vertices are left out.
  CHECK(read("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//3 3//2\n")
            .normals.empty());
  CHECK(
      read("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 1 0\nf 1//-3 2//2 3//-1\n")
          .normals.size() == 3);
}

TEST_CASE("ply: both byte orders and other properties and elements are read") {
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\r\nformat ") +
                        (big ? "binary_big_endian" : "binary_little_endian") +
                        " 1.0\r\ncomment none\r\nobj_info none\r\nelement camera 2\r\n"
                        "property list ushort float views\r\nproperty short z\r\n"
                        "element vertex 4\r\nproperty uchar red\r\nproperty float32 x\r\n"
                        "property double y\r\nproperty int16 z\r\nproperty float nx\r\n"
                        "property float ny\r\nproperty float nz\r\nproperty list char int8 rest\r\n"
                        "element nothing 9223372036854775807\r\n"
                        "element face 2\r\nproperty uint flags\r\n"
                        "property list int ushort vertex_indices\r\nend_header\r\n";
    const auto put = [&](auto value) { bytes += test::bytes_of(value, big); };
    for (int camera = 0; camera < 2; ++camera) {
      put(static_cast<std::uint16_t>(camera));
      for (int view = 0; view < camera; ++view) {
        put(1.5F);
      }
      put(std::int16_t{-5});
    }
    for (int v = 0; v < 4; ++v) {
      put(std::uint8_t{200});
      put(static_cast<float>(v == 1 || v == 2));
      put(static_cast<double>(v >= 2));
      put(static_cast<std::int16_t>(v == 3 ? -2 : 7));
      put(0.5F);
      put(static_cast<float>(v));
      put(0.25F);
      put(std::int8_t{2});
      put(std::int8_t{1});
      put(std::int8_t{-1});
    }
    for (int f = 0; f < 2; ++f) {
      put(std::uint32_t{12345});
      put(std::int32_t{3});
      put(std::uint16_t{0});
      put(static_cast<std::uint16_t>(f + 1));
      put(static_cast<std::uint16_t>(f + 2));
    }
    const Mesh mesh = read("m.ply", bytes);
    CHECK(mesh.positions == difmesh::Array<Vec3>{{0, 0, 7}, {1, 0, 7}, {1, 1, 7}, {0, 1, -2}});
    CHECK(mesh.triangles == kTwoTriangles);
    REQUIRE(mesh.normals.size() == 4);
    CHECK(mesh.normals[3] == Vec3{0.5, 3, 0.25});
    CHECK(mesh.edge_ids.empty());
  }
}

TEST_CASE("ply: text with other properties is read") {
  check_square(read("m.ply",
                    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                    "property list uchar float weights\nproperty float z\nproperty uchar red\n"
                    "element face 2\nproperty list uchar int vertex_indices\nproperty int flags\n"
                    "element edge 1\nproperty int a\nend_header\n"
                    "0 0 2 0.1 nan 0 255\n1 0 0 0 255\n1 1 1 7 0 255\n0 1 0 0.5 255\n"
                    "3 0 1 2 -1\n3 0 2 3 5\n17\n"));
}

TEST_CASE("stl text is read with its corners welded") {
  check_square(read("m.stl",
                    "solid a name\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n"
                    "   vertex 1 0 0\n   vertex 1 1 0\n  endloop\n endfacet\n"
                    " FACET NORMAL nan 0 1\n  OUTER LOOP\n   VERTEX -0 0 0\n   vertex 1e0 1.0 0\n"
                    "   vertex 0 1 0.5\n  ENDLOOP\n ENDFACET\nendsolid a name\n"));
}

TEST_CASE("binary stl whose header starts with solid is read by its size") {
  std::string bytes = "solid but binary";
  bytes.resize(80, ' ');
  bytes += test::bytes_of(std::uint32_t{1}) + std::string(12, '\0');
  for (const float number : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) {
    bytes += test::bytes_of(number);
  }
  const Mesh mesh = read("m.stl", bytes + "ab");
  CHECK(mesh.triangles == difmesh::Array<Triangle>{{0, 1, 2}});
  CHECK(mesh.positions[2] == Vec3{0, 1, 0});
}

TEST_CASE("concurrent writers do not disturb each other") {
  const TempFolder folder;
  const Mesh mesh = sphere(12);
  std::vector<std::thread> threads;
  for (int n = 0; n < 8; ++n) {
    threads.emplace_back([&, n] {
      const char* const extension = n % 2 == 0 ? ".stl" : ".ply";
      difmesh::write_mesh(folder / (std::to_string(n) + extension), mesh);
      difmesh::write_mesh(folder / (std::string("same") + extension), mesh);
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  CHECK(folder.names().size() == 10);
  for (const char* extension : {".stl", ".ply"}) {
    const std::string number = extension[1] == 's' ? "0" : "1";
    const std::string first = test::read_bytes(folder / (number + extension));
    CHECK(test::read_bytes(folder / (std::string("same") + extension)) == first);
    CHECK(difmesh::read_mesh(folder / (std::string("same") + extension)).triangles.size() ==
          mesh.triangles.size());
  }
}

TEST_CASE("meshes from elsewhere are read with their published volumes") {
  const std::filesystem::path data = DIFMESH_SHARED_DATA;
  if (!std::filesystem::exists(data / "bunny00_75k.off")) {
    MESSAGE("skipped: no " << data.string());
    return;
  }
  const TempFolder folder;
  const Mesh bunny = difmesh::read_mesh(data / "bunny00_75k.off");
  CHECK(bunny.positions.size() == 37706);
  CHECK(bunny.triangles.size() == 75408);
  CHECK(bunny.positions[0] == Vec3{-0.167662, -0.411917, -0.0732205});
  CHECK(difmesh::measure(bunny).volume == doctest::Approx(0.1992055537).epsilon(1e-9));
  for (const char* name : {"m.ply", "m.obj", "m.off"}) {
    difmesh::write_mesh(folder / name, bunny);
    const Mesh back = difmesh::read_mesh(folder / name);
    CHECK(equal_bits(back.positions, bunny.positions));
    CHECK(back.triangles == bunny.triangles);
  }
  const Mesh golf = difmesh::read_mesh(data / "golfball_openscad_45k.off");
  CHECK(difmesh::measure(golf).volume == doctest::Approx(3.704174810).epsilon(1e-9));
  difmesh::write_mesh(folder / "m.stl", golf);
  const difmesh::Measure m = difmesh::measure(difmesh::read_mesh(folder / "m.stl"));
  CHECK(m.triangles == 44754);
  CHECK(m.volume == doctest::Approx(3.704174810).epsilon(1e-7));
}
