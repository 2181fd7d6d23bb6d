// OBJ and OFF as other programs write them.

#include <cmath>
#include <string>
#include <vector>

#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::Mesh;
using difmesh::Triangle;
using difmesh::Vec3;
using test::TempFolder;

Mesh read(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  return difmesh::read_mesh(folder.file(name, bytes));
}

void check_refused(const std::string& name, const std::string& bytes,
                   std::initializer_list<std::string> words) {
  test::check_error([&] { (void)read(name, bytes); }, ErrorCode::file_format, words);
}

const difmesh::Array<Vec3> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};
const difmesh::Array<Triangle> kTwoTriangles{{0, 1, 2}, {0, 2, 3}};
const std::string kObjSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\n";

void check_square(const Mesh& mesh) {
  CHECK(mesh.positions == kSquare);
  CHECK(mesh.triangles == kTwoTriangles);
}

std::string big_endian(std::initializer_list<double> floats) {
  std::string bytes;
  for (const double number : floats) {
    bytes += test::bytes_of(static_cast<float>(number), true);
  }
  return bytes;
}

std::string big_endian_words(std::initializer_list<std::int32_t> words) {
  std::string bytes;
  for (const std::int32_t word : words) {
    bytes += test::bytes_of(word, true);
  }
  return bytes;
}

}  // namespace

TEST_CASE("obj: corners with texture coordinates and normals in every form") {
  for (const char* faces :
       {"f 1 2 3 4\n", "f 1/ 2/ 3/ 4/\n", "f 1/1 2/1 3/1 4/1\n", "f 1/1/ 2/1/ 3/1/ 4/1/\n",
        "f 1// 2// 3// 4//\n", "f 1//1 2//1 3//1 4//1\n", "f 1/1/1 2/1/1 3/1/1 4/1/1\n",
        "f -4 -3 -2 -1\n", "f -4/-1/-1 -3/-1/-1 -2/-1/-1 -1/-1/-1\n", "f 1 2 -2 \\\n 4\n",
        "f 1 2\\\r\n3\\\n\\\n4\n", "fo 1 2 3 4\n", "\tf   1  2\t3 4  \n", "f 1 2 3 4 # 5\n"}) {
    CAPTURE(faces);
    const Mesh mesh = read("m.obj", kObjSquare + "vt 0 0\nvn 0 0 1\n" + faces);
    check_square(mesh);
    CHECK(mesh.normals.empty());
  }
  check_refused("m.obj", kObjSquare + "f 1//x 2 3\n", {"line 5", "'x'"});
  check_refused("m.obj", kObjSquare + "f 1//0 2 3\n", {"line 5", "'0'"});
}

TEST_CASE("obj: normals that go with the vertices are kept and others are not") {
  const std::string normals = "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\nvn 0 0.6 0.8\n";
  const Mesh mesh = read("m.obj", kObjSquare + normals + "f 1//1 2//2 3//3 4//4\n");
  CHECK(mesh.normals == difmesh::Array<Vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0.6, 0.8}});
  for (const char* face : {"f 1//1 2//2 3//3 4\n", "f 1//1 2//2 3//4 4//4\n", "f 1 2 3 4\n",
                           "f 1//1 2//2 3//3 4//\n"}) {
    CAPTURE(face);
    CHECK(read("m.obj", kObjSquare + normals + face).normals.empty());
  }
}

TEST_CASE("obj: weights and colors after a vertex and what comes between are skipped") {
  check_square(
      read("m.obj",
           "# made by C:\\models\\\nmtllib a.mtl\no square\nv 0 0 0 1\nv 1 0 0 0.5 0.25 1\n"
           "g left\nusemtl red\ns off\nv 1 1 0 1 0 0 1\nv 0 1 .5\nl 1 2\np 1\nvt 0.5\n"
           "something else\nf 1 2 3 4\n"));
}

TEST_CASE("obj: a backslash at the end of a comment continues nothing") {
  check_square(
      read("m.obj", "v 0 0 0 # first \\\nv 1 0 0\n# C:\\\\\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4"));
}

TEST_CASE("obj: faces may come before their vertices") {
  check_square(read("m.obj", "f 1 2 3 4\n" + kObjSquare));
  check_refused("m.obj", "v 0 0 0\nf 1 2 3\nv 1 0 0\n", {"line 2", "vertex 3 of 2"});
  check_refused("m.obj", "f -1 -2 -3\n" + kObjSquare, {"line 1", "'-1'", "0 vertices"});
}

