// What was written, as the C interface tells it, against the files themselves.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "handles.hpp"
#include "io/files.hpp"
#include "support/differences.hpp"

namespace {

using test::TempFolder;
namespace c = difmesh::test;

c::MeshHandle surface() {
  return c::c_reconstruct(c::c_field(c::blob({12, 11, 10})));
}

difmesh::Mesh read_mesh(const std::filesystem::path& path) {
  dif_mesh* mesh = nullptr;
  const dif_status status = dif_mesh_read(path.c_str(), &mesh);
  INFO(std::string(dif_last_message()));
  REQUIRE(status == DIF_OK);
  return c::mesh_of(c::MeshHandle(mesh).get());
}

dif_mesh_write_report write_reported(const c::MeshHandle& mesh, const std::filesystem::path& path,
                                     const dif_mesh_write_options* options = nullptr) {
  dif_mesh_write_report report = c::prepared(dif_mesh_write_report_init);
  const dif_status status = dif_mesh_write(mesh.get(), path.c_str(), options, &report);
  INFO(std::string(dif_last_message()));
  REQUIRE(status == DIF_OK);
  CHECK(report.struct_size == sizeof report);
  CHECK(report.bytes == static_cast<std::int64_t>(std::filesystem::file_size(path)));
  return report;
}

// Three corners per triangle, as they are in the bytes of an STL file.
difmesh::Array<difmesh::Vec3> stl_corners(const std::string& bytes) {
  difmesh::Array<difmesh::Vec3> corners;
  for (std::size_t record = 84; record < bytes.size(); record += 50) {
    for (std::size_t at = record + 12; at < record + 48; at += 12) {
      float numbers[3];
      std::memcpy(numbers, bytes.data() + at, sizeof numbers);
      corners.push_back({numbers[0], numbers[1], numbers[2]});
    }
  }
  return corners;
}

difmesh::Array<difmesh::Vec3> corners_of(const difmesh::Mesh& mesh) {
  difmesh::Array<difmesh::Vec3> corners;
  for (const difmesh::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      corners.push_back(mesh.positions[v]);
    }
  }
  return corners;
}

// A surface between the numbers that float32 has, and a vertex of no triangle that is further off
// them.
c::MeshHandle surface_with_a_stray_vertex() {
  const c::OwnedField blob = c::blob({12, 11, 10});
  dif_field field = c::c_field(blob);
  field.origin[0] = 4.1;
  field.spacing[1] = 0.3;
  difmesh::Mesh mesh = c::mesh_of(c::c_reconstruct(field).get());
  mesh.positions.push_back({1e6 + 0.01, 0.0, 0.0});
  dif_mesh* made = nullptr;
  REQUIRE(dif_mesh_from_arrays(mesh.positions.data()->data(),
                               static_cast<std::int64_t>(mesh.positions.size()),
                               mesh.triangles.data()->data(),
                               static_cast<std::int64_t>(mesh.triangles.size()), &made) == DIF_OK);
  return c::MeshHandle(made);
}

}  // namespace

TEST_CASE("a report tells what is in tables of numbers") {
  const TempFolder folder;
  const auto mesh = surface_with_a_stray_vertex();
  const difmesh::Mesh before = c::mesh_of(mesh.get());
  const auto vertices = static_cast<std::int64_t>(before.positions.size());
  const auto triangles = static_cast<std::int64_t>(before.triangles.size());
  for (const char* name : {"m.ply", "m.obj", "m.off", "m.stl"}) {
    INFO(std::string(name));
    const bool stl = name == std::string("m.stl");
    const dif_mesh_write_report report = write_reported(mesh, folder / name);
    CHECK(report.vertices == (stl ? 3 * triangles : vertices));
    CHECK(report.triangles == triangles);
    CHECK(report.primitives == 1);
    CHECK(report.position_bits == 0);
    CHECK(report.reserved == 0);
    CHECK(report.collapsed_triangles == 0);
    CHECK(std::ranges::all_of(report.local_origin, [](double x) { return x == 0.0; }));
    if (stl) {
      const std::string bytes = ::test::read_bytes(folder / name);
      CHECK(report.position_error > 0.0);
      CHECK(report.position_error == c::largest_difference(stl_corners(bytes), corners_of(before)));
    } else {
      CHECK(report.position_error == 0.0);
      CHECK(read_mesh(folder / name).positions == before.positions);
    }
    const std::string bytes = ::test::read_bytes(folder / name);
    REQUIRE(dif_mesh_write(mesh.get(), (folder / name).c_str(), nullptr, nullptr) == DIF_OK);
    CHECK(::test::read_bytes(folder / name) == bytes);
  }
}

