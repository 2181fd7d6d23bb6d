// Files made to do harm, or broken: refused with a message that names the part.

#include <functional>
#include <string>

#include "difmesh/io/mesh_file.hpp"
#include "io/surfaces.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::Mesh;
using test::Glb;
using test::Json;
using test::TempFolder;

const Glb& good(bool draco) {
  static const auto make = [](bool compressed) {
    const TempFolder folder;
    difmesh::WriteMeshOptions options;
    if (compressed) {
      options.draco = difmesh::DracoOptions{};
    }
    difmesh::write_mesh(folder / "m.glb", test::ball(6), options);
    return Glb(test::read_bytes(folder / "m.glb"));
  };
  static const Glb plain = make(false);
  static const Glb small = make(true);
  return draco ? small : plain;
}

void check_refused(const std::string& bytes, std::initializer_list<std::string> words) {
  const TempFolder folder;
  const auto path = folder.file("m.glb", bytes);
  CAPTURE(bytes.size());
  test::check_error([&] { (void)difmesh::read_mesh(path); }, ErrorCode::file_format, words);
}

using Change = std::function<void(Json& json)>;

void check_change(const Change& change, std::initializer_list<std::string> words,
                  bool draco = false) {
  Glb glb = good(draco);
  change(glb.json);
  check_refused(glb.bytes(), words);
}

Json& accessor(Json& json, const char* name) {
  const Json& primitive = json["meshes"][0]["primitives"][0];
  return json["accessors"][(name == std::string("indices") ? primitive["indices"]
                                                           : primitive["attributes"][name])
                               .get<std::size_t>()];
}

Json& draco_of(Json& json) {
  return json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
}

}  // namespace

TEST_CASE("glb: bad containers") {
  const std::string bytes = good(false).bytes();
  check_refused("", {"m.glb", "no .glb file", "empty"});
  check_refused("solid cube\n", {"no .glb file", "starts with 'soli'"});
  check_refused("\x89PNG\r\n", {"no .glb file"});
  check_refused(std::string(1, '\0') + "\xff", {"no .glb file", R"('\x00\xff')"});
  check_refused("glTF", {"truncated"});
  check_refused(bytes.substr(0, 19), {"truncated", "19 bytes"});
  std::string changed = bytes;
  changed[4] = 1;
  check_refused(changed, {"version 1"});
  check_refused(bytes.substr(0, bytes.size() - 1),
                {"its header says " + std::to_string(bytes.size())});
  changed = bytes;
  changed.replace(8, 4, test::bytes_of(std::uint32_t{19}));
  check_refused(changed, {"its header says 19"});
  changed = bytes;
  changed[15] = '\x7f';  // length of the first chunk
  check_refused(changed, {"chunk 0 reaches beyond"});
  changed = bytes;
  changed[16] = 'X';
  check_refused(changed, {"chunk 0", "not JSON"});
  changed = bytes;
  changed[20] = '[';
  check_refused(changed, {"no JSON"});
  Glb twice = good(false);
  check_refused("{\"asset\":{\"version\":\"1.0\"}}", {"version '1.0'"});
  check_refused("{}", {"the root has no asset"});
  check_refused("[]", {"the root has no asset"});
  check_refused(std::string(100000, '['), {"no JSON"});
}