TEST_CASE("obj: files of other kinds and empty ones are no empty meshes") {
  check_refused("m.obj", "", {"an empty file"});
  check_refused("m.obj", "\n \r\n\t\n", {"an empty file"});
  check_refused("m.obj", "<!DOCTYPE html>\n<html>\n<p>\n", {"line 1", "'<!DOCTYPE'", "no OBJ"});
  check_refused("m.obj", "\n# A title\n\nDear all,\n\np 7 is wrong.\n", {"line 4", "'Dear'"});
  check_refused("m.obj", "404: Not Found", {"line 1", "'404:'"});
  check_refused("m.obj", "OFF\n3 1 0\n", {"line 1", "'OFF'"});
  check_refused("m.obj", std::string("glTF\x02\0\0\0", 8), {"line 1", "'glTF\\x02"});
  for (const char* empty : {"# nothing\n", "g nothing\n", "o a\nmtllib a.mtl\n"}) {
    CAPTURE(empty);
    const Mesh mesh = read("m.obj", empty);
    CHECK(mesh.positions.empty());
    CHECK(mesh.triangles.empty());
  }
}

TEST_CASE("what is not finite is left out where the surface does without it") {
  const std::string face = "f 1//1 2//2 3//3\n";
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* bad :
       {"nan nan nan", "0 inf 0", "0 0 -inf", "NaN 0 0", "-nan 0 0", "0 nan(ind) 0"}) {
    CAPTURE(bad);
    // An unused vertex goes, and the numbers of those behind it follow.
    const Mesh mesh = read("m.obj", std::string("v ") + bad + "\n" + points + "f 2 3 4\n");
    CHECK(mesh.positions == difmesh::Array<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.triangles == difmesh::Array<Triangle>{{0, 1, 2}});
    // Normals go all together.
    const Mesh bare = read("m.obj", points + "vn 0 0 1\nvn " + bad + "\nvn 0 0 1\n" + face);
    CHECK(bare.triangles == difmesh::Array<Triangle>{{0, 1, 2}});
    CHECK(bare.normals.empty());
    const Mesh both = read("m.off", std::string("NOFF\n4 1 0\n0 0 0 0 0 1\n") + bad +
                                        " 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 2 3\n");
    CHECK(both.positions == difmesh::Array<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(both.triangles == difmesh::Array<Triangle>{{0, 1, 2}});
    CHECK(both.normals.size() == 3);
    const Mesh off = read("m.off", std::string("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 ") + bad +
                                       "\n0 1 0 0 0 1\n3 0 1 2\n");
    CHECK(off.positions.size() == 3);
    CHECK(off.normals.empty());
    // What a triangle needs is an error, told with its line.
    check_refused("m.obj", points + "v " + bad + "\nf 1 2 3\nf 2 3 4\n",
                  {"line 4", "vertex 3", "triangle 1", "not finite"});
    check_refused("m.obj", points + "v " + bad + "\nf 1 2 4 3\n", {"line 4", "vertex 3"});
    check_refused("m.off", std::string("OFF\n3 1 0\n0 0 0\n\n") + bad + "\n0 1 0\n3 0 1 2\n",
                  {"line 5", "vertex 1", "triangle 0"});
  }
  // The normals that stay belong to the vertices that stay.
  const Mesh mesh = read("m.obj",
                         "v 0 0 0\nv nan 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nvn 0 1 0\n"
                         "vn 0 0 1\nvn 0 0.6 0.8\nf 1//1 3//3 4//4\n");
  CHECK(mesh.normals == difmesh::Array<Vec3>{{1, 0, 0}, {0, 0, 1}, {0, 0.6, 0.8}});
}