TEST_CASE("a report tells what glTF and Draco made of a mesh") {
  if (dif_has(DIF_PART_GLTF) == 0 || dif_has(DIF_PART_DRACO) == 0) {
    return;
  }
  const TempFolder folder;
  const auto mesh = surface();
  const difmesh::Mesh before = c::mesh_of(mesh.get());
  const dif_measure facts = c::measured(mesh.get());
  const double side = c::longest_side(facts);
  const auto found_error = [&](const char* name) {
    return c::largest_difference(read_mesh(folder / name).positions, before.positions);
  };
  dif_mesh_write_options options = c::prepared(dif_mesh_write_options_init);
  options.draco_method = DIF_DRACO_SEQUENTIAL;  // the order of the vertices is kept
  for (const char* name : {"m.glb", "m.gltf"}) {
    const dif_mesh_write_report plain = write_reported(mesh, folder / name);
    CHECK(plain.position_bits == 0);
    CHECK(plain.position_error > 0.0);
    CHECK(found_error(name) <= plain.position_error);
    CHECK(found_error(name) >= 0.25 * plain.position_error);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(plain.local_origin[axis] == 0.5 * facts.low[axis] + 0.5 * facts.high[axis]);
    }
  }
  for (const std::int32_t bits : {0, 7, 15}) {
    for (const char* name : {"m.glb", "m.drc"}) {
      INFO(std::string(name) << ", " << bits);
      options.draco = name == std::string("m.glb") ? 1 : 0;
      options.position_bits = bits;
      options.cell_size = 0.25;
      const dif_mesh_write_report report = write_reported(mesh, folder / name, &options);
      const auto half_step = [&](std::int32_t of) { return side / (2.0 * (std::exp2(of) - 1.0)); };
      if (bits == 0) {  // as few as keep half a step within a thousandth of cell_size
        CHECK(half_step(report.position_bits) <= 1e-3 * 0.25);
        CHECK(half_step(report.position_bits - 1) > 1e-3 * 0.25);
      } else {
        CHECK(report.position_bits == bits);
      }
      CHECK(report.vertices == facts.vertices);
      CHECK(report.triangles == facts.triangles);
      CHECK(report.primitives == 1);
      CHECK(found_error(name) <= report.position_error);
      CHECK(found_error(name) >= 0.5 * report.position_error);
    }
  }
}

TEST_CASE("a report counts the parts of a split mesh and knows a local origin that was chosen") {
  if (dif_has(DIF_PART_GLTF) == 0) {
    return;
  }
  const TempFolder folder;
  const auto mesh = surface();
  const difmesh::Mesh before = c::mesh_of(mesh.get());
  dif_mesh_write_options options = c::prepared(dif_mesh_write_options_init);
  options.most_vertices = 100;
  options.has_local_origin = 1;
  options.local_origin[1] = -2.5;
  const dif_mesh_write_report report = write_reported(mesh, folder / "m.glb", &options);
  CHECK(report.triangles == static_cast<std::int64_t>(before.triangles.size()));
  CHECK(report.primitives * 100 >= report.vertices);
  CHECK(report.vertices > static_cast<std::int64_t>(before.positions.size()));
  CHECK(report.local_origin[0] == 0.0);
  CHECK(report.local_origin[1] == -2.5);
}

TEST_CASE("reports of older and newer programs are filled as far as they reach") {
  const TempFolder folder;
  const auto mesh = surface();
  const dif_mesh_write_report whole = write_reported(mesh, folder / "m.ply");
  for (std::size_t size = 8; size <= sizeof whole + 16; size += 8) {
    INFO(size);
    std::vector<std::uint64_t> words(sizeof whole / 8 + 3, 0xA5A5A5A5A5A5A5A5U);
    words[0] = size;
    auto* report = reinterpret_cast<dif_mesh_write_report*>(words.data());
    REQUIRE(dif_mesh_write(mesh.get(), (folder / "m.ply").c_str(), nullptr, report) == DIF_OK);
    CHECK(words[0] == size);
    const std::size_t known = std::min(size, sizeof whole);
    CHECK(std::memcmp(words.data() + 1, reinterpret_cast<const char*>(&whole) + 8, known - 8) == 0);
    for (std::size_t word = known / 8; word < words.size(); ++word) {
      CHECK(words[word] == (word < size / 8 ? 0 : 0xA5A5A5A5A5A5A5A5U));
    }
  }
}

TEST_CASE("what fails leaves the report as it was and no file") {
  const TempFolder folder;
  const auto mesh = surface();
  dif_mesh_write_report report = c::prepared(dif_mesh_write_report_init);
  report.bytes = 77;
  report.position_error = 0.5;
  const dif_mesh_write_report before = report;
  const auto untouched = [&] { return std::memcmp(&report, &before, sizeof report) == 0; };
  dif_mesh_write_options ply = c::prepared(dif_mesh_write_options_init);
  ply.format = "ply";
  CHECK(dif_mesh_write(mesh.get(), "/dev/full", &ply, &report) == DIF_ERROR_FILE_WRITE);
  CHECK(untouched());
  ply.draco = 1;
  const std::filesystem::path path = folder / "m.ply";
  CHECK(dif_mesh_write(mesh.get(), path.c_str(), &ply, &report) == DIF_ERROR_INVALID_ARGUMENT);
  CHECK(untouched());
  report.struct_size = 12;
  CHECK(dif_mesh_write(mesh.get(), path.c_str(), nullptr, &report) == DIF_ERROR_STRUCT);
  CHECK(report.bytes == 77);
  CHECK(folder.names().empty());
  CHECK(dif_mesh_write(mesh.get(), path.c_str(), nullptr, nullptr) == DIF_OK);
  CHECK(folder.names() == std::vector<std::string>{"m.ply"});
}

TEST_CASE("a report warns where float32 of STL spoils a mesh") {
  const TempFolder folder;
  const c::OwnedField blob = c::blob({12, 11, 10});
  dif_field field = c::c_field(blob);
  std::fill_n(field.spacing, 3, 0.01);
  CHECK(write_reported(c::c_reconstruct(field), folder / "near.stl").warning == nullptr);
  field.origin[0] = 5e5;
  field.origin[1] = 5.4e6;
  const auto mesh = c::c_reconstruct(field);
  const dif_mesh_write_report report = write_reported(mesh, folder / "far.stl");
  CHECK(report.collapsed_triangles > 0);
  REQUIRE(report.warning != nullptr);
  const std::string warning = report.warning;
  CHECK(warning.find((folder / "far.stl").string()) != std::string::npos);
  CHECK(warning.find(std::to_string(report.collapsed_triangles) + " of ") != std::string::npos);
  CHECK(write_reported(mesh, folder / "far.ply").warning == nullptr);
}