TEST_CASE("gltf: bad lengths and counts and offsets and types") {
  check_change([](Json& j) { accessor(j, "POSITION")["count"] = 100000; },
               {"accessors[0]", "100000 elements", "bufferView"});
  check_change([](Json& j) { accessor(j, "POSITION")["count"] = 9007199254740992; },
               {"accessors[0]"});
  check_change([](Json& j) { accessor(j, "POSITION")["count"] = 1e300; }, {"accessors[0].count"});
  check_change([](Json& j) { accessor(j, "POSITION")["count"] = -1; }, {"accessors[0].count"});
  check_change([](Json& j) { accessor(j, "POSITION")["count"] = 2.5; }, {"accessors[0].count"});
  check_change([](Json& j) { accessor(j, "POSITION")["count"] = "9"; }, {"accessors[0].count"});
  check_change([](Json& j) { accessor(j, "POSITION")["count"] = 0; }, {"accessors[0].count", "0"});
  check_change([](Json& j) { accessor(j, "POSITION").erase("count"); }, {"has no count"});
  check_change([](Json& j) { accessor(j, "POSITION")["type"] = "VEC2"; }, {"VEC3"});
  check_change([](Json& j) { accessor(j, "POSITION")["type"] = "MAT4"; }, {"no vector"});
  check_change([](Json& j) { accessor(j, "POSITION")["componentType"] = 5130; }, {"no vector"});
  check_change([](Json& j) { accessor(j, "POSITION")["byteOffset"] = 4; }, {"accessors[0]"});
  check_change([](Json& j) { accessor(j, "POSITION")["sparse"] = Json::object(); }, {"sparse"});
  check_change(
      [](Json& j) {
        accessor(j, "POSITION").erase("bufferView");
        accessor(j, "POSITION")["count"] = 4294967296;
      },
      {"accessors[0].count is 4294967296"});
  check_change(
      [](Json& j) {
        accessor(j, "POSITION").erase("bufferView");
        accessor(j, "POSITION")["count"] = 1000000;
      },
      {"bytes of memory", "trusted"});
  check_change([](Json& j) { accessor(j, "POSITION")["bufferView"] = 77; },
               {"accessors[0].bufferView is 77"});
  check_change([](Json& j) { accessor(j, "NORMAL")["count"] = 3; }, {"3 elements for"});
  check_change([](Json& j) { j["bufferViews"][0]["byteStride"] = 8; }, {"byteStride of 8"});
  check_change([](Json& j) { j["bufferViews"][0]["byteStride"] = 100; }, {"accessors[0]"});
  check_change([](Json& j) { j["bufferViews"][0]["byteOffset"] = 1000000; }, {"bufferViews[0]"});
  check_change([](Json& j) { j["bufferViews"][0]["byteLength"] = 1000000; }, {"bufferViews[0]"});
  check_change([](Json& j) { j["bufferViews"][0]["buffer"] = 1; }, {"buffer is 1"});
  check_change([](Json& j) { j["buffers"][0]["byteLength"] = 1000000; },
               {"buffers[0].byteLength is 1000000"});
  check_change([](Json& j) { j.erase("buffers"); }, {"0 buffers"});
  check_change(
      [](Json& j) {
        j["buffers"].push_back({{"byteLength", 9}});
        j["bufferViews"][0]["buffer"] = 1;
      },
      {"buffers[1]", "neither a uri"});
}

