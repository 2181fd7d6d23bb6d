// PLY as other programs write it. Unless a test says otherwise its file is a cube of side 2 from
// (1, 1, 1) on: closed, 8 vertices, area 24, volume 8.

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "io/cube.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::MeshFile;
using test::bytes_of;
using test::check_cube;
using test::check_error;
using test::TempFolder;

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::vector<std::vector<int>> kFaces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

int coordinate(int corner, int axis) {
  return (corner >> axis & 1) != 0 ? 3 : 1;
}

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

std::string vertex_lines(const std::string& behind = "") {
  std::string lines;
  for (int v = 0; v < 8; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      lines += std::to_string(coordinate(v, axis)) + (axis < 2 ? " " : "");
    }
    lines += behind + "\n";
  }
  return lines;
}

std::string face_lines() {
  std::string lines;
  for (const std::vector<int>& side : kFaces) {
    lines += "4";
    for (const int corner : side) {
      lines += " " + std::to_string(corner);
    }
    lines += "\n";
  }
  return lines;
}

std::string cube(const std::string& list = "property list uchar int vertex_indices\n") {
  return header("ascii", "element vertex 8\n" + kXyz + "element face 6\n" + list) + vertex_lines() +
         face_lines();
}

/// Binary: float vertices, faces with lengths of type L and indices of type I.
template <class L, class I>
std::string binary_cube(const std::string& types, bool big_endian) {
  std::string bytes = header(
      big_endian ? "binary_big_endian" : "binary_little_endian",
      "element vertex 8\n" + kXyz + "element face 6\nproperty list " + types + " vertex_index\n");
  for (int v = 0; v < 8; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      bytes += bytes_of(static_cast<float>(coordinate(v, axis)), big_endian);
    }
  }
  for (const std::vector<int>& side : kFaces) {
    bytes += bytes_of(L{4}, big_endian);
    for (const int corner : side) {
      bytes += bytes_of(static_cast<I>(corner), big_endian);
    }
  }
  return bytes;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

MeshFile read(const std::string& bytes) {
  const TempFolder folder;
  return difmesh::read_mesh_file(folder.file("m.ply", bytes));
}

void check_silent_cube(const std::string& bytes) {
  CAPTURE(bytes);
  const MeshFile mesh = read(bytes);
  check_cube(mesh);
  CHECK(mesh.warnings.empty());
}

void check_refused(const std::string& bytes, std::initializer_list<std::string> words) {
  CAPTURE(bytes);
  check_error([&] { (void)read(bytes); }, ErrorCode::file_format, words);
}

}  // namespace

TEST_CASE("ply is read whatever ends its lines") {
  check_silent_cube(cube());
  check_silent_cube(replaced(cube(), "\n", "\r\n"));
  check_silent_cube(replaced(cube(), "\n", "\r"));
  // Binary data behind a header whose lines end otherwise; 0x0a and 0x0d may be the first byte.
  const std::string data = binary_cube<std::uint8_t, std::int32_t>("uchar int", false);
  const std::size_t end = data.find("end_header\n") + 11;
  check_silent_cube(replaced(data.substr(0, end), "\n", "\r") + data.substr(end));
  check_silent_cube(replaced(data.substr(0, end), "\n", "\r\n") + data.substr(end));
  for (const char* line_end : {"\n", "\r", "\r\n"}) {
    for (const std::uint8_t first : {std::uint8_t{10}, std::uint8_t{13}}) {
      const std::string text = header(
          "binary_little_endian", "element flag 1\nproperty uchar a\nelement vertex 1\n" + kXyz);
      std::string bytes = replaced(text, "\n", line_end) + bytes_of(first);
      for (const float number : {1.F, 2.F, 3.F}) {
        bytes += bytes_of(number);
      }
      const MeshFile mesh = read(bytes);
      REQUIRE(mesh.mesh.positions.size() == 1);
      CHECK(mesh.mesh.positions[0] == difmesh::Vec3{1, 2, 3});
    }
  }
}

