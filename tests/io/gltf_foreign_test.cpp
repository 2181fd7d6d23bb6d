// Reading what others write: every way to say triangles and places that glTF has.

#include <cmath>
#include <string>

#include "difmesh/io/gltf_file.hpp"
#include "difmesh/measure.hpp"
#include "io/surfaces.hpp"

namespace {

using difmesh::Mesh;
using difmesh::Triangle;
using difmesh::Vec3;
using test::Glb;
using test::Json;
using test::TempFolder;

/// A square of four corners, with data appended one attribute after the other.
class Builder {
 public:
  Builder() {
    glb_.json = Json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{}}]}],
      "accessors":[],"bufferViews":[],"buffers":[{"byteLength":0}]})");
  }
  /// \return the index of the accessor
  std::size_t add(const std::string& data, Json accessor, std::size_t stride = 0) {
    Json view = {{"buffer", 0}, {"byteOffset", glb_.data.size()}, {"byteLength", data.size()}};
    if (stride > 0) {
      view["byteStride"] = stride;
    }
    accessor["bufferView"] = glb_.json["bufferViews"].size();
    glb_.json["bufferViews"].push_back(view);
    glb_.json["accessors"].push_back(accessor);
    glb_.data += data;
    glb_.data.resize((glb_.data.size() + 3) / 4 * 4, '\0');
    glb_.json["buffers"][0]["byteLength"] = glb_.data.size();
    return glb_.json["accessors"].size() - 1;
  }
  void square() {
    std::string data;
    for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 1.F, 1.F, 0.F}) {
      data += test::bytes_of(x);
    }
    primitive()["attributes"]["POSITION"] =
        add(data, {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  }
  void indices(const std::string& bytes, int type, std::size_t count, int mode) {
    primitive()["indices"] =
        add(bytes, {{"componentType", type}, {"count", count}, {"type", "SCALAR"}});
    primitive()["mode"] = mode;
  }
  Json& primitive() { return json()["meshes"][0]["primitives"][0]; }
  Json& json() { return glb_.json; }
  [[nodiscard]] const Glb& glb() const { return glb_; }
  [[nodiscard]] difmesh::ScalarMesh read() const {
    const TempFolder folder;
    return difmesh::read_gltf(folder.file("m.glb", glb_.bytes()));
  }

 private:
  Glb glb_;
};

using Triangles = difmesh::Array<Triangle>;

}  // namespace

TEST_CASE("gltf: lists and strips and fans with indices of every size and without") {
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  CHECK(builder.read().mesh.triangles == Triangles{{0, 1, 2}, {1, 3, 2}});
  builder.primitive()["mode"] = 6;
  CHECK(builder.read().mesh.triangles == Triangles{{1, 2, 0}, {2, 3, 0}});
  builder.indices(std::string("\2\0\1\3", 4), 5121, 4, 5);
  CHECK(builder.read().mesh.triangles == Triangles{{2, 0, 1}, {0, 3, 1}});
  builder.indices(test::bytes_of(std::uint16_t{3}) + test::bytes_of(std::uint16_t{1}) +
                      test::bytes_of(std::uint16_t{0}),
                  5123, 3, 4);
  CHECK(builder.read().mesh.triangles == Triangles{{3, 1, 0}});
  builder.primitive().erase("mode");
  builder.primitive()["indices"] =
      builder.add(test::bytes_of(0U) + test::bytes_of(1U) + test::bytes_of(3U),
                  {{"componentType", 5125}, {"count", 3.0}, {"type", "SCALAR"}});
  CHECK(builder.read().mesh.triangles == Triangles{{0, 1, 3}});
  builder.primitive()["mode"] = 1;  // lines are no surface
  CHECK(builder.read().mesh.positions.empty());
}