TEST_CASE("gltf: bad indices and primitives and scenes") {
  check_change([](Json& j) { accessor(j, "indices")["count"] = 4; }, {"4 corners"});
  check_change([](Json& j) { accessor(j, "indices")["componentType"] = 5126; }, {"accessors["});
  check_change([](Json& j) { accessor(j, "indices")["componentType"] = 5122; }, {"no indices"});
  check_change([](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 99; }, {"99"});
  check_change([](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; }, {"mode is 7"});
  check_change([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"] = 3; },
               {"attributes is no object"});
  check_change([](Json& j) { j["meshes"][0]["primitives"][0].erase("attributes"); },
               {"has no attributes"});
  check_change([](Json& j) { j["nodes"][0].erase("mesh"); }, {"meshes hang on no node"});
  check_change([](Json& j) { j["scenes"][0].erase("nodes"); }, {"meshes hang on no node"});
  check_change([](Json& j) { j["meshes"][0].erase("primitives"); },
               {"meshes[0] has no primitives"});
  check_change([](Json& j) { j["nodes"][0]["mesh"] = 1; }, {"nodes[0].mesh is 1"});
  check_change([](Json& j) { j["nodes"][0]["children"] = {0}; }, {"cycles"});
  check_change(
      [](Json& j) {
        j["nodes"][0]["children"] = {1, 1};
        j["nodes"].push_back(Json::object());
      },
      {"node 1 again"});
  check_change([](Json& j) { j["nodes"][0]["children"] = {5}; }, {"children[0] is 5"});
  check_change([](Json& j) { j["nodes"][0]["matrix"] = {1, 2}; }, {"2 numbers, not 16"});
  check_change([](Json& j) { j["nodes"][0]["rotation"] = {0, 0, 0, 0}; }, {"rotation is 0"});
  check_change([](Json& j) { j["nodes"][0]["translation"] = {0, 0, "a"}; }, {"translation[2]"});
  check_change([](Json& j) { j["nodes"][0]["scale"] = {1e308, 1e308, 1e308}; }, {"infinity"});
  check_change([](Json& j) { j["scene"] = 1; }, {"scene is 1"});
  check_change([](Json& j) { j["scenes"][0]["nodes"] = 0; }, {"is no array"});
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression",
                           "EXT_mesh_gpu_instancing", "KHR_node_visibility", "CESIUM_RTC", ""}) {
    check_change(
        [&](Json& j) {
          j["extensionsRequired"] = {"KHR_materials_unlit", name};
        },
        {"extensionsRequired[1] is " + std::string(name) + ","});
  }
  check_change([](Json& j) { j["extensionsRequired"] = {7}; },
               {"extensionsRequired[0] is no text"});
  // Compressed all the same, in a buffer without data.
  check_change(
      [](Json& j) {
        j["buffers"].push_back({{"byteLength", 100000}});
        j["bufferViews"][0]["buffer"] = 1;
        j["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0}};
      },
      {"bufferViews[0]", "EXT_meshopt_compression"});
  // The last of the indices names a vertex that is not there.
  Glb glb = good(false);
  const Json view = glb.json["bufferViews"].back();
  const std::size_t end =
      view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>();
  glb.data[end - 1] = '\x7f';
  check_refused(glb.bytes(), {"indices", "vertex"});
  // A position is not finite.
  glb = good(false);
  glb.data.replace(12, 4, test::bytes_of(std::numeric_limits<float>::quiet_NaN()));
  check_refused(glb.bytes(), {"accessors[0]", "not finite", "element 1"});
}

TEST_CASE("gltf: files out of the folder are not opened") {
  for (const char* uri : {"../m.bin", "/etc/passwd", "a/../../m.bin", "file:///etc/passwd",
                          "%2e%2e/m.bin", "https://example.org/m.bin", "%", ""}) {
    CAPTURE(uri);
    check_change([&](Json& j) { j["buffers"][0]["uri"] = uri; }, {"m.glb"});
  }
  const TempFolder folder;
  Glb glb = good(false);
  glb.json["buffers"][0]["uri"] = "missing.bin";
  const auto path = folder.file("m.gltf", glb.json.dump());
  test::check_error([&] { (void)difmesh::read_mesh(path); }, ErrorCode::file_missing,
                    {"missing.bin"});
  check_change([](Json& j) { j["buffers"][0]["uri"] = "data:text/plain,hello"; }, {"base64"});
  check_change([](Json& j) { j["buffers"][0]["uri"] = "data:;base64,AA*A"; }, {"base64"});
  check_change([](Json& j) { j["buffers"][0]["uri"] = "data:;base64,AAAA"; },
               {"there are 3 bytes"});
}

TEST_CASE("gltf: files that lead out of the folder are opened only where that is allowed") {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "inner/sub");
  Glb glb = good(false);
  (void)folder.file("m.bin", glb.data);
  (void)folder.file("inner/sub/m.bin", glb.data);
  std::filesystem::create_symlink("../m.bin", folder / "inner/link.bin");
  std::filesystem::create_symlink("..", folder / "inner/up");
  std::filesystem::create_symlink("sub/m.bin", folder / "inner/within.bin");
  const auto with_buffer = [&](const std::string& uri) {
    glb.json["buffers"][0]["uri"] = uri;
    return folder.file("inner/m.gltf", glb.json.dump());
  };
  const auto wanted = difmesh::read_mesh(with_buffer("sub/m.bin")).positions;
  CHECK(wanted.size() >= 3);
  CHECK(difmesh::read_mesh(with_buffer("within.bin")).positions == wanted);
  for (const std::string& uri : {std::string("link.bin"), std::string("up/m.bin"),
                                 std::string("../m.bin"), (folder / "m.bin").string()}) {
    CAPTURE(uri);
    const auto path = with_buffer(uri);
    test::check_error([&] { (void)difmesh::read_mesh(path); }, ErrorCode::file_format,
                      {"m.gltf", "outside"});
    CHECK(difmesh::read_mesh(path, {.outside_files = true}).positions == wanted);
  }
}

