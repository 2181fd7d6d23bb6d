// Files through the C interface.

#include "io/files.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "handles.hpp"

namespace {

using test::TempFolder;
namespace c = difmesh::test;

c::FieldFileHandle read_field(const std::filesystem::path& path,
                              const dif_raw_layout* layout = nullptr) {
  dif_field_file* file = nullptr;
  const dif_status status = dif_field_read(path.c_str(), layout, &file);
  INFO(std::string(dif_last_message()));
  REQUIRE(status == DIF_OK);
  return c::FieldFileHandle(file);
}

dif_field field_of(const c::FieldFileHandle& file) {
  dif_field field{};
  field.struct_size = sizeof field;
  REQUIRE(dif_field_file_field(file.get(), &field) == DIF_OK);
  return field;
}

}  // namespace

TEST_CASE("meshes and fields come back from files") {
  const TempFolder folder;
  const c::OwnedField blob = c::blob({12, 11, 10});
  dif_field field = c::c_field(blob);
  field.origin[0] = -4.5;
  field.spacing[2] = 0.125;
  dif_options options = c::prepared(dif_options_init);
  options.vertex_normals = 1;
  options.edge_ids = 1;
  const auto mesh = c::c_reconstruct(field, &options);
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "blob.ply").c_str(), nullptr) == DIF_OK);
  dif_mesh* read = nullptr;
  REQUIRE(dif_mesh_read((folder / "blob.ply").c_str(), &read) == DIF_OK);
  const c::MeshHandle again(read);
  CHECK(c::same_bits(c::mesh_of(read), c::mesh_of(mesh.get())));
  dif_mesh_write_options plain = c::prepared(dif_mesh_write_options_init);
  plain.normals = 0;
  plain.edge_ids = 0;
  plain.format = DIF_MESH_FORMAT_PLY;
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "blob.anything").c_str(), &plain) == DIF_OK);
  std::filesystem::rename(folder / "blob.anything", folder / "plain.ply");
  REQUIRE(dif_mesh_read((folder / "plain.ply").c_str(), &read) == DIF_OK);
  const c::MeshHandle bare(read);
  CHECK(c::mesh_of(read).normals.empty());
  CHECK(c::mesh_of(read).edge_ids.empty());

  REQUIRE(dif_field_write(&field, (folder / "blob.nrrd").c_str(), nullptr) == DIF_OK);
  const auto file = read_field(folder / "blob.nrrd");
  const dif_field back = field_of(file);
  CHECK(back.type == DIF_FLOAT64);
  CHECK(back.origin[0] == -4.5);
  CHECK(back.spacing[2] == 0.125);
  CHECK(c::same_bits(c::mesh_of(c::c_reconstruct(back, &options).get()), c::mesh_of(mesh.get())));

  dif_field_write_options small = c::prepared(dif_field_write_options_init);
  small.type = DIF_UINT8;
  small.format = DIF_FIELD_FORMAT_NPY;
  REQUIRE(dif_field_write(&field, (folder / "blob.npy").c_str(), &small) == DIF_OK);
  const auto bytes = read_field(folder / "blob.npy");
  const dif_field of_bytes = field_of(bytes);
  REQUIRE(of_bytes.type == DIF_UINT8);
  for (std::size_t n = 0; n < blob.values.size(); ++n) {
    REQUIRE(static_cast<const std::uint8_t*>(of_bytes.data)[n] ==
            static_cast<std::uint8_t>(std::lround(255 * blob.values[n])));
  }
  dif_raw_layout layout = c::prepared(dif_raw_layout_init);
  layout.dims[0] = 12;
  layout.dims[1] = 11;
  layout.dims[2] = 10;
  layout.type = DIF_UINT8;
  layout.offset =
      static_cast<std::int64_t>(std::filesystem::file_size(folder / "blob.npy")) - 12 * 11 * 10;
  const auto raw = read_field(folder / "blob.npy", &layout);
  CHECK(std::equal(static_cast<const std::uint8_t*>(field_of(raw).data),
                   static_cast<const std::uint8_t*>(field_of(raw).data) + 1320,
                   static_cast<const std::uint8_t*>(of_bytes.data)));
}

TEST_CASE("file errors name the file and leave nothing") {
  const TempFolder folder;
  const auto mesh = c::c_reconstruct(c::c_field(c::blob({6, 6, 6})));
  dif_mesh_write_options ply = c::prepared(dif_mesh_write_options_init);
  ply.format = DIF_MESH_FORMAT_PLY;
  CHECK(dif_mesh_write(mesh.get(), "/dev/full", &ply) == DIF_ERROR_FILE_WRITE);
  CHECK(std::string(dif_last_message()).find("/dev/full") != std::string::npos);
  dif_mesh* read = nullptr;
  const auto bad = folder.file("bad.off", "OFF\n3 1 0\n0 0 0\n");
  CHECK(dif_mesh_read(bad.c_str(), &read) == DIF_ERROR_FILE_FORMAT);
  CHECK(read == nullptr);
  CHECK(std::string(dif_last_message()).find("bad.off") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"bad.off"});
}

TEST_CASE("a long message ends with a whole character") {
  std::string path = "/nowhere/";
  for (int n = 0; n < 600; ++n) {
    path += "\xC3\xA4";  // two bytes
  }
  dif_mesh* mesh = nullptr;
  CHECK(dif_mesh_read((path + ".ply").c_str(), &mesh) == DIF_ERROR_FILE_MISSING);
  const std::string message = dif_last_message();
  CHECK(message.size() <= 1023);
  CHECK(message.size() > 1000);
  CHECK(message.back() == '\xA4');
}

TEST_CASE("surfaces go into glTF and Draco files and back") {
  const TempFolder folder;
  const auto mesh = c::c_reconstruct(c::c_field(c::blob({12, 11, 10})));
  const difmesh::Mesh before = c::mesh_of(mesh.get());
  for (const char* name : {"blob.glb", "blob.gltf", "blob.drc"}) {
    const dif_status status = dif_mesh_write(mesh.get(), (folder / name).c_str(), nullptr);
    if (status == DIF_ERROR_INVALID_ARGUMENT) {
      MESSAGE("skipped: " << std::string(dif_last_message()));
      continue;
    }
    REQUIRE(status == DIF_OK);
    dif_mesh* read = nullptr;
    REQUIRE(dif_mesh_read((folder / name).c_str(), &read) == DIF_OK);
    const c::MeshHandle again(read);
    dif_measure facts = c::prepared(dif_measure_init);
    dif_measure expected = c::prepared(dif_measure_init);
    REQUIRE(dif_mesh_measure(read, &facts) == DIF_OK);
    REQUIRE(dif_mesh_measure(mesh.get(), &expected) == DIF_OK);
    CHECK(facts.vertices == expected.vertices);
    CHECK(facts.triangles == expected.triangles);
    CHECK(facts.closed == 1);
    CHECK(facts.volume == doctest::Approx(expected.volume).epsilon(1e-3));
  }
}
