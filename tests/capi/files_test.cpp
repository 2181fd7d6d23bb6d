// Files through the C interface.

#include "io/files.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "handles.hpp"
#include "support/differences.hpp"

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
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "blob.ply").c_str(), nullptr, nullptr) == DIF_OK);
  dif_mesh* read = nullptr;
  REQUIRE(dif_mesh_read((folder / "blob.ply").c_str(), &read) == DIF_OK);
  const c::MeshHandle again(read);
  CHECK(c::same_bits(c::mesh_of(read), c::mesh_of(mesh.get())));
  dif_mesh_write_options plain = c::prepared(dif_mesh_write_options_init);
  plain.normals = 0;
  plain.edge_ids = 0;
  plain.format = "ply";
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "blob.anything").c_str(), &plain, nullptr) ==
          DIF_OK);
  std::filesystem::rename(folder / "blob.anything", folder / "plain.ply");
  REQUIRE(dif_mesh_read((folder / "plain.ply").c_str(), &read) == DIF_OK);
  const c::MeshHandle bare(read);
  CHECK(c::mesh_of(read).normals.empty());
  CHECK(c::mesh_of(read).edge_ids.empty());

  REQUIRE(dif_field_write(&field, (folder / "blob.nrrd").c_str(), nullptr) == DIF_OK);
  const auto file = read_field(folder / "blob.nrrd");
  const dif_field back = c::field_of(file);
  CHECK(back.type == DIF_FLOAT64);
  CHECK(back.origin[0] == -4.5);
  CHECK(back.spacing[2] == 0.125);
  CHECK(c::same_bits(c::mesh_of(c::c_reconstruct(back, &options).get()), c::mesh_of(mesh.get())));

  dif_field_write_options small = c::prepared(dif_field_write_options_init);
  small.type = DIF_UINT8;
  small.format = DIF_FIELD_FORMAT_NPY;
  REQUIRE(dif_field_write(&field, (folder / "blob.npy").c_str(), &small) == DIF_OK);
  const auto bytes = read_field(folder / "blob.npy");
  const dif_field of_bytes = c::field_of(bytes);
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
  CHECK(std::equal(static_cast<const std::uint8_t*>(c::field_of(raw).data),
                   static_cast<const std::uint8_t*>(c::field_of(raw).data) + 1320,
                   static_cast<const std::uint8_t*>(of_bytes.data)));
}

