// STL as other programs write it. Unless a test says otherwise its file is a cube of side 2 from
// (1, 1, 1) on: closed, 8 vertices, area 24, volume 8.

#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "io/cube.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::Measure;
using difmesh::MeshFile;
using test::check_cube;
using test::check_error;
using test::TempFolder;

/// Corners x + 2 y + 4 z of the cube, counter-clockwise seen from outside.
constexpr std::array<std::array<int, 3>, 12> kFacets{{{0, 2, 1},
                                                      {1, 2, 3},
                                                      {4, 5, 6},
                                                      {5, 7, 6},
                                                      {0, 1, 4},
                                                      {1, 5, 4},
                                                      {2, 6, 3},
                                                      {3, 6, 7},
                                                      {0, 4, 2},
                                                      {2, 4, 6},
                                                      {1, 3, 5},
                                                      {3, 7, 5}}};

int coordinate(int corner, int axis) {
  return (corner >> axis & 1) != 0 ? 3 : 1;
}

/// How a program writes text.
struct Dialect {
  std::string start = "solid cube\n";
  std::string facet = "facet normal 0 0 1\n";
  std::string loop = "outer loop\n";
  std::string vertex = "vertex ";
  std::string end_of_vertex = "\n";
  std::string end_loop = "endloop\n";
  std::string end_facet = "endfacet\n";
  std::string end = "endsolid cube\n";
};

