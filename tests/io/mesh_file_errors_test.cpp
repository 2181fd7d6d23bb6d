// Meshes that cannot be written, and files that are no meshes.

#include <limits>
#include <string>

#include "difmesh/io/mesh_file.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::Mesh;
using test::check_error;
using test::TempFolder;

Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

void check_refused(const std::string& name, const std::string& bytes,
                   std::initializer_list<std::string> words,
                   ErrorCode code = ErrorCode::file_format) {
  const TempFolder folder;
  const auto path = folder.file(name, bytes);
  check_error([&] { (void)difmesh::read_mesh(path); }, code, {name});
  check_error([&] { (void)difmesh::read_mesh(path); }, code, words);
}

std::string ply(const std::string& format, const std::string& elements, const std::string& data) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + data;
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kCorners = "property list uchar int vertex_indices\n";

}  // namespace

TEST_CASE("meshes that are none are not written") {
  const TempFolder folder;
  const auto refused = [&](const Mesh& mesh, const char* name, ErrorCode code,
                           std::initializer_list<std::string> words) {
    check_error([&] { difmesh::write_mesh(folder / name, mesh); }, code, words);
    CHECK(folder.names().empty());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"m.ply", "m.obj", "m.off", "m.stl"}) {
    Mesh mesh = triangle();
    mesh.triangles.push_back({0, 1, 3});
    refused(mesh, name, ErrorCode::invalid_argument, {name, "triangle 1", "vertex 3 of 3"});
    mesh = triangle();
    mesh.positions[1][2] = nan;
    refused(mesh, name, ErrorCode::invalid_value, {name, "position of vertex 1", "nan"});
    mesh = triangle();
    mesh.normals = {{0, 0, 1}};
    refused(mesh, name, ErrorCode::invalid_argument, {name, "1 normals for 3 vertices"});
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, nan, 1}};
    refused(mesh, name, ErrorCode::invalid_value, {name, "normal of vertex 2"});
    mesh = triangle();
    mesh.edge_ids = {1, 2};
    refused(mesh, name, ErrorCode::invalid_argument, {name, "2 edge_ids for 3 vertices"});
  }
  Mesh large = triangle();
  large.positions[2][0] = -1e39;
  refused(large, "m.stl", ErrorCode::invalid_value, {"m.stl", "vertex 2", "float32"});
  for (const char* name : {"m.fbx", "m", "m.ply.gz", "ply"}) {
    refused(triangle(), name, ErrorCode::invalid_argument,
            {name, ".ply, .obj, .off, .stl, .glb, .gltf and .drc"});
    check_error([&] { (void)difmesh::read_mesh(folder / name); }, ErrorCode::file_format,
                {name, ".ply, .obj, .off, .stl, .glb, .gltf and .drc"});
  }
}

TEST_CASE("meshes that cannot be opened are named with the reason") {
  const TempFolder folder;
  for (const char* name : {"none.ply", "none.obj", "none.off", "none.stl"}) {
    check_error([&] { (void)difmesh::read_mesh(folder / name); }, ErrorCode::file_missing,
                {name, "No such file"});
  }
  std::filesystem::create_directory(folder / "folder.off");
  check_error([&] { (void)difmesh::read_mesh(folder / "folder.off"); }, ErrorCode::file_format,
              {"folder.off", "not a regular file"});
}