TEST_CASE("file errors name the file and leave nothing") {
  const TempFolder folder;
  const auto mesh = c::c_reconstruct(c::c_field(c::blob({6, 6, 6})));
  dif_mesh_write_options ply = c::prepared(dif_mesh_write_options_init);
  ply.format = "ply";
  CHECK(dif_mesh_write(mesh.get(), "/dev/full", &ply, nullptr) == DIF_ERROR_FILE_WRITE);
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

namespace {

// Whether the build has what the path and the options need. If not, the call says so.
bool is_written(const dif_mesh* mesh, const std::filesystem::path& path,
                const dif_mesh_write_options* options = nullptr) {
  const bool drc = path.extension() == ".drc";
  const bool draco = drc || (options != nullptr && options->draco == 1);
  const bool lacks_gltf = !drc && dif_has(DIF_PART_GLTF) == 0;
  const bool lacks_draco = draco && dif_has(DIF_PART_DRACO) == 0;
  const dif_status status = dif_mesh_write(mesh, path.c_str(), options, nullptr);
  INFO(std::string(dif_last_message()));
  if (lacks_gltf || lacks_draco) {
    REQUIRE(status == DIF_ERROR_UNSUPPORTED);
    CHECK(std::string(dif_last_message()).find(lacks_gltf ? "without glTF" : "without Draco") !=
          std::string::npos);
    dif_mesh* read = nullptr;
    CHECK(dif_mesh_read(drc ? "x.drc" : "x.glb", &read) ==
          (lacks_gltf || drc ? DIF_ERROR_UNSUPPORTED : DIF_ERROR_FILE_MISSING));
    return false;
  }
  REQUIRE(status == DIF_OK);
  return true;
}

c::MeshHandle read_mesh(const std::filesystem::path& path) {
  dif_mesh* mesh = nullptr;
  const dif_status status = dif_mesh_read(path.c_str(), &mesh);
  INFO(std::string(dif_last_message()));
  REQUIRE(status == DIF_OK);
  return c::MeshHandle(mesh);
}

std::vector<double> scalars_of(const c::MeshHandle& mesh, const char* name) {
  const double* values = nullptr;
  std::int64_t count = -1;
  REQUIRE(dif_mesh_scalars(mesh.get(), name, &values, &count) == DIF_OK);
  return {values, values + count};
}

std::vector<std::string> names_of(const c::MeshHandle& mesh) {
  std::vector<std::string> names;
  const char* name = nullptr;
  for (std::int64_t index = 0;; ++index) {
    REQUIRE(dif_mesh_scalars_name(mesh.get(), index, &name) == DIF_OK);
    if (name == nullptr) {
      return names;
    }
    names.emplace_back(name);
  }
}

c::MeshHandle surface_with_heights() {
  auto mesh = c::c_reconstruct(c::c_field(c::blob({12, 11, 10})));
  std::vector<double> heights;
  for (const difmesh::Vec3& position : c::mesh_of(mesh.get()).positions) {
    heights.push_back(position[2]);
  }
  REQUIRE(dif_mesh_set_scalars(mesh.get(), "height", heights.data()) == DIF_OK);
  return mesh;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

}  // namespace

TEST_CASE("surfaces go into glTF and Draco files and back") {
  const TempFolder folder;
  const auto mesh = c::c_reconstruct(c::c_field(c::blob({12, 11, 10})));
  const difmesh::Mesh before = c::mesh_of(mesh.get());
  for (const char* name : {"blob.glb", "blob.gltf", "blob.drc"}) {
    if (!is_written(mesh.get(), folder / name)) {
      continue;
    }
    const auto again = read_mesh(folder / name);
    const dif_measure facts = c::measured(again.get());
    const dif_measure expected = c::measured(mesh.get());
    CHECK(facts.vertices == expected.vertices);
    CHECK(facts.triangles == expected.triangles);
    CHECK(facts.closed == 1);
    CHECK(facts.volume == doctest::Approx(expected.volume).epsilon(1e-3));
  }
}

TEST_CASE("scalars are the caller's until they are removed") {
  const auto mesh = surface_with_heights();
  std::vector<double> others(scalars_of(mesh, "height").size(), 2.5);
  REQUIRE(dif_mesh_set_scalars(mesh.get(), "Other_1", others.data()) == DIF_OK);
  others[0] = 7.0;  // they were copied
  CHECK(names_of(mesh) == std::vector<std::string>{"height", "Other_1"});
  CHECK(scalars_of(mesh, "Other_1") == std::vector<double>(others.size(), 2.5));
  REQUIRE(dif_mesh_set_scalars(mesh.get(), "Other_1", others.data()) == DIF_OK);
  CHECK(scalars_of(mesh, "Other_1") == others);
  REQUIRE(dif_mesh_set_scalars(mesh.get(), "height", nullptr) == DIF_OK);
  REQUIRE(dif_mesh_set_scalars(mesh.get(), "height", nullptr) == DIF_OK);
  CHECK(names_of(mesh) == std::vector<std::string>{"Other_1"});
  CHECK(scalars_of(mesh, "height").empty());
}

TEST_CASE("scalars go into PLY and glTF and Draco files and come back") {
  const TempFolder folder;
  const auto mesh = surface_with_heights();
  const std::vector<double> heights = scalars_of(mesh, "height");
  dif_mesh_write_options options = c::prepared(dif_mesh_write_options_init);
  options.draco_method = DIF_DRACO_SEQUENTIAL;  // the order of the vertices is kept
  const double range = *std::ranges::max_element(heights) - *std::ranges::min_element(heights);
  for (const auto& [name, draco, bound] :
       {std::tuple{"blob.glb", 0, 1e-6 * range}, std::tuple{"blob.gltf", 1, range / 8190.0 * 1.001},
        std::tuple{"blob.drc", 0, range / 8190.0 * 1.001}}) {
    options.draco = draco;
    if (is_written(mesh.get(), folder / name, &options)) {
      const auto again = read_mesh(folder / name);
      CHECK(names_of(again) == std::vector<std::string>{"height"});
      CHECK(largest_difference(scalars_of(again, "height"), heights) <= bound);
    }
  }
  options.scalars = 0;
  options.draco = 0;
  if (is_written(mesh.get(), folder / "plain.glb", &options)) {
    CHECK(names_of(read_mesh(folder / "plain.glb")).empty());
  }
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "blob.ply").c_str(), nullptr, nullptr) == DIF_OK);
  const auto exact = read_mesh(folder / "blob.ply");
  CHECK(names_of(exact) == std::vector<std::string>{"height"});
  CHECK(scalars_of(exact, "height") == heights);
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "plain.ply").c_str(), &options, nullptr) == DIF_OK);
  CHECK(names_of(read_mesh(folder / "plain.ply")).empty());
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "blob.off").c_str(), nullptr, nullptr) == DIF_OK);
  CHECK(names_of(read_mesh(folder / "blob.off")).empty());
}

