#include "difmesh/io/mesh_format.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "difmesh/io/mesh_file.hpp"
#include "io/files.hpp"

namespace {

using difmesh::Compression;
using difmesh::ErrorCode;
using difmesh::Mesh;
using difmesh::MeshFormat;
using difmesh::WriteMeshOptions;
using test::check_error;
using test::TempFolder;

/// A tetrahedron with all that a mesh may have, of numbers that float32 does not hold.
Mesh full_tetrahedron() {
  Mesh mesh;
  mesh.positions = {{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}, {0.1, 1.2, 0.3}, {0.1, 0.2, 1.7}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  mesh.normals = {{-0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.edge_ids = {1, 4294967297, 1000000000000, 18446744073709551615U};
  mesh.scalars = {{"height", {0.3, 0.3, 0.3, 1.7}}};
  return mesh;
}

}  // namespace

TEST_CASE("formats are found by their extensions in any letters") {
  std::set<std::string> seen;
  for (const MeshFormat& format : difmesh::mesh_formats()) {
    std::string extension(format.extension);
    CAPTURE(extension);
    CHECK(seen.insert(extension).second);
    CHECK(difmesh::mesh_format_of("a.b/c" + extension) == &format);
    std::ranges::transform(extension, extension.begin(), [](char c) {
      return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    CHECK(difmesh::mesh_format_of("a/b" + extension) == &format);
    CHECK(difmesh::find_mesh_format(extension) == &format);
    CHECK(difmesh::find_mesh_format(extension.substr(1)) == &format);
  }
  CHECK(seen.contains(".ply"));
  CHECK(difmesh::mesh_format_of("a.ply/b") == nullptr);
  CHECK(difmesh::mesh_format_of("a.plyx") == nullptr);
  CHECK(difmesh::find_mesh_format("") == nullptr);
}

TEST_CASE("formats keep what the table says and nothing else") {
  const TempFolder folder;
  const Mesh mesh = full_tetrahedron();
  for (const MeshFormat& format : difmesh::mesh_formats()) {
    CAPTURE(format.name);
    const auto path = folder / ("m" + std::string(format.extension));
    if (!format.is_available()) {
      check_error([&] { difmesh::write_mesh(path, mesh); }, ErrorCode::unsupported,
                  {"cannot write", "built without " + std::string(format.needs)});
      check_error([&] { (void)difmesh::read_mesh(path); }, ErrorCode::unsupported,
                  {"built without " + std::string(format.needs)});
      continue;
    }
    difmesh::write_mesh(path, mesh);
    const Mesh back = difmesh::read_mesh(path);
    CHECK(back.triangles.size() == 4);
    CHECK(back.positions.size() == 4);
    CHECK((back.positions == mesh.positions) == format.exact);
    CHECK(back.normals.empty() == !format.normals);
    CHECK((!format.normals || (back.normals == mesh.normals) == format.exact));
    CHECK(back.edge_ids.empty() == !format.edge_ids);
    CHECK(back.scalars.size() == (format.scalars ? 1 : 0));
    const Mesh bare = [&] {
      difmesh::write_mesh(path, mesh, {.normals = false, .edge_ids = false, .scalars = false});
      return difmesh::read_mesh(path);
    }();
    CHECK((bare.normals.empty() && bare.edge_ids.empty() && bare.scalars.empty()));
  }
}

TEST_CASE("options that a format cannot honour are refused with those that can") {
  const TempFolder folder;
  const Mesh mesh = full_tetrahedron();
  const auto check = [&](const MeshFormat& format, bool is_taken, const std::string& option,
                         const WriteMeshOptions& options) {
    CAPTURE(option);
    const auto path = folder / ("m" + std::string(format.extension));
    if (!is_taken) {
      check_error([&] { difmesh::write_mesh(path, mesh, options); }, ErrorCode::invalid_argument,
                  {std::string(format.name), "option " + option, ".glb"});
      CHECK_FALSE(std::filesystem::exists(path));
    } else if (format.is_available()) {
      CHECK_NOTHROW(difmesh::write_mesh(path, mesh, options));
      std::filesystem::remove(path);
    }
  };
  for (const MeshFormat& format : difmesh::mesh_formats()) {
    CAPTURE(format.name);
    if (!format.is_available()) {
      continue;
    }
    check(format, format.colors, "color", {.color = difmesh::ColorBy{"height"}});
    check(format, format.scene, "up", {.up = difmesh::UpAxis::z});
    check(format, format.scene, "metres_per_unit", {.metres_per_unit = 0.5});
    check(format, format.scene, "local_origin", {.local_origin = difmesh::Vec3{0, 0, 0}});
    check(format, format.scene, "most_vertices", {.most_vertices = 65535});
    check(format, format.scene, "name", {.name = "drops"});
    if (format.compression == Compression::none) {
      check(format, false, "draco", {.draco = difmesh::DracoOptions{}});
    }
  }
}

TEST_CASE("scalars are looked at where the format has a place for them") {
  const TempFolder folder;
  Mesh mesh = full_tetrahedron();
  mesh.scalars[0].name = "no name for files";
  CHECK_NOTHROW(difmesh::write_mesh(folder / "m.obj", mesh));
  CHECK_NOTHROW(difmesh::write_mesh(folder / "m.ply", mesh, {.scalars = false}));
  mesh.scalars[0].values.pop_back();
  check_error([&] { difmesh::write_mesh(folder / "m.obj", mesh); }, ErrorCode::invalid_argument,
              {"3 values of 'no name for files' for 4 vertices"});
}