std::string stl(const Dialect& d, std::size_t first = 0, std::size_t last = 12) {
  std::string text = d.start;
  for (std::size_t f = first; f < last; ++f) {
    text += d.facet + d.loop;
    for (const int corner : kFacets[f]) {
      text += d.vertex;
      for (int axis = 0; axis < 3; ++axis) {
        text += std::to_string(coordinate(corner, axis)) + (axis < 2 ? " " : "");
      }
      text += d.end_of_vertex;
    }
    text += d.end_loop + d.end_facet;
  }
  return text + d.end;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

std::string binary(const std::string& header, std::uint32_t count) {
  std::string bytes = header;
  bytes.resize(80, '\0');
  bytes += test::bytes_of(count);
  for (const auto& facet : kFacets) {
    bytes += std::string(12, '\0');
    for (const int corner : facet) {
      for (int axis = 0; axis < 3; ++axis) {
        bytes += test::bytes_of(static_cast<float>(coordinate(corner, axis)));
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

MeshFile read(const std::string& bytes) {
  const TempFolder folder;
  return difmesh::read_mesh_file(folder.file("m.stl", bytes));
}

void check_silent_cube(const std::string& bytes) {
  CAPTURE(bytes);
  const MeshFile mesh = read(bytes);
  check_cube(mesh);
  CHECK(mesh.warnings.empty());
}

void check_warned_cube(const std::string& bytes, const std::string& word) {
  CAPTURE(bytes);
  const MeshFile mesh = read(bytes);
  check_cube(mesh);
  REQUIRE(mesh.warnings.size() == 1);
  CAPTURE(mesh.warnings[0]);
  CHECK(mesh.warnings[0].find("m.stl") != std::string::npos);
  CHECK(mesh.warnings[0].find(word) != std::string::npos);
}

void check_refused(const std::string& bytes, std::initializer_list<std::string> words) {
  CAPTURE(bytes);
  check_error([&] { (void)read(bytes); }, ErrorCode::file_format, words);
}

}  // namespace

TEST_CASE("stl text is read however its words are set") {
  check_silent_cube(stl({}));
  check_silent_cube(stl({.end_loop = "end loop\n"}));
  check_silent_cube(stl({.end_facet = "end facet\n"}));
  check_silent_cube(stl({.end = "end solid cube\n"}));
  check_silent_cube(stl({.end = "endsolidcube\n"}));
  check_silent_cube(stl({.end = "endsolid"}));
  check_silent_cube(stl({.start = "solid\n"}));
  check_silent_cube(stl({.start = "solidcube\n"}));
  check_silent_cube(stl({.start = "solid facet vertex endloop facet, normal\n"}));
  check_silent_cube(stl({.facet = "facet\n", .loop = "loop\n"}));
  check_silent_cube(stl({.facet = "facet normal nan -inf 0\n"}));
  check_silent_cube(stl({.facet = "\t facet normal 0 0 1\n\n", .end_loop = "  endloop \n"}));
  check_silent_cube(stl({.end_of_vertex = " 255 0 0\n"}));
  check_silent_cube(stl({.start = "SOLID CUBE\n",
                         .facet = "FACET NORMAL 0 0 1\n",
                         .loop = "OUTER LOOP\n",
                         .vertex = "VERTEX ",
                         .end_loop = "END LOOP\n",
                         .end_facet = "ENDFACET\n",
                         .end = "ENDSOLID CUBE\n"}));
  check_silent_cube(std::string(500, ' ') + "\n\n" + stl({}));
  check_silent_cube("\xEF\xBB\xBF" + stl({}));
}

TEST_CASE("names of solids may hold the words of stl") {
  for (const std::string name : {"facet normal outer loop", "Facet Normal", "facet normal 0 0 1",
                                 "vertex facet", "endfacet outer loop"}) {
    CAPTURE(name);
    check_silent_cube(stl({.start = "solid " + name + "\n", .end = "endsolid " + name + "\n"}));
  }
}

TEST_CASE("stl text is read whatever ends its lines") {
  check_silent_cube(replaced(stl({}), "\n", "\r\n"));
  check_silent_cube(replaced(stl({}), "\n", "\r"));
  check_silent_cube(replaced(stl({.start = "solid\n", .end = "endsolid\n"}), "\n", " "));
  check_silent_cube(
      replaced(stl({.start = "solid a name\n", .end_loop = "end loop\n"}), "\n", "  "));
  check_silent_cube(replaced(stl({.facet = "Facet  Normal 0 0 1\n"}), "\n", "\t"));
}

TEST_CASE("solids of an stl text are one mesh") {
  check_silent_cube(stl({}, 0, 5) + stl({.start = "solid b\n", .end = "endsolid b\n"}, 5, 12));
  check_silent_cube(stl({.end = ""}, 0, 5) + stl({.start = "solid b\n"}, 5, 12));
  check_silent_cube(stl({}, 0, 0) + stl({}));
}

TEST_CASE("stl text without endsolid is read with a warning") {
  check_warned_cube(stl({.end = ""}), "no endsolid");
  check_warned_cube(stl({.end_facet = "", .end = ""}), "no endsolid");
  check_warned_cube(stl({}, 0, 7) + stl({.start = "", .end = ""}, 7, 12), "no endsolid");
}

TEST_CASE("no triangle of an stl text is lost in silence") {
  const std::string whole = stl({});
  // Without the word that ends the third loop, and its kin.
  std::size_t at = 0;
  for (int n = 0; n < 3; ++n) {
    at = whole.find("endloop\n", at + 1);
  }
  std::string broken = whole;
  check_refused(broken.erase(at, 8), {"line 21", "no endloop"});
  check_refused(replaced(whole, "endloop\n", ""), {"line 7", "no endloop"});
  check_refused(stl({.end_loop = "", .end_facet = "", .end = ""}, 0, 1), {"truncated"});
  check_refused(stl({.end_loop = "", .end_facet = ""}, 0, 1), {"line 7", "no endloop"});
  check_refused(stl({.end_loop = "", .end_facet = ""}, 0, 2), {"line 7", "no endloop"});
  check_refused(stl({.end = "facet normal 0 0 1\n"}), {"truncated"});
  check_refused(stl({.end = "facet normal 0 0 1\nendfacet\nendsolid\n"}), {"no endloop"});
  check_refused(stl({.vertex = "vertex 1 2 3\nvertex "}), {"6 corners"});
  check_refused(stl({.vertex = "point "}), {"line 4", "'point'"});
  check_refused("solid cube\n", {"truncated"});
  check_refused("solid", {"truncated"});
  check_refused(replaced(whole, "3", "3,5"), {"'3,5'"});
  // Cut off anywhere it is an error, or warned of.
  for (std::size_t length = 0; length + 12 < whole.size(); ++length) {
    CAPTURE(length);
    try {
      const MeshFile part = read(whole.substr(0, length));
      CHECK(part.warnings.size() == 1);
    } catch (const difmesh::Error& error) {
      CHECK(error.code() == ErrorCode::file_format);
    }
  }
}

TEST_CASE("bytes behind binary stl are left out with a warning") {
  check_silent_cube(binary("", 12));
  check_warned_cube(binary("", 12) + "\n", "1 byte behind");
  check_warned_cube(binary("other program", 12) + std::string(777, 'x'), "777 bytes behind");
}

TEST_CASE("binary stl may start with solid") {
  check_silent_cube(binary("solid", 12));
  check_silent_cube(binary(std::string("solid cube") + std::string(70, ' '), 12));
  check_warned_cube(binary(std::string("solid cube") + std::string(70, ' '), 12) + "tail",
                    "4 bytes");
}

TEST_CASE("binary stl that is cut off or does not say its size is refused") {
  const std::string whole = binary("", 12);
  check_refused(whole.substr(0, whole.size() - 1), {"12 triangles are 684 bytes", "683 found"});
  check_refused(binary("solid", 13), {"13 triangles", "684 found"});
  check_refused(binary("", 0), {"0 triangles", "684 found"});
}

TEST_CASE("stl tells which triangles float32 makes collapse") {
  const TempFolder folder;
  difmesh::Mesh mesh;
  // Ulps of float32 at 500,000 are 1/32: the first two corners meet, the third stays apart.
  mesh.positions = {{500000.0, 0, 0},    {500000.01, 0, 0}, {500000.0, 1, 0},
                    {500000.0, 0, 0.01}, {500001.0, 0, 0},  {500000.012, 0.5, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 2}, {0, 4, 2}, {0, 1, 5}, {0, 5, 2}, {0, 0, 1}};
  const difmesh::MeshFileReport report = difmesh::write_mesh(folder / "m.stl", mesh);
  // Two lose a corner, the one before the last is a line then, the last one had no area.
  CHECK(report.collapsed_triangles == 3);
  CHECK(report.position_error == 500000.012 - 500000.0);
  const std::string wanted = "'" + (folder / "m.stl").string() + "': coordinates are off by up to ";
  REQUIRE(report.warnings.size() == 1);
  CHECK(report.warnings[0].find(wanted) == 0);
  CHECK(report.warnings[0].find("and 3 of 6 triangles collapse; PLY,") != std::string::npos);
  CHECK(difmesh::write_mesh(folder / "m.ply", mesh).warnings.empty());
  CHECK(difmesh::write_mesh(folder / "m.ply", mesh).collapsed_triangles == 0);
  const Measure back = difmesh::measure(difmesh::read_mesh(folder / "m.stl"));
  CHECK(back.degenerate_triangles == 4);
}

TEST_CASE("stl warns where float32 moves corners by more than a hundredth of an edge") {
  const TempFolder folder;
  difmesh::Mesh mesh;
  mesh.triangles = {{0, 1, 2}};
  // At 2^20 float32 rounds 1/16 away at most; edges have the lengths 4, 5 and 3 times `size`.
  for (const double size : {0.25, 0.75, 0.8, 100.0}) {
    const double off = 1048576.0 + 1.0 / 32.0;
    mesh.positions = {{off, 0, 0}, {off, 4 * size, 0}, {off, 0, 3 * size}};
    const difmesh::MeshFileReport report = difmesh::write_mesh(folder / "m.stl", mesh);
    CHECK(report.position_error == 1.0 / 32.0);
    CHECK(report.warnings.size() == (1.0 / 32.0 > 0.01 * 4.0 * size ? 1 : 0));
  }
  mesh.triangles.clear();
  CHECK(difmesh::write_mesh(folder / "m.stl", mesh).warnings.empty());
}