TEST_CASE("Draco's options set the error and the size") {
  const TempFolder folder;
  const auto mesh = surface_with_heights();
  const difmesh::Mesh before = c::mesh_of(mesh.get());
  const double side = c::longest_side(c::measured(mesh.get()));
  dif_mesh_write_options options = c::prepared(dif_mesh_write_options_init);
  options.draco = 1;
  options.draco_method = DIF_DRACO_SEQUENTIAL;
  std::uintmax_t last = 0;
  for (const std::int32_t bits : {6, 10, 16}) {
    options.position_bits = bits;
    if (!is_written(mesh.get(), folder / "blob.glb", &options)) {
      return;
    }
    const difmesh::Mesh after = c::mesh_of(read_mesh(folder / "blob.glb").get());
    REQUIRE(after.triangles == before.triangles);
    const double error = c::largest_difference(after.positions, before.positions);
    const double half_step = side / (2.0 * (std::exp2(bits) - 1.0));
    CHECK(error <= half_step + 1e-6 * side);
    CHECK(error >= 0.5 * half_step);
    CHECK(std::filesystem::file_size(folder / "blob.glb") > last);
    last = std::filesystem::file_size(folder / "blob.glb");
  }
  options.draco_method = DIF_DRACO_EDGEBREAKER;
  REQUIRE(is_written(mesh.get(), folder / "small.glb", &options));
  CHECK(std::filesystem::file_size(folder / "small.glb") < last);
}

TEST_CASE("glTF's options are in the file") {
  const TempFolder folder;
  const auto mesh = surface_with_heights();
  dif_mesh_write_options options = c::prepared(dif_mesh_write_options_init);
  options.format = "gltf";
  options.color_by = "height";
  options.color_map = DIF_COLOR_MAP_COOL_WARM;
  options.color_range[0] = -3.5;
  options.color_range[1] = 6.25;
  options.up = DIF_UP_Z;
  options.metres_per_unit = 0.125;
  options.has_local_origin = 1;
  options.local_origin[0] = 4.5;
  options.most_vertices = 100;
  options.name = "a drop";
  if (!is_written(mesh.get(), folder / "blob.any", &options)) {
    return;
  }
  const std::string text = ::test::read_bytes(folder / "blob.any");
  for (const char* word :
       {"COLOR_0", "cool_warm", "-3.5", "6.25", "\"rotation\"", "[0.125,0.125,0.125]",
        "[4.5,0.0,0.0]", "\"a drop\"", "_HEIGHT", "_VERTEX"}) {
    INFO(std::string(word));
    CHECK(text.find(word) != std::string::npos);
  }
  std::filesystem::rename(folder / "blob.any", folder / "blob.gltf");
  const difmesh::Mesh again = c::mesh_of(read_mesh(folder / "blob.gltf").get());
  CHECK(again.triangles == c::mesh_of(mesh.get()).triangles);
}

TEST_CASE("options of older and newer programs write meshes") {
  const TempFolder folder;
  const auto mesh = surface_with_heights();
  dif_mesh_write_options old = c::prepared(dif_mesh_write_options_init);
  old.struct_size = 24;
  old.draco = 7;  // beyond its end
  old.position_bits = -5;
  REQUIRE(dif_mesh_write(mesh.get(), (folder / "blob.ply").c_str(), &old, nullptr) == DIF_OK);
  if (is_written(mesh.get(), folder / "old.glb", &old) &&
      is_written(mesh.get(), folder / "new.glb")) {
    CHECK(::test::read_bytes(folder / "old.glb") == ::test::read_bytes(folder / "new.glb"));
  }
}

TEST_CASE("what a reader left out is told by the mesh") {
  if (dif_has(DIF_PART_GLTF) == 0) {
    return;
  }
  const TempFolder folder;
  const auto mesh = c::c_reconstruct(c::c_field(c::blob({12, 11, 10})));
  const auto path = folder / "blob.glb";
  REQUIRE(dif_mesh_write(mesh.get(), path.c_str(), nullptr, nullptr) == DIF_OK);
  const auto warnings_of = [](const c::MeshHandle& from) {
    std::vector<std::string> warnings;
    const char* text = nullptr;
    for (std::int64_t index = 0; index < 9; ++index) {
      REQUIRE(dif_mesh_warning(from.get(), index, &text) == DIF_OK);
      if (text == nullptr) {
        break;
      }
      warnings.emplace_back(text);
    }
    return warnings;
  };
  CHECK(warnings_of(mesh).empty());
  CHECK(warnings_of(read_mesh(path)).empty());
  const std::string bytes = ::test::read_bytes(path);
  (void)folder.file("blob.glb", bytes + "behind");
  const auto found = warnings_of(read_mesh(path));
  REQUIRE(found.size() == 1);
  CHECK(found[0].find(path.string()) != std::string::npos);
  CHECK(found[0].find("6 bytes") != std::string::npos);
}
