// Options and warnings of reading through the C interface.

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "handles.hpp"
#include "io/files.hpp"

namespace {

using test::TempFolder;
namespace c = difmesh::test;

constexpr const char* kHeader =
    "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 1 1\nendian: little\nencoding: raw\n";

std::string samples() {
  std::string bytes;
  for (const int value : {0, 7, 9, 300}) {
    bytes += test::bytes_of(static_cast<std::int16_t>(value));
  }
  return bytes;
}

c::FieldFileHandle read(const std::filesystem::path& path, const dif_field_read_options* options) {
  dif_field_file* file = nullptr;
  const dif_status status = dif_field_read_with(path.c_str(), nullptr, options, &file);
  INFO(std::string(dif_last_message()));
  REQUIRE(status == DIF_OK);
  return c::FieldFileHandle(file);
}

std::vector<std::string> warnings_of(const c::FieldFileHandle& file) {
  std::vector<std::string> warnings;
  const char* text = nullptr;
  while (dif_field_file_warning(file.get(), static_cast<std::int64_t>(warnings.size()), &text) ==
             DIF_OK &&
         text != nullptr) {
    warnings.emplace_back(text);
  }
  return warnings;
}

}  // namespace

TEST_CASE("what values of a file stand for is an option") {
  const TempFolder folder;
  const auto path = folder.file("scan.nrrd", std::string(kHeader) + "\n" + samples());
  dif_field_read_options options = c::prepared(dif_field_read_options_init);
  const auto plain = read(path, &options);
  CHECK(c::field_of(plain).type == DIF_FLOAT32);
  std::int32_t type = 0;
  REQUIRE(dif_field_file_type(plain.get(), &type) == DIF_OK);
  CHECK(type == DIF_INT16);
  const std::vector<std::string> warnings = warnings_of(plain);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("scan.nrrd") != std::string::npos);
  CHECK(warnings[0].find("highest value is 300") != std::string::npos);
  const char* text = nullptr;
  CHECK(dif_field_file_warning(plain.get(), -1, &text) == DIF_ERROR_INVALID_ARGUMENT);
  CHECK(dif_field_file_warning(plain.get(), 0, nullptr) == DIF_ERROR_INVALID_ARGUMENT);

  const std::int64_t labels[2] = {7, 300};
  options.label_count = 2;
  options.labels = labels;
  const auto mask = read(path, &options);
  CHECK(warnings_of(mask).empty());
  REQUIRE(c::field_of(mask).type == DIF_UINT8);
  const auto* const cells = static_cast<const std::uint8_t*>(c::field_of(mask).data);
  CHECK(std::vector<int>(cells, cells + 4) == std::vector<int>{0, 255, 0, 255});

  options = c::prepared(dif_field_read_options_init);
  options.has_full_value = 1;
  options.full_value = 5;
  options.empty_value = 9;
  const auto scaled = read(path, &options);
  const auto* const fractions = static_cast<const float*>(c::field_of(scaled).data);
  CHECK(std::vector<float>(fractions, fractions + 4) == std::vector<float>{1.0F, 0.5F, 0.0F, 0.0F});
}

TEST_CASE("a grid of the caller's takes the place of one that makes no sense") {
  const TempFolder folder;
  const auto path =
      folder.file("f.nrrd", std::string(kHeader) +
                                "spacings: 0 1 nan\nspace origin: (inf,0,0)\n\n" + samples());
  dif_field_file* none = nullptr;
  CHECK(dif_field_read(path.c_str(), nullptr, &none) == DIF_ERROR_FILE_FORMAT);
  dif_field_read_options options = c::prepared(dif_field_read_options_init);
  options.has_spacing = 1;
  options.spacing[2] = 3.0;
  options.has_origin = 1;
  options.origin[0] = -4.0;
  const auto file = read(path, &options);
  const dif_field field = c::field_of(file);
  CHECK(field.spacing[0] == 1.0);
  CHECK(field.spacing[2] == 3.0);
  CHECK(field.origin[0] == -4.0);
}

TEST_CASE("data outside the folder of a header are read where that is allowed") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "inner");
  (void)folder.file("data.raw", samples());
  const auto path = folder.file("inner/f.nhdr", std::string(kHeader) + "data file: ../data.raw\n");
  dif_field_file* none = nullptr;
  CHECK(dif_field_read(path.c_str(), nullptr, &none) == DIF_ERROR_FILE_FORMAT);
  CHECK(none == nullptr);
  dif_field_read_options options = c::prepared(dif_field_read_options_init);
  options.outside_files = 1;
  CHECK(c::field_of(read(path, &options)).dims[0] == 4);
}

TEST_CASE("buffers outside the folder of a glTF file are read where that is allowed") {
  if (dif_has(DIF_PART_GLTF) == 0) {
    MESSAGE("skipped: no glTF");
    return;
  }
  const TempFolder folder;
  std::filesystem::create_directory(folder / "inner");
  const auto mesh = c::c_reconstruct(c::c_field(c::blob({9, 8, 7})));
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "m.glb").c_str(), nullptr, nullptr) == DIF_OK);
  // A header of 20 bytes, whose last words are length and kind of the JSON; then that of the data.
  const std::string glb = test::read_bytes(folder / "m.glb");
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof length);
  std::string json = glb.substr(20, length);
  const std::string buffers = "\"buffers\":[{";
  REQUIRE(json.find(buffers) != std::string::npos);
  json.insert(json.find(buffers) + buffers.size(), "\"uri\":\"../m.bin\",");
  const auto path = folder.file("inner/m.gltf", json);
  (void)folder.file("m.bin", glb.substr(20 + length + 8));
  dif_mesh* read = nullptr;
  CHECK(dif_mesh_read(path.c_str(), &read) == DIF_ERROR_FILE_FORMAT);
  CHECK(read == nullptr);
  dif_mesh_read_options options = c::prepared(dif_mesh_read_options_init);
  options.outside_files = 1;
  REQUIRE(dif_mesh_read_with(path.c_str(), &options, &read) == DIF_OK);
  const c::MeshHandle again(read);
  REQUIRE(dif_mesh_read((folder / "m.glb").c_str(), &read) == DIF_OK);
  const c::MeshHandle whole(read);
  CHECK(c::same_bits(c::mesh_of(again.get()), c::mesh_of(whole.get())));
}
