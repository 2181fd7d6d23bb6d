#include "difmesh/io/mesh_stream.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "difmesh/io/mesh_file.hpp"
#include "io/files.hpp"
#include "support/parametric_meshes.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::Mesh;
using difmesh::MeshFileReport;
using difmesh::MeshPortion;
using difmesh::MeshStream;
using difmesh::Triangle;
using difmesh::Vec3;
using difmesh::WriteMeshOptions;
using difmesh::test::parametric_mesh;
using test::check_error;
using test::TempFolder;

constexpr const char* kStreamed[]{".ply", ".obj", ".off", ".stl"};

/// A bent sheet of n x n vertices with all that a mesh may have.
Mesh full_sheet(std::uint32_t n) {
  Mesh mesh;
  mesh.scalars = {{"height", {}}, {"Other_1", {}}};
  const auto sheet = parametric_mesh({n, n}, [](std::uint32_t i, std::uint32_t j) {
    const double x = 0.1 * i;
    const double y = j / 3.0;
    return Vec3{x, y, std::sin(x * y)};
  });
  mesh.positions.assign(sheet.positions.begin(), sheet.positions.end());
  mesh.triangles.assign(sheet.triangles.begin(), sheet.triangles.end());
  for (std::uint32_t v = 0; v < n * n; ++v) {
    const auto& [x, y, z] = mesh.positions[v];
    mesh.normals.push_back({std::cos(x), std::sin(x), 0.1});
    mesh.edge_ids.push_back(std::uint64_t{v} * 4294967311U);
    mesh.scalars[0].values.push_back(z);
    mesh.scalars[1].values.push_back(-1.0 / (1 + v));
  }
  return mesh;
}

/// Hands on a mesh in portions of so many vertices, each with the triangles that are due then.
template <class Sink>
void cut(const Mesh& mesh, std::size_t vertices, const Sink& sink) {
  std::size_t triangle = 0;
  for (std::size_t begin = 0; begin < mesh.positions.size(); begin += vertices) {
    const std::size_t end = std::min(begin + vertices, mesh.positions.size());
    Mesh part;
    const auto take = [&](auto& to, const auto& from) {
      to.assign(from.begin() + static_cast<std::ptrdiff_t>(std::min(begin, from.size())),
                from.begin() + static_cast<std::ptrdiff_t>(std::min(end, from.size())));
    };
    take(part.positions, mesh.positions);
    take(part.normals, mesh.normals);
    take(part.edge_ids, mesh.edge_ids);
    for (const difmesh::VertexScalar& scalar : mesh.scalars) {
      part.scalars.push_back({scalar.name, {}});
      take(part.scalars.back().values, scalar.values);
    }
    for (; triangle < mesh.triangles.size(); ++triangle) {
      const Triangle& t = mesh.triangles[triangle];
      if (*std::max_element(t.begin(), t.end()) >= end) {
        break;
      }
      part.triangles.push_back(t);
    }
    sink(difmesh::portion_of(part));
  }
}

MeshFileReport stream(const std::filesystem::path& path, const Mesh& mesh, std::size_t vertices,
                      const WriteMeshOptions& options = {}) {
  MeshStream out(path, options);
  cut(mesh, vertices, [&](const MeshPortion& portion) { out.add(portion); });
  return out.finish();
}

void check_reports(const MeshFileReport& found, const MeshFileReport& wanted) {
  CHECK(found.bytes == wanted.bytes);
  CHECK(found.vertices == wanted.vertices);
  CHECK(found.triangles == wanted.triangles);
  CHECK(found.primitives == wanted.primitives);
  CHECK(found.position_error == wanted.position_error);
  CHECK(found.collapsed_triangles == wanted.collapsed_triangles);
}

}  // namespace

TEST_CASE("a streamed file has the bytes and the report of the whole mesh") {
  const TempFolder folder;
  // Of the second every part of the file outgrows the buffers.
  const Mesh small = full_sheet(5);
  const Mesh large = full_sheet(180);
  for (const std::string extension : kStreamed) {
    CAPTURE(extension);
    const auto whole = folder / ("whole" + extension);
    const auto streamed = folder / ("streamed" + extension);
    for (const std::size_t portion : {1UL, 2UL, 7UL, 25UL, 100UL}) {
      CAPTURE(portion);
      const MeshFileReport wanted = difmesh::write_mesh(whole, small);
      check_reports(stream(streamed, small, portion), wanted);
      CHECK(test::read_bytes(streamed) == test::read_bytes(whole));
    }
    const MeshFileReport wanted = difmesh::write_mesh(whole, large);
    check_reports(stream(streamed, large, 997), wanted);
    CHECK(test::read_bytes(streamed) == test::read_bytes(whole));
    const WriteMeshOptions bare{.normals = false, .edge_ids = false, .scalars = false};
    difmesh::write_mesh(whole, small, bare);
    stream(streamed, small, 4, bare);
    CHECK(test::read_bytes(streamed) == test::read_bytes(whole));
  }
}

TEST_CASE("triangles may come alone and in portions of their own") {
  const TempFolder folder;
  const Mesh mesh = full_sheet(4);
  for (const std::string extension : kStreamed) {
    CAPTURE(extension);
    difmesh::write_mesh(folder / ("whole" + extension), mesh);
    MeshStream out(folder / ("streamed" + extension));
    out.add({});
    MeshPortion vertices = difmesh::portion_of(mesh);
    vertices.triangles = {};
    out.add(vertices);
    for (const Triangle& t : mesh.triangles) {
      out.add({.triangles = {&t, 1}});
    }
    out.finish();
    CHECK(test::read_bytes(folder / ("streamed" + extension)) ==
          test::read_bytes(folder / ("whole" + extension)));
  }
}

