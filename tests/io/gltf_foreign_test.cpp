// Reading what others write: every way to say triangles and places that glTF has.

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "base64.hpp"
#include "difmesh/io/mesh_file.hpp"
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
  [[nodiscard]] difmesh::MeshFile read() const {
    const TempFolder folder;
    return difmesh::read_mesh_file(folder.file("m.glb", glb_.bytes()));
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
  const difmesh::MeshFile found = builder.read();
  CHECK(found.mesh.positions ==
        difmesh::Array<Vec3>{{1, 0, -1}, {0, 16384.0 / 32767.0, 1.0 / 32767.0}, {-1, 1, 0}});
  REQUIRE(found.mesh.scalars.size() == 1);
  CHECK(found.mesh.scalars[0].name == "share");
  CHECK(found.mesh.scalars[0].values == difmesh::Array<double>{1.0, 0.0, 0.2});
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
  const Mesh mesh = difmesh::read_mesh_file(folder.file("m.gltf", json.dump())).mesh;
  CHECK(mesh.positions == builder.read().mesh.positions);
  json["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA"
      "AAAAAAAAgD8AAAAAAACAPwAAgD8AAAAA";
  CHECK(difmesh::read_mesh_file(folder.file("m.gltf", json.dump())).mesh.positions ==
        mesh.positions);
}

TEST_CASE("gltf: what only one of two primitives has is left out") {
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  Json second = builder.primitive();
  second["attributes"]["_K"] = builder.add(
      std::string(16, '\0'), {{"componentType", 5126}, {"count", 4}, {"type", "SCALAR"}});
  builder.json()["meshes"][0]["primitives"].push_back(second);
  CHECK(builder.read().mesh.scalars.empty());
  CHECK(builder.read().mesh.positions.size() == 8);
  builder.json()["meshes"][0]["primitives"].erase(0);
  CHECK(builder.read().mesh.scalars.size() == 1);
}

TEST_CASE("gltf: what viewers show otherwise is read with a warning that names it") {
  const auto warnings = [](const std::function<void(Builder&)>& change) {
    Builder builder;
    builder.square();
    builder.primitive()["mode"] = 5;
    const difmesh::MeshFile plain = builder.read();
    CHECK(plain.warnings.empty());
    change(builder);
    const difmesh::MeshFile found = builder.read();
    CHECK(found.mesh.positions == plain.mesh.positions);
    CHECK(found.mesh.triangles == plain.mesh.triangles);
    return found.warnings;
  };
  const auto check = [&](const std::function<void(Builder&)>& change, const std::string& words) {
    CAPTURE(words);
    const auto found = warnings(change);
    REQUIRE(found.size() == 1);
    CAPTURE(found[0]);
    CHECK(found[0].find("m.glb': " + words) != std::string::npos);
  };
  const auto node = [](Builder& b) -> Json& { return b.json()["nodes"][0]; };
  const auto morphed = [](Builder& b, const Json& weights) {
    b.primitive()["targets"] = {{{"POSITION", 0}}};
    b.json()["meshes"][0]["weights"] = weights;
  };
  check([&](Builder& b) { morphed(b, {0, 0.5}); }, "meshes[0] has morph weights");
  check(
      [&](Builder& b) {
        morphed(b, {0});
        node(b)["weights"] = {-1};
      },
      "nodes[0] has morph weights");
  CHECK(warnings([&](Builder& b) { morphed(b, {0, 0.0}); }).empty());
  CHECK(warnings([&](Builder& b) {
          morphed(b, {1});
          node(b)["weights"] = {0};
        }).empty());
  CHECK(warnings([](Builder& b) { b.json()["meshes"][0]["weights"] = {1}; }).empty());
  check([&](Builder& b) { node(b)["skin"] = 0; }, "nodes[0] has a skin");
  check(
      [&](Builder& b) {
        node(b)["extensions"]["EXT_mesh_gpu_instancing"] = Json::object();
        b.json()["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
      },
      "nodes[0] has copies of its mesh by EXT_mesh_gpu_instancing");
  check([&](Builder& b) { node(b)["extensions"]["KHR_node_visibility"]["visible"] = false; },
        "nodes[0] is hidden by KHR_node_visibility");
  check(
      [](Builder& b) {
        b.json()["extensionsUsed"] = {"VENDOR_waves", "KHR_materials_ior"};
      },
      "the extension 'VENDOR_waves' is not known here");
  for (const int mode : {0, 1, 3}) {
    check(
        [&](Builder& b) {
          b.json()["meshes"][0]["primitives"].push_back(b.primitive());
          b.json()["meshes"][0]["primitives"][1]["mode"] = mode;
        },
        "meshes[0].primitives[1] holds points or lines, and was left out.");
  }
  check(
      [](Builder& b) {
        Json& primitives = b.json()["meshes"][0]["primitives"];
        const Json bare = {{"attributes", {{"NORMAL", 0}}}};
        primitives = {primitives[0], bare, bare, bare};
      },
      "meshes[0].primitives[1] has no POSITION, and was left out, as in 2 other places.");
}

TEST_CASE("gltf: what is in no scene, and what moves, is named in a warning") {
  const auto warnings = [](const std::function<void(Json&)>& change) {
    Builder builder;
    builder.square();
    builder.primitive()["mode"] = 5;
    const Mesh plain = builder.read().mesh;
    builder.json()["nodes"] = Json::parse(R"([{"children":[1,2]},{"mesh":0},{"camera":0}])");
    change(builder.json());
    const difmesh::MeshFile found = builder.read();
    CHECK(found.mesh.positions == plain.positions);
    CHECK(found.mesh.triangles == plain.triangles);
    return found.warnings;
  };
  const auto check = [&](const std::function<void(Json&)>& change, const std::string& words) {
    CAPTURE(words);
    const auto found = warnings(change);
    REQUIRE(found.size() == 1);
    CAPTURE(found[0]);
    CHECK(found[0].find("m.glb': " + words) != std::string::npos);
  };
  const Json other = {{"mesh", 0}, {"translation", {3, 0, 0}}};
  const std::string left_out =
      "has a mesh, but is not in the scene that was read, and was left out";
  check([&](Json& j) { j["nodes"].push_back(other); }, "nodes[3] " + left_out + ".");
  check(
      [&](Json& j) {
        j["nodes"].push_back(other);
        j["nodes"].push_back(other);
        j["scenes"].push_back({{"nodes", {3}}});
        j["scenes"].push_back({{"nodes", {0, 4}}});
      },
      "nodes[3] " + left_out + ", as in 1 other place.");
  check([](Json& j) { j["meshes"].push_back(j["meshes"][0]); },
        "meshes[1] hangs on no node, and was left out.");
  CHECK(warnings([](Json& j) { j["scenes"].push_back({{"nodes", {1}}}); }).empty());

  const auto moving = [](Json& j, const Json& target) {
    const Json still = {{"channels", {{{"sampler", 0}, {"target", {{"path", "weights"}}}}}}};
    const Json channel = {{"sampler", 0}, {"target", target}};
    j["animations"] = {still, {{"channels", {channel}}}};
  };
  const std::string moves = "animations[1] moves meshes, which were read as they are without it.";
  for (const int node : {0, 1}) {
    check([&](Json& j) { moving(j, {{"node", node}, {"path", "rotation"}}); }, moves);
  }
  CHECK(warnings([&](Json& j) { moving(j, {{"node", 2}, {"path", "rotation"}}); }).empty());
  const auto pointer = [](const char* where) {
    return Json{{"path", "pointer"},
                {"extensions", {{"KHR_animation_pointer", {{"pointer", where}}}}}};
  };
  check([&](Json& j) { moving(j, pointer("/nodes/1/scale")); }, moves);
  CHECK(warnings([&](Json& j) { moving(j, pointer("/materials/0/alphaCutoff")); }).empty());
}

TEST_CASE("gltf: a matrix that is no affine one is told") {
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  Json& matrix = builder.json()["nodes"][0]["matrix"];
  matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1.0000001};
  CHECK(builder.read().warnings.empty());
  for (const std::size_t n : {std::size_t{3}, std::size_t{7}, std::size_t{11}, std::size_t{15}}) {
    Builder other = builder;
    other.json()["nodes"][0]["matrix"][n] = 2;
    const difmesh::MeshFile found = other.read();
    CHECK(found.mesh.positions[0] == Vec3{1, 2, 3});
    REQUIRE(found.warnings.size() == 1);
    CHECK(found.warnings[0].find("nodes[0] has a matrix whose last row") != std::string::npos);
  }
}

TEST_CASE("gltf: a file that needs a later version is refused") {
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  builder.json()["asset"] = {{"version", "2.1"}, {"minVersion", "2.0"}};
  CHECK(builder.read().warnings.empty());
  builder.json()["asset"]["minVersion"] = "2.1";
  test::check_error([&] { (void)builder.read(); }, difmesh::ErrorCode::file_format,
                    {"m.glb", "'2.1'", "2.0"});
}

TEST_CASE("gltf: files may require extensions that leave surfaces alone") {
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  const Json names = {"KHR_materials_pbrSpecularGlossiness",
                      "KHR_texture_transform",
                      "KHR_texture_basisu",
                      "EXT_texture_webp",
                      "KHR_lights_punctual",
                      "KHR_mesh_quantization",
                      "KHR_xmp_json_ld",
                      "KHR_materials_variants"};
  builder.json()["extensionsUsed"] = names;
  builder.json()["extensionsRequired"] = names;
  CHECK(builder.read().mesh.triangles.size() == 2);
  CHECK(builder.read().warnings.empty());
}

TEST_CASE("gltf: accessors without data are zero") {
  Builder builder;
  builder.square();
  builder.primitive()["mode"] = 5;
  const auto add = [&](Json accessor) {
    builder.json()["accessors"].push_back(std::move(accessor));
    return builder.json()["accessors"].size() - 1;
  };
  builder.primitive()["attributes"]["_K"] =
      add({{"componentType", 5126}, {"count", 4}, {"type", "SCALAR"}});
  difmesh::MeshFile found = builder.read();
  REQUIRE(found.mesh.scalars.size() == 1);
  CHECK(found.mesh.scalars[0].values == difmesh::Array<double>(4, 0.0));
  CHECK(found.mesh.triangles.size() == 2);
  builder.primitive()["attributes"]["POSITION"] =
      add({{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  CHECK(builder.read().mesh.positions == difmesh::Array<Vec3>(4, Vec3{0, 0, 0}));
  builder.primitive()["mode"] = 4;
  builder.primitive()["indices"] = add({{"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}});
  CHECK(builder.read().mesh.triangles == Triangles{{0, 0, 0}, {0, 0, 0}});
}

TEST_CASE("gltf: normals and scalars that are not finite are left out") {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    Builder builder;
    builder.square();
    builder.primitive()["mode"] = 5;
    const Mesh plain = builder.read().mesh;
    std::string data;
    for (int i = 0; i < 12; ++i) {
      data += test::bytes_of(i == 7 ? bad : 0.6F);
    }
    builder.primitive()["attributes"]["NORMAL"] =
        builder.add(data, {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    builder.primitive()["attributes"]["_K"] = builder.add(
        data.substr(16, 16), {{"componentType", 5126}, {"count", 4}, {"type", "SCALAR"}});
    builder.primitive()["attributes"]["_GOOD"] = builder.add(
        data.substr(0, 16), {{"componentType", 5126}, {"count", 4}, {"type", "SCALAR"}});
    const difmesh::MeshFile found = builder.read();
    CHECK(found.mesh.positions == plain.positions);
    CHECK(found.mesh.triangles == plain.triangles);
    CHECK(found.mesh.normals.empty());
    REQUIRE(found.mesh.scalars.size() == 1);
    CHECK(found.mesh.scalars[0].name == "good");
    REQUIRE(found.warnings.size() == 1);
    CHECK(
        found.warnings[0].ends_with("meshes[0].primitives[0].attributes.NORMAL is not finite "
                                    "everywhere, and was left out, as in 1 other place."));
  }
}

TEST_CASE("gltf: vertices that are not finite are left out where no triangle uses them") {
  Builder builder;
  std::string data;
  const float bad = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {0.F, 0.F, 0.F, 1.F, bad, 1.F, 2.F, 0.F, 0.F, 0.F, 2.F, 0.F}) {
    data += test::bytes_of(x);
  }
  builder.primitive()["attributes"]["POSITION"] =
      builder.add(data, {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  builder.primitive()["attributes"]["_K"] = builder.add(
      std::string("\0\1\2\3", 4), {{"componentType", 5121}, {"count", 4}, {"type", "SCALAR"}});
  builder.indices(std::string("\0\2\3", 3), 5121, 3, 4);
  const difmesh::MeshFile found = builder.read();
  CHECK(found.mesh.positions == difmesh::Array<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  CHECK(found.mesh.triangles == Triangles{{0, 1, 2}});
  REQUIRE(found.mesh.scalars.size() == 1);
  CHECK(found.mesh.scalars[0].values == difmesh::Array<double>{0, 2, 3});
  REQUIRE(found.warnings.size() == 1);
  CHECK(found.warnings[0].find("meshes[0].primitives[0] has vertices without finite coordinates") !=
        std::string::npos);
  builder.indices(std::string("\0\1\3", 3), 5121, 3, 4);
  test::check_error([&] { (void)builder.read(); }, difmesh::ErrorCode::file_format,
                    {"accessors[0], element 1", "not finite"});
}

TEST_CASE("base64 of every length and of nothing else") {
  const auto decoded = [](const std::string& text) {
    const auto bytes = difmesh::detail::from_base64(text);
    return bytes ? std::string(bytes->begin(), bytes->end()) : "none";
  };
  // The examples of RFC 4648.
  CHECK(decoded("").empty());
  CHECK(decoded("Zg==") == "f");
  CHECK(decoded("Zm8=") == "fo");
  CHECK(decoded("Zm9v") == "foo");
  CHECK(decoded("Zm9vYg==") == "foob");
  CHECK(decoded("Zm9vYmE") == "fooba");
  CHECK(decoded("Zm9vYmFy") == "foobar");
  CHECK(decoded("//79+w") == "\xff\xfe\xfd\xfb");
  for (const char* bad : {"Z", "Zm9vY", "Zm9*", "*m9v", "Zm=v", "Zm9vZ*", "Zm9v\n", "Zm\xff"}) {
    CAPTURE(bad);
    CHECK(decoded(bad) == "none");
  }
}

TEST_CASE("gltf: long data in base64 beside other long texts") {
  const TempFolder folder;
  Builder builder;
  builder.square();
  builder.indices(std::string("\0\1\2\2\1\3", 6), 5121, 6, 4);
  const Mesh wanted = builder.read().mesh;
  REQUIRE(wanted.triangles == Triangles{{0, 1, 2}, {2, 1, 3}});
  Json json = builder.json();
  const std::string zeros(4000, 'A');
  const std::string start = "data:application/octet-stream;base64,";
  json["buffers"] = {{{"byteLength", 48},
                      {"uri", start +
                                  "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8A"
                                  "AAAA" +
                                  zeros}},
                     {{"byteLength", 6}, {"uri", start + "AAECAgED" + zeros}}};
  json["bufferViews"][1]["buffer"] = 1;
  json["bufferViews"][1]["byteOffset"] = 0;
  json["images"] = {{{"uri", "data:image/png;base64," + zeros}}, {{"uri", zeros}}};
  json["asset"]["copyright"] = "\"data: \"" + zeros + "\"data:" + zeros;
  const auto read = [&](const std::string& text) {
    return difmesh::read_mesh_file(folder.file("m.gltf", text)).mesh;
  };
  const auto check = [&](const std::string& text) {
    CHECK(read(text).positions == wanted.positions);
    CHECK(read(text).triangles == wanted.triangles);
  };
  check(json.dump());
  check(json.dump(2));
  std::string escaped;  // as some write every slash
  for (const char c : json.dump()) {
    escaped += c == '/' ? std::string("\\/") : std::string(1, c);
  }
  check(escaped);
  check("\xEF\xBB\xBF" + json.dump());
  const auto refused = [&](const std::string& text, const std::string& word) {
    test::check_error([&] { (void)read(text); }, difmesh::ErrorCode::file_format, {word});
  };
  std::string broken = json.dump();
  broken[broken.find("AAECAgED") + 3000] = '*';
  refused(broken, "buffers[1].uri holds data that are no base64");
  refused(json.dump().substr(0, broken.find("AAECAgED") + 3000), "no JSON");
  json["buffers"][1]["uri"] = start + "AAEC" + zeros;
  json["buffers"][1]["byteLength"] = 9000;
  refused(json.dump(), "there are 3003 bytes");
  json["buffers"][1]["uri"] = "data:;difmesh,99";
  refused(json.dump(), "not base64");
}