TEST_CASE("gltf: quantised and interleaved attributes") {
  Builder builder;
  // Two int16 positions of 8 bytes each row, normalised; a scalar in between; uint8 normalised.
  std::string data;
  for (const auto& row :
       {std::array<int, 4>{32767, 0, -32768, 255}, {0, 16384, 1, 0}, {-32767, 32767, 0, 51}}) {
    for (std::size_t c = 0; c < 3; ++c) {
      data += test::bytes_of(static_cast<std::int16_t>(row[c]));
    }
    data += test::bytes_of(static_cast<std::uint16_t>(row[3]));
  }
  const std::size_t position = builder.add(
      data, {{"componentType", 5122}, {"count", 3}, {"type", "VEC3"}, {"normalized", true}}, 8);
  builder.primitive()["attributes"]["POSITION"] = position;
  Json scalar = {{"componentType", 5121}, {"count", 3},      {"type", "SCALAR"},
                 {"normalized", true},    {"byteOffset", 6}, {"bufferView", 0}};
  builder.json()["accessors"].push_back(scalar);
  builder.primitive()["attributes"]["_Share"] = 1;
  builder.json()["extensionsRequired"] = {"KHR_mesh_quantization"};
  const difmesh::ScalarMesh found = builder.read();
  CHECK(found.mesh.positions ==
        difmesh::Array<Vec3>{{1, 0, -1}, {0, 16384.0 / 32767.0, 1.0 / 32767.0}, {-1, 1, 0}});
  REQUIRE(found.scalars.size() == 1);
  CHECK(found.scalars[0].name == "share");
  CHECK(found.scalars[0].values == difmesh::Array<double>{1.0, 0.0, 0.2});
}

TEST_CASE("gltf: nodes move and turn and mirror and nest and share meshes") {
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  builder.json()["nodes"] = Json::parse(R"([
    {"translation":[10,0,0],"rotation":[0,0,0.7071067811865476,0.7071067811865476],
     "scale":[2,2,2],"children":[1,2]},
    {"mesh":0,"translation":[0,0,1]},
    {"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}])");
  const Mesh mesh = builder.read().mesh;
  REQUIRE(mesh.positions.size() == 8);
  const auto at = [&](std::size_t v, const Vec3& wanted) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(mesh.positions[v][axis] == doctest::Approx(wanted[axis]).epsilon(1e-12));
    }
  };
  at(0, {10, 0, 2});
  at(1, {10, 2, 2});    // x turned to y and doubled
  at(2, {8, 0, 2});     // y turned to -x
  at(5, {10, -2, 10});  // the mirrored one
  CHECK(mesh.triangles == Triangles{{0, 1, 2}, {1, 3, 2}, {4, 6, 5}, {5, 6, 7}});
  // Mirrored triangles still face +z.
  const difmesh::Measure m = difmesh::measure(mesh);
  CHECK(m.area == doctest::Approx(8.0));
  // Without scenes the roots are the nodes that are nobody's child.
  builder.json().erase("scenes");
  builder.json().erase("scene");
  CHECK(builder.read().mesh.positions == mesh.positions);
}

TEST_CASE("gltf: normals turn with the surface") {
  Builder builder;
  builder.square();
  std::string data;
  for (int v = 0; v < 4; ++v) {
    data += test::bytes_of(0.6F) + test::bytes_of(0.F) + test::bytes_of(0.8F);
  }
  builder.primitive()["attributes"]["NORMAL"] =
      builder.add(data, {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  builder.primitive()["mode"] = 5;
  builder.json()["nodes"][0]["scale"] = {1, 1, -2};
  // The plane 0.6 x + 0.8 z = c becomes 0.6 x - 0.4 z = c.
  for (const Vec3& normal : builder.read().mesh.normals) {
    CHECK(normal[0] == doctest::Approx(0.6 / std::hypot(0.6, 0.4)));
    CHECK(normal[1] == 0.0);
    CHECK(normal[2] == doctest::Approx(-0.4 / std::hypot(0.6, 0.4)));
  }
}

TEST_CASE("gltf: data in other files of the folder and in base64") {
  const TempFolder folder;
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  Json json = builder.json();
  json["buffers"][0]["uri"] = "my%20data.bin";
  (void)folder.file("my data.bin", builder.glb().data + "more");
  const Mesh mesh = difmesh::read_gltf(folder.file("m.gltf", json.dump())).mesh;
  CHECK(mesh.positions == builder.read().mesh.positions);
  json["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA"
      "AAAAAAAAgD8AAAAAAACAPwAAgD8AAAAA";
  CHECK(difmesh::read_gltf(folder.file("m.gltf", json.dump())).mesh.positions == mesh.positions);
}

TEST_CASE("gltf: what only one of two primitives has is left out") {
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  Json second = builder.primitive();
  second["attributes"]["_K"] = builder.add(
      std::string(16, '\0'), {{"componentType", 5126}, {"count", 4}, {"type", "SCALAR"}});
  builder.json()["meshes"][0]["primitives"].push_back(second);
  CHECK(builder.read().scalars.empty());
  CHECK(builder.read().mesh.positions.size() == 8);
  builder.json()["meshes"][0]["primitives"].erase(0);
  CHECK(builder.read().scalars.size() == 1);
}