TEST_CASE("ply with faces before vertices is read") {
  const std::string faces = "element face 6\nproperty list uchar int vertex_indices\n";
  const std::string vertices = "element vertex 8\n" + kXyz;
  check_silent_cube(header("ascii", faces + vertices) + face_lines() + vertex_lines());
  check_cube(read(header("ascii", faces + "element edge 1\nproperty int a\n" + vertices) +
                  face_lines() + "7\n" + vertex_lines()));
  const std::string text = binary_cube<std::uint8_t, std::int32_t>("uchar int", false);
  const std::string data = text.substr(text.find("end_header\n") + 11);
  check_silent_cube(header("binary_little_endian", faces + vertices) + data.substr(8 * 12) +
                    data.substr(0, 8 * 12));
  check_refused(
      header("ascii", faces + vertices) + replaced(face_lines(), "7", "8") + vertex_lines(),
      {"face 1", "vertex 8 of 8"});
  check_refused(header("ascii", faces), {"truncated"});
  check_refused(header("ascii", faces) + face_lines(), {"no element 'vertex'"});
}

TEST_CASE("ply lists of corners go by many names and types") {
  for (const char* name :
       {"vertex_indices", "vertex_index", "vertex_indexes", "vertices", "indices", "corners"}) {
    check_silent_cube(cube("property list uint8 int32 " + std::string(name) + "\n"));
  }
  for (const char* types : {"char char", "uchar uchar", "short short", "ushort ushort", "int int",
                            "uint uint", "int64 int64", "uint8 uint64"}) {
    check_silent_cube(cube("property list " + std::string(types) + " vertex_indices\n"));
  }
  for (const bool big : {false, true}) {
    check_silent_cube(binary_cube<std::int8_t, std::int8_t>("int8 int8", big));
    check_silent_cube(binary_cube<std::int16_t, std::uint8_t>("int16 uint8", big));
    check_silent_cube(binary_cube<std::uint16_t, std::int16_t>("uint16 int16", big));
    check_silent_cube(binary_cube<std::uint8_t, std::uint16_t>("uchar ushort", big));
    check_silent_cube(binary_cube<std::int32_t, std::uint32_t>("int uint", big));
    check_silent_cube(binary_cube<std::uint64_t, std::int64_t>("uint64 int64", big));
  }
  check_refused(cube("property list uchar float vertex_indices\n"), {"'face'", "vertex_indices"});
  check_refused(
      replaced(cube("property list uchar int a\nproperty list uchar int b\n"), "4 ", "0 4 "),
      {"'face'", "vertex_indices"});
}

TEST_CASE("ply polygons need not be convex") {
  // A dart of area 1, whose fan about the first corner has one of its triangles outside.
  const difmesh::Mesh dart =
      read(header("ascii", "element vertex 4\n" + kXyz +
                               "element face 1\nproperty list uchar int vertex_indices\n") +
           "0 0 0\n2 1 0\n0 2 0\n1 1 0\n4 0 1 2 3\n")
          .mesh;
  CHECK(difmesh::measure(dart).area == doctest::Approx(1.0).epsilon(1e-15));
  const difmesh::Mesh turned =
      read(header("ascii", "element vertex 4\n" + kXyz +
                               "element face 1\nproperty list uchar int vertex_indices\n") +
           "0 0 0\n2 1 0\n0 2 0\n1 1 0\n4 2 3 0 1\n")
          .mesh;
  CHECK(difmesh::measure(turned).area == doctest::Approx(1.0).epsilon(1e-15));
}

TEST_CASE("ply comments and obj_info stand anywhere in the header") {
  check_silent_cube(replaced(cube(), "property", "obj_info num_cols 512\ncomment\nproperty"));
  check_silent_cube(replaced(cube(), "ply\n", "ply \ncomment element vertex 9\n\n"));
}

TEST_CASE("ply normals that are no numbers are left out with a warning") {
  const std::string elements = "element vertex 8\n" + kXyz +
                               "property float nx\nproperty float ny\nproperty float nz\n" +
                               "element face 6\nproperty list uchar int vertex_indices\n";
  const MeshFile good = read(header("ascii", elements) + vertex_lines(" 0 0 1") + face_lines());
  check_cube(good);
  CHECK(good.mesh.normals.size() == 8);
  CHECK(good.warnings.empty());
  for (const char* normal : {" nan nan nan", " 0 -inf 1", " -nan(ind) 0 1", " 0 0 1e999"}) {
    CAPTURE(normal);
    std::string vertices = vertex_lines(" 0 0 1");
    vertices.replace(vertices.rfind(" 0 0 1"), 6, normal);
    const MeshFile mesh = read(header("ascii", elements) + vertices + face_lines());
    check_cube(mesh);
    CHECK(mesh.mesh.normals.empty());
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].find("normals") != std::string::npos);
  }
  std::string bytes = header(
      "binary_big_endian",
      "element vertex 1\n" + kXyz + "property double nx\nproperty double ny\nproperty double nz\n");
  for (const float number : {1.F, 2.F, 3.F}) {
    bytes += bytes_of(number, true);
  }
  for (const double number : {0.0, std::nan(""), 1.0}) {
    bytes += bytes_of(number, true);
  }
  const MeshFile mesh = read(bytes);
  CHECK(mesh.mesh.positions[0] == difmesh::Vec3{1, 2, 3});
  CHECK(mesh.mesh.normals.empty());
  CHECK(mesh.warnings.size() == 1);
}