TEST_CASE("off: keywords in any letters and glued to the counts and none") {
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n";
  for (const char* head :
       {"OFF\n4 1 0\n", "OFF4 1 0\n", "off 4 1 0\n", "Off\n4\n1\n", "OFF4\n1 0\n", "4 1 0\n",
        "# no keyword\n4 1\n", "COFF 4 1 4\n", "stcoff4 1\n"}) {
    CAPTURE(head);
    check_square(read("m.off", head + points + "4 0 1 2 3\n"));
  }
  const Mesh mesh = read("m.off",
                         "cnoff\n3 1 0\n0 0 0 0 0 1 9 9 9 9\n1 0 0 0 1 0 9 9 9 9\n"
                         "0 1 0 1 0 0 9 9 9 9\n3 0 1 2\n");
  CHECK(mesh.normals == difmesh::Array<Vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
  check_refused("m.off", "nOFF\n3\n4 1 0\n" + points, {"line 1", "kind 'n'"});
  check_refused("m.off", "4nOFF\n3\n4 1 0\n" + points, {"line 1", "kind '4n'"});
  check_refused("m.off", "OFFER 4 1 0\n" + points, {"line 1", "'OFFER'"});
  check_refused("m.off", "version https://example.org\n", {"line 1", "'version'"});
  check_refused("m.off", "<html>\n", {"line 1", "'<html>'"});
}

TEST_CASE("off: vertices and faces anywhere in lines") {
  for (const char* text :
       {"OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 1 .5 3 0 1 2 3 0 2 3",
        "OFF 4 2 0\n0 0 0 1 0 0 1 1 0 0 1 .5\n3 0 1 2 3 0 2 3\n",
        "OFF\n4 2 5\n0\n0\n0\n1 0\n0 1\n1 0\n0 1 .5\n3\n0\n1 2 3 0 2\n3\n",
        "OFF\n4 2 0\n0 0\n0\n1 0 0\n1 1\n0\n0 1 .5\n3 0\n1 2 255 0 0\n3 0 2\n3 0.5 0.5 0.5 1\n",
        "off\n4\n2\n0\n0 0 0 1 0 0\n1 1 0 0 1 .5\n3 0 1 2\n3 0 2 3\n",
        "COFF 4 2 0 0 0 0 9 9 9 9 1 0 0 9 9 9 9 1 1 0 9 9 9 9 0 1 .5 9 9 9 9 3 0 1 2 3 0 2 3",
        "OFF\n4 2 0\n0 0 0 7 7 7\n1 0 0\n1 1 0 # red\n0 1 .5\n3 0 1 2 7\n3 0 2 3\n",
        "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n3 0 1 2\n3 0 2 3\n# and\n{ more }\n"}) {
    CAPTURE(text);
    check_square(read("m.off", text));
  }
  // A number too few or too many is no other layout.
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", {"line 4", "missing"});
  check_refused("m.off", "OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1", {"truncated"});
  check_refused("m.off", "OFF 3 2 0 0 0 0 1 0 0 0 1 0 3 0 1 2 3 0 1", {"truncated"});
}

TEST_CASE("off: binary files") {
  const std::string points = big_endian({0, 0, 0}) + big_endian({1, 0, 0}) + big_endian({1, 1, 0}) +
                             big_endian({0, 1, .5});
  const std::string counts = big_endian_words({4, 2, 0});
  const std::string faces =
      big_endian_words({3, 0, 1, 2, 0, 3, 0, 2, 3, 3}) + big_endian({0.5, 0.25, 1});
  check_square(read("m.off", "OFF BINARY\n" + counts + points + faces));
  check_square(read("m.off", "# comment\r\noff binary\r\n" + counts + points + faces));
  const Mesh mesh = read("m.off", "CNOFF BINARY\n" + big_endian_words({3, 1, 0}) +
                                      big_endian({0, 0, 0, 0, 0, 1, 9, 9, 9, 9}) +
                                      big_endian({1, 0, 0, 0, 1, 0, 9, 9, 9, 9}) +
                                      big_endian({0, 1, 0, 1, 0, 0, 9, 9, 9, 9}) +
                                      big_endian_words({3, 0, 1, 2, 0}));
  CHECK(mesh.positions == difmesh::Array<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(mesh.normals == difmesh::Array<Vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
  CHECK(mesh.triangles == difmesh::Array<Triangle>{{0, 1, 2}});
  const std::string whole = "OFF BINARY\n" + counts + points + faces;
  for (std::size_t length = 11; length < whole.size(); ++length) {
    CAPTURE(length);
    check_refused("m.off", whole.substr(0, length), {"truncated"});
  }
  check_refused("m.off", "OFF BINARY\n" + big_endian_words({-1, 2, 0}), {"negative"});
  check_refused("m.off", "OFF BINARY\n" + big_endian_words({2147483647, 2147483647, 0}) + points,
                {"truncated"});
  check_refused("m.off",
                "OFF BINARY\n" + counts + points + big_endian_words({3, 0, 1, 4, 0}) + faces,
                {"face 0", "vertex 4 of 4"});
  check_refused("m.off", "OFF BINARY\n" + counts + points + big_endian_words({2, 0, 1, 0}) + faces,
                {"face 0", "2 corners"});
  check_refused("m.off",
                "OFF BINARY\n" + counts + big_endian({0, NAN, 0}) + points.substr(12) + faces,
                {"vertex 0", "not finite"});
}

TEST_CASE("obj and off: what is left out is told") {
  const TempFolder folder;
  const auto warnings_of = [&](const std::string& name, const std::string& text) {
    return difmesh::read_mesh_file(folder.file(name, text)).warnings;
  };
  const auto check_told = [&](const std::string& name, const std::string& text,
                              const std::string& matter) {
    CAPTURE(matter);
    const std::vector<std::string> warnings = warnings_of(name, text);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] == "'" + (folder / name).string() + "': " + matter + ".");
  };
  const std::string face = "f 1//1 2//2 3//3\n";
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK(warnings_of("m.obj", points + "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\n" + face).empty());
  CHECK(warnings_of("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n# end\n").empty());
  check_told("m.obj", points + "vn 0 0 1\nvn nan 0 1\nvn 0 0 1\n" + face,
             "left out the normals, as some are not finite");
  check_told("m.obj", points + "v 0 nan 0\nf 1 2 3\n",
             "left out 1 vertex without finite coordinates, which no triangle uses");
  check_told("m.off", "OFF\n5 1 0\ninf 0 0\n0 0 0\n1 0 0\n0 1 0\nnan 0 0\n3 1 2 3\n",
             "left out 2 vertices without finite coordinates, which no triangle uses");
  check_told("m.obj", points + "surf 0 1 0 1 1 2 3\ncurv 0 1 1 2\nf 1 2 3\n",
             "skipped 2 lines of curves or surfaces that are no polygons");
  check_told("m.obj", points + "l 1 2 3\nf 1 2 3\nl 1 2\n",
             "skipped 2 lines of lines between points");
  check_told("m.obj", points + "p 1\nf 1 2 3\n", "skipped 1 line of points");
  check_told("m.obj", points + "call other.obj\nf 1 2 3\n",
             "skipped 1 line of calls of other files or programs");
  check_told("m.obj", points + "bzp 1 2 3\nf 1 2 3\nsurf 0 1 0 1 1 2 3\n",
             "skipped 2 lines of curves or surfaces that are no polygons");
  CHECK(warnings_of("m.obj", "mtllib a\no b\ng c\ns 1\n" + points + "vt 0 0\nf 1 2 3\n").empty());
  check_told("m.obj", points + "f 1 2 3\nfacet 1\n\x01\n",
             "skipped 2 lines unknown to OBJ, the first of them line 5, which starts with 'facet'");
  check_told("m.obj", points + "v 2 2 0\nf 1 2 3\nf 1 4 2 3\n",
             "cut 1 polygon with sides that cross into triangles that overlap, the first of them "
             "triangle 1");
  check_told("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n{ appearance }\n",
             "skipped what follows the last face, from line 7 on");
  check_told("m.off", "OFF\n3 1 0\n0 0 0 1 0 0\n0 1 0 3 0 1 2\n3 0 2\n1 3 0 1 2\n",
             "skipped what follows the last face, from line 5 on");
}

TEST_CASE("off: messages are those of the layout that the file has") {
  const std::string corners = "OFF\n3 2 0\n0 0 0 1 0 0 0 1 0 ";
  check_refused("m.off", corners + "3 0 1 2 3 1",
                {"line 3: truncated: a corner of the face is missing"});
  check_refused("m.off", corners + "3 0 1 2", {"2 faces wanted, 1 found"});
  check_refused("m.off", corners + "3 0 1 7 3 0 1 2", {"line 3: face 0 refers to vertex 7 of 3"});
  check_refused("m.off", corners + "3 0 1 2 3 0 1 2 2 0 1", {"line 3: a face with 2 corners"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0 1 0 0\n0 1 0\n3 0 1 9\n",
                {"line 5: face 0 refers to vertex 9 of 3"});
  const std::string lines = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
  check_refused("m.off", lines + "3 0 1 2\n", {"2 faces wanted, 1 found"});
  check_refused("m.off", lines + "3 0 1 2\n3 0 1\n", {"line 7: a corner of the face is missing"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
                {"line 4: a coordinate is missing"});
  check_refused("m.off", "COFF\n3 2 0\n0 0 0 9 9 9 9\n1 0 0 9 9 9 9\n0 1 0 9 9 9 9\n3 0 1 2\n",
                {"2 faces wanted, 1 found"});
}

TEST_CASE("obj and off: huge faces that are not convex are cut") {
  // A comb of 100,000 teeth: one face of 200,003 corners, 400,000 triangles' worth of test would
  // do.
  std::string text = "v 0 -1 0\n";
  std::string face = "f 1";
  constexpr int kTeeth = 100000;
  for (int t = kTeeth; t >= 0; --t) {
    text += "v " + std::to_string(2 * t + 1) + " 0 0\nv " + std::to_string(2 * t) + " " +
            std::to_string(1 + t % 3) + " 0\n";
    face += " " + std::to_string(2 * (kTeeth - t) + 2) + " " + std::to_string(2 * (kTeeth - t) + 3);
  }
  const Mesh mesh = read("m.obj", text + face + "\n");
  REQUIRE(mesh.triangles.size() == 2 * kTeeth + 1);
  double area = 0.0;
  double total = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3& b = mesh.positions[t[1]];
    const Vec3& c = mesh.positions[t[2]];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    area += 0.5 * twice;
    total += 0.5 * std::abs(twice);
  }
  CHECK(area == doctest::Approx(total).epsilon(1e-12));
  CHECK(area > 0.0);
}