TEST_CASE("gltf: a small file cannot ask for much memory") {
  check_change(
      [](Json& j) {
        for (int n = 1; n < 3000; ++n) {
          j["nodes"].push_back({{"mesh", 0}});
          j["scenes"][0]["nodes"].push_back(n);
        }
      },
      {"bytes of memory", "trusted"});
  check_change(
      [](Json& j) {
        const Json primitive = j["meshes"][0]["primitives"][0];
        for (int n = 1; n < 3000; ++n) {
          j["meshes"][0]["primitives"].push_back(primitive);
        }
      },
      {"bytes of memory", "trusted"});
  check_change(
      [](Json& j) {
        const Json primitive = j["meshes"][0]["primitives"][0];
        for (int n = 1; n < 3000; ++n) {
          j["meshes"][0]["primitives"].push_back(primitive);
        }
      },
      {"again and again"}, true);
}

TEST_CASE("gltf: a payload of draco must agree with its accessors") {
  check_change([](Json& j) { accessor(j, "POSITION")["count"] = 9; }, {"its accessors 9"}, true);
  check_change([](Json& j) { accessor(j, "indices")["count"] = 9; }, {"9 indices"}, true);
  check_change([](Json& j) { accessor(j, "NORMAL")["count"] = 9; }, {"9 elements for"}, true);
  check_change([](Json& j) { accessor(j, "NORMAL")["componentType"] = 5121; }, {"disagrees"}, true);
  check_change([](Json& j) { accessor(j, "POSITION")["componentType"] = 5123; }, {"disagrees"},
               true);
  check_change([](Json& j) { draco_of(j)["attributes"]["POSITION"] = 9; },
               {"attributes.POSITION is 9"}, true);
  check_change([](Json& j) { draco_of(j)["attributes"].erase("POSITION"); }, {"no POSITION"}, true);
  check_change([](Json& j) { draco_of(j)["attributes"]["NORMAL"] = 2; }, {"disagrees"}, true);
  check_change([](Json& j) { draco_of(j)["bufferView"] = 1; }, {"bufferView is 1"}, true);
  check_change([](Json& j) { draco_of(j).erase("bufferView"); }, {"no bufferView"}, true);
  check_change([](Json& j) { j["bufferViews"][0]["byteLength"] = 30; }, {"Draco"}, true);
  check_change(
      [](Json& j) {
        j["bufferViews"][0]["byteOffset"] = 4;
        j["bufferViews"][0]["byteLength"] = 90;
      },
      {"no data of Draco"}, true);
  check_change([](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 5; }, {"no list"}, true);
  check_change([](Json& j) { j["meshes"][0]["primitives"][0].erase("indices"); },
               {"has no indices"}, true);
}

TEST_CASE("glb: no beginning of a good file is good and no changed byte harms") {
  const TempFolder folder;
  Mesh mesh = test::sheet(3);
  mesh.edge_ids.resize(9, 7);
  mesh.scalars = {{"k", difmesh::Array<double>(9, 0.5)}};
  for (const bool compressed : {false, true}) {
    difmesh::WriteMeshOptions options;
    if (compressed) {
      options.draco = difmesh::DracoOptions{};
    }
    difmesh::write_mesh(folder / "m.glb", mesh, options);
    const std::string bytes = test::read_bytes(folder / "m.glb");
    for (std::size_t length = 0; length < bytes.size(); length += 3) {
      const auto path = folder.file("m.glb", bytes.substr(0, length));
      CHECK_THROWS_AS((void)difmesh::read_mesh(path), difmesh::Error);
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const char change : {'\1', '\x10', '\x7f'}) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ change);
        const auto path = folder.file("m.glb", changed);
        try {
          const Mesh back = difmesh::read_mesh(path);
          for (const difmesh::Triangle& t : back.triangles) {
            REQUIRE(std::max({t[0], t[1], t[2]}) < back.positions.size());
          }
        } catch (const difmesh::Error& error) {
          CHECK(std::string(error.what()).find("m.glb") != std::string::npos);
        }
      }
    }
  }
}