TEST_CASE("off: what is wrong is told with its line") {
  check_refused("m.off", "", {"empty"});
  check_refused("m.off", "ply\n", {"line 1", "'ply'"});
  check_refused("m.off", "4OFF\n1 0 0\n0 0 0 0\n", {"line 1", "'4'"});
  check_refused("m.off", "OFF BINARY\n", {"truncated"});
  check_refused("m.off", "OFF\n", {"number of vertices is missing"});
  check_refused("m.off", "OFF\n3\n", {"number of faces is missing"});
  check_refused("m.off", "OFF\n-3 1 0\n", {"number of vertices is -3"});
  check_refused("m.off", "OFF\n3 x 0\n", {"line 2", "'x'"});
  check_refused("m.off", "OFF\n1000000 1000000 0\n0 0 0\n", {"truncated", "1000000 vertices"});
  check_refused("m.off", "OFF\n4294967296 1 0\n", {"4294967296 vertices"}, ErrorCode::too_large);
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0 # end here\n", {"3 vertices wanted, 2 found"});
  check_refused("m.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", {"2 faces wanted, 1 found"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", {"line 4", "missing"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
                {"line 4", "vertex 1", "nan"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 1e999 0\n0 1 0\n3 0 1 2\n", {"line 4", "'1e999'"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", {"line 6", "vertex 3 of 3"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", {"line 6", "vertex -1"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", {"line 6", "2 corners"});
  check_refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n",
                {"line 6", "missing"});
}

TEST_CASE("obj: what is wrong is told with its line") {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  check_refused("m.obj", "v 0 0\n", {"line 1", "missing"});
  check_refused("m.obj", "v 0 0 1e999\n", {"line 1", "'1e999'"});
  check_refused("m.obj", "v 0 0 inf\nf 1 1 1\n", {"line 1", "vertex 0", "inf"});
  check_refused("m.obj", square + "f 1 2\n", {"line 5", "2 corners"});
  check_refused("m.obj", square + "f 1 2 5\nf 1 2 3\n", {"line 5", "vertex 5 of 4"});
  check_refused("m.obj", square + "f 1 2 0\n", {"line 5", "'0'"});
  check_refused("m.obj", square + "f 1 2 -5\n", {"line 5", "'-5'"});
  check_refused("m.obj", square + "f 1 2 x\n", {"line 5", "'x'"});
  check_refused("m.obj", square + "f 1 2 99999999999\n", {"line 5", "'99999999999'"});
  check_refused("m.obj", square + "\\\n\n# two lines more\nf 1 2 /3\n", {"line 8", "''"});
}

TEST_CASE("ply: what is wrong with the header is told with its line") {
  check_refused("m.ply", "", {"does not start with ply"});
  check_refused("m.ply", "plywood\n", {"does not start with ply"});
  check_refused("m.ply", "ply\n", {"no end_header"});
  check_refused("m.ply", "ply\nelement vertex 0\nend_header\n", {"no format"});
  check_refused("m.ply", ply("binary_middle_endian", "", ""), {"line 2", "binary_little_endian"});
  check_refused("m.ply", "ply\nformat ascii 2.0\nend_header\n", {"line 2"});
  check_refused("m.ply", ply("ascii", "nonsense\n", ""), {"line 3", "'nonsense'"});
  check_refused("m.ply", ply("ascii", "property float x\n", ""), {"line 3", "out of place"});
  check_refused("m.ply", ply("ascii", "element vertex\n", ""), {"line 3", "count"});
  check_refused("m.ply", ply("ascii", "element vertex -1\n", ""), {"line 3", "count"});
  check_refused("m.ply", ply("ascii", "element vertex 1\nproperty long x\n", ""), {"unknown type"});
  check_refused("m.ply", ply("ascii", "element face 1\nproperty list float int a\n", ""),
                {"length is no integer"});
  check_refused("m.ply", ply("ascii", "", ""), {"no element 'vertex'"});
  check_refused("m.ply",
                ply("ascii", "element vertex 1\nproperty float x\nproperty float y\n", "0 0\n"),
                {"x, y and z"});
  check_refused("m.ply",
                ply("ascii", "element vertex 0\n" + kXyz + "element vertex 0\n" + kXyz, ""),
                {"two elements"});
  check_refused(
      "m.ply",
      ply("ascii", "element vertex 0\n" + kXyz + "element face 1\nproperty int a\n", "1\n"),
      {"vertex_indices"});
  check_refused("m.ply", ply("ascii", "element vertex 0\n" + kXyz + "element tristrips 1\n", "0\n"),
                {"'tristrips'", "vertex_indices"});
}

TEST_CASE("ply: what is wrong with the data is told with its place") {
  const std::string elements = "element vertex 3\n" + kXyz + "element face 1\n" + kCorners;
  check_refused("m.ply", ply("ascii", elements, "0 0 0\n1 0 0\n0 1\n3 0 1 2\n"),
                {"line 12", "missing"});
  check_refused("m.ply", ply("ascii", elements, "0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n"),
                {"line 11", "more values"});
  check_refused("m.ply", ply("ascii", elements, "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
                {"line 11", "'nan'"});
  check_refused("m.ply", ply("ascii", elements, "0 0 0\n1 0 0\n0 1 0\n"), {"truncated"});
  check_refused("m.ply", ply("ascii", elements, "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                {"face 0", "vertex 3 of 3"});
  check_refused("m.ply", ply("ascii", elements, "0 0 0\n1 0 0\n0 1 0\n2 0 1\n"),
                {"face 0", "2 corners"});
  std::string data;
  for (const float number :
       {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, std::numeric_limits<float>::infinity(), 0.F}) {
    data += test::bytes_of(number);
  }
  check_refused("m.ply", ply("binary_little_endian", elements, data + std::string(13, '\3')),
                {"vertex 2", "y is not finite"});
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    check_refused("m.ply",
                  ply(format, "element vertex 1099511627776\n" + kXyz, std::string(99, ' ')),
                  {"truncated", "1099511627776"});
    check_refused(
        "m.ply",
        ply(format, "element vertex 0\n" + kXyz + "element face 1099511627776\n" + kCorners, "  "),
        {"truncated", "1099511627776"});
  }
  check_refused("m.ply", ply("ascii", "element vertex 5000000000\nproperty uchar x\n", ""),
                {"truncated"});
  const std::string list = "element extra 1\nproperty list int uchar a\n";
  check_refused("m.ply", ply("binary_little_endian", list, test::bytes_of(std::int32_t{-1})),
                {"length -1"});
  check_refused("m.ply",
                ply("binary_little_endian", list, test::bytes_of(std::int32_t{2147483647})),
                {"truncated"});
  const std::string ids = "property uint edge_id_low\nproperty uint edge_id_high\n";
  check_refused("m.ply", ply("ascii", "element vertex 1\n" + kXyz + ids, "0 0 0 -1 0\n"),
                {"vertex 0", "edge_id_low is -1"});
}

TEST_CASE("stl: what is wrong is told with numbers or the line") {
  check_refused("m.stl", "", {"0 bytes"});
  check_refused("m.stl", std::string(84 + 49, '\1'), {"16843009 triangles", "133 found"});
  std::string two = std::string(80, ' ') + test::bytes_of(std::uint32_t{2}) + std::string(99, '\0');
  check_refused("m.stl", two, {"2 triangles are 184 bytes", "183 found"});
  std::string bad = std::string(80, ' ') + test::bytes_of(std::uint32_t{1}) +
                    std::string(12, '\0') +
                    test::bytes_of(std::numeric_limits<float>::quiet_NaN()) + std::string(34, '\0');
  check_refused("m.stl", bad, {"triangle 0", "not finite"});
  const std::string facet = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  check_refused("m.stl", facet + "endloop\nendfacet\nendsolid\n", {"line 6", "2 corners"});
  check_refused("m.stl", facet + "vertex 0 1\nendloop\nendfacet\nendsolid\n",
                {"line 6", "missing"});
  check_refused("m.stl", facet + "vertex 0 1 0\nendfacet\nendsolid\n", {"line 7", "endloop"});
  check_refused("m.stl", facet + "vertex 0 1 0\n", {"truncated"});
  check_refused("m.stl", facet + "nonsense\n", {"line 6", "'nonsense'"});
}

TEST_CASE("no beginning of a good binary mesh is good") {
  const TempFolder folder;
  Mesh mesh = triangle();
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.edge_ids = {1, 2, 3};
  for (const char* name : {"m.ply", "m.stl"}) {
    difmesh::write_mesh(folder / name, mesh);
    const std::string bytes = test::read_bytes(folder / name);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      CAPTURE(length);
      const auto path = folder.file(name, bytes.substr(0, length));
      CHECK_THROWS_AS((void)difmesh::read_mesh(path), difmesh::Error);
    }
  }
}

TEST_CASE("a changed byte gives a mesh with valid indices or an error") {
  const TempFolder folder;
  Mesh mesh = triangle();
  mesh.positions.push_back({0.125, 3e-7, 22});
  mesh.normals.resize(4, {0, 0.6, 0.8});
  mesh.edge_ids = {1, 2, 3, std::uint64_t{1} << 40U};
  mesh.triangles.push_back({1, 3, 2});
  for (const char* name : {"m.ply", "m.obj", "m.off", "m.stl"}) {
    difmesh::write_mesh(folder / name, mesh);
    const std::string bytes = test::read_bytes(folder / name);
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const char change : {'\1', '\x10', '\x7f', '\x2a'}) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ change);
        const auto path = folder.file(name, changed);
        try {
          const Mesh back = difmesh::read_mesh(path);
          bool valid = back.normals.empty() || back.normals.size() == back.positions.size();
          for (const difmesh::Triangle& t : back.triangles) {
            valid = valid && std::max({t[0], t[1], t[2]}) < back.positions.size();
          }
          CHECK(valid);
        } catch (const difmesh::Error& error) {
          CHECK(std::string(error.what()).find(name) != std::string::npos);
        }
      }
    }
  }
}