TEST_CASE("ply elements and bytes that are left out are told") {
  const TempFolder folder;
  const auto warnings_of = [&](const std::string& bytes) {
    const MeshFile found = difmesh::read_mesh_file(folder.file("m.ply", bytes));
    check_cube(found);
    return found.warnings;
  };
  const std::string name = "'" + (folder / "m.ply").string() + "': ";
  const std::string elements =
      "element vertex 8\n" + kXyz + "element face 6\nproperty list uchar int vertex_indices\n";
  const std::string text = header("ascii", elements) + vertex_lines() + face_lines();
  using Texts = std::vector<std::string>;
  CHECK(warnings_of(text + "\n\n").empty());
  CHECK(warnings_of(text + "\n3 0 1 2\n") ==
        Texts{name + "what follows the data, from line 25 on, was left out."});
  const std::string edges = "property int vertex1\nproperty int vertex2\n";
  CHECK(warnings_of(header("ascii", elements + "element edge 2\n" + edges) + vertex_lines() +
                    face_lines() + "0 1\n2 3\n") ==
        Texts{name + "element 'edge' left out, 2 items."});
  CHECK(warnings_of(header("ascii", elements + "element edge 0\n" + edges) + vertex_lines() +
                    face_lines())
            .empty());

  std::string binary = header("binary_little_endian", elements);
  for (int v = 0; v < 8; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      binary += bytes_of(static_cast<float>(coordinate(v, axis)));
    }
  }
  for (const std::vector<int>& side : kFaces) {
    binary += "\4";
    for (const int corner : side) {
      binary += bytes_of(corner);
    }
  }
  CHECK(warnings_of(binary).empty());
  CHECK(warnings_of(binary + "\n") == Texts{name + "1 byte behind the data left out."});
  CHECK(warnings_of(binary + "xxxx") == Texts{name + "4 bytes behind the data left out."});
}

TEST_CASE("ply scalars that are no numbers or come twice are told") {
  const TempFolder folder;
  const std::string elements = "element vertex 8\n" + kXyz + "property float heat\n" +
                               "element face 6\nproperty list uchar int vertex_indices\n";
  const MeshFile found = difmesh::read_mesh_file(
      folder.file("m.ply", header("ascii", elements) + vertex_lines(" nan") + face_lines()));
  CHECK(found.mesh.scalars.empty());
  REQUIRE(found.warnings.size() == 1);
  CHECK(found.warnings[0].find("scalars 'heat' that are not finite left out") != std::string::npos);
}

TEST_CASE("ply strips become triangles that face the same way") {
  // Round the sides, then up over the top and, anew, the bottom.
  const std::string elements =
      "element vertex 8\n" + kXyz + "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::string strip = "10 4 0 5 1 7 3 6 2 4 0";
  const std::string closed = replaced(strip, "10 ", "20 ") + " -1 4 5 6 7 -1 1 0 3 2\n";
  check_silent_cube(header("ascii", elements) + vertex_lines() + closed);
  // The same in one go: corners twice lead from one part to the next.
  check_silent_cube(header("ascii", elements) + vertex_lines() +
                    "22 4 0 5 1 7 3 6 2 4 0 0 4 4 5 6 7 7 1 1 0 3 2\n");
  check_silent_cube(header("ascii",
                           "element tristrips 2\nproperty list int int vertex_indices\n"
                           "element vertex 8\n" +
                               kXyz) +
                    strip + "\n9 4 5 6 7 -1 1 0 3 2\n" + vertex_lines());
  check_refused(header("ascii", elements) + vertex_lines() + "3 0 1 8\n", {"strip 0", "vertex 8"});
  check_refused(header("ascii", elements) + vertex_lines() + "3 0 1 -2\n",
                {"strip 0", "vertex -2"});
  check_refused(header("ascii", elements) + vertex_lines() + "-3 0 1\n", {"strip 0", "length -3"});
  check_refused(header("ascii", elements) + vertex_lines() + "9 0 1 2\n", {"missing"});
}