TEST_CASE("a stream without a portion gives the file of an empty mesh") {
  const TempFolder folder;
  for (const std::string extension : kStreamed) {
    CAPTURE(extension);
    difmesh::write_mesh(folder / ("whole" + extension), Mesh{});
    check_reports(MeshStream(folder / ("streamed" + extension)).finish(),
                  difmesh::write_mesh(folder / ("whole" + extension), Mesh{}));
    CHECK(test::read_bytes(folder / ("streamed" + extension)) ==
          test::read_bytes(folder / ("whole" + extension)));
  }
}

TEST_CASE("a streamed file is there when it is finished and leaves nothing otherwise") {
  const TempFolder folder;
  const Mesh mesh = full_sheet(180);
  for (const std::string extension : kStreamed) {
    CAPTURE(extension);
    const std::string name = "m" + extension;
    const auto path = folder.file(name, "old");
    {
      MeshStream out(path);
      cut(mesh, 1000, [&](const MeshPortion& portion) { out.add(portion); });
      // The new one, and nothing of what waits.
      CHECK(folder.names().size() == 2);
      CHECK(test::read_bytes(path) == "old");
    }
    CHECK(test::read_bytes(path) == "old");
    CHECK(std::ranges::count(folder.names(), name) == 1);
    std::filesystem::remove(path);
    CHECK(folder.names().empty());
  }
}

TEST_CASE("streams into targets that are no files are written from their start to their end") {
  const TempFolder folder;
  const Mesh mesh = full_sheet(180);
  for (const std::string extension : kStreamed) {
    CAPTURE(extension);
    difmesh::write_mesh(folder / ("whole" + extension), mesh);
    const auto path = folder.file("open", "before ");
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    REQUIRE(descriptor >= 0);
    stream("/dev/fd/" + std::to_string(descriptor), mesh, 1000, {.format = extension});
    ::close(descriptor);
    CHECK(test::read_bytes(path) == "before " + test::read_bytes(folder / ("whole" + extension)));
    check_error([&] { stream("/dev/full", mesh, 1000, {.format = extension}); },
                ErrorCode::file_write, {"/dev/full", "No space left"});
  }
}

TEST_CASE("portions that do not fit are named by their place in the whole") {
  const TempFolder folder;
  const Mesh mesh = full_sheet(3);
  const auto refused = [&](const char* name, const MeshPortion& second,
                           std::initializer_list<std::string> words,
                           ErrorCode code = ErrorCode::invalid_argument) {
    MeshStream out(folder / name);
    out.add(difmesh::portion_of(mesh));
    check_error([&] { out.add(second); }, code, words);
  };
  Mesh bad = mesh;
  bad.triangles = {{0, 17, 2}, {0, 18, 1}};
  refused("m.ply", difmesh::portion_of(bad), {"m.ply", "triangle 9 refers to vertex 18 of 18"});
  bad = mesh;
  bad.positions[4][1] = std::numeric_limits<double>::infinity();
  refused("m.obj", difmesh::portion_of(bad), {"the position of vertex 13"},
          ErrorCode::invalid_value);
  bad.positions[4][1] = 1e39;
  refused("m.stl", difmesh::portion_of(bad), {"vertex 13", "STL's float32"},
          ErrorCode::invalid_value);
  bad = mesh;
  bad.scalars[1].values[0] = std::numeric_limits<double>::quiet_NaN();
  refused("m.ply", difmesh::portion_of(bad), {"'Other_1' of vertex 9 is nan"},
          ErrorCode::invalid_value);
  bad = mesh;
  bad.normals.clear();
  refused("m.off", difmesh::portion_of(bad), {"from 9 on", "normals"});
  bad = mesh;
  bad.scalars.pop_back();
  refused("m.ply", difmesh::portion_of(bad), {"from 9 on", "scalars"});
  bad.normals.pop_back();
  refused("m.ply", difmesh::portion_of(bad), {"8 normals for 9 vertices"});
  CHECK(folder.names().empty());
}

TEST_CASE("streams refuse formats that want the whole mesh and calls after the last") {
  const TempFolder folder;
  for (const difmesh::MeshFormat& format : difmesh::mesh_formats()) {
    const auto path = folder / ("m" + std::string(format.extension));
    if (!format.is_available()) {
      check_error([&] { MeshStream out(path); }, ErrorCode::unsupported, {"built without"});
    } else if (!format.streamed) {
      check_error([&] { MeshStream out(path); }, ErrorCode::invalid_argument, {"in portions"});
    }
  }
  check_error([&] { MeshStream out(folder / "m.doc"); }, ErrorCode::invalid_argument, {"'.doc'"});
  check_error([&] { MeshStream out(folder / "none" / "m.ply"); }, ErrorCode::file_write,
              {"m.ply", "No such file"});
  Mesh named = full_sheet(2);
  named.scalars[0].name = "nx";
  MeshStream taken(folder / "m.ply");
  check_error([&] { taken.add(difmesh::portion_of(named)); }, ErrorCode::invalid_argument,
              {"'nx'", "taken"});
  MeshStream out(folder / "m.obj");
  out.finish();
  check_error([&] { out.add({}); }, ErrorCode::invalid_argument, {"finished"});
  check_error([&] { out.finish(); }, ErrorCode::invalid_argument, {"finished"});
}
