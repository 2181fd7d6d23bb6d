#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/io/glb.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "gltf_write.hpp"
#include "io/surfaces.hpp"
#include "support/differences.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::Mesh;
using difmesh::MeshFile;
using difmesh::Triangle;
using difmesh::Vec3;
using difmesh::VertexScalar;
using difmesh::test::largest_difference;
using test::Glb;
using test::Json;
using test::TempFolder;

VertexScalar heights(const Mesh& mesh) {
  VertexScalar scalars{"height", {}};
  for (const Vec3& position : mesh.positions) {
    scalars.values.push_back(position[2]);
  }
  return scalars;
}

Vec3 middle(const Mesh& mesh) {
  const difmesh::Measure m = difmesh::measure(mesh);
  return {0.5 * m.low[0] + 0.5 * m.high[0], 0.5 * m.low[1] + 0.5 * m.high[1],
          0.5 * m.low[2] + 0.5 * m.high[2]};
}

/// Every coordinate is the float32 next to its distance from the local origin.
void check_float_rounded(const Mesh& back, const Mesh& mesh, const Vec3& origin) {
  REQUIRE(back.positions.size() == mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double local = mesh.positions[v][axis] - origin[axis];
      const double wanted = static_cast<double>(static_cast<float>(local)) + origin[axis];
      REQUIRE(back.positions[v][axis] == wanted);
    }
  }
}

}  // namespace

TEST_CASE("glb and gltf give back positions to float32 about the centre and all the rest") {
  const TempFolder folder;
  Mesh mesh = test::ball(16, {3.3, -7.1, 0.2}, 0.37);
  const VertexScalar scalars = heights(mesh);
  mesh.scalars = {scalars};
  for (const char* name : {"m.glb", "m.gltf", "M.GLB"}) {
    CAPTURE(name);
    const auto report = difmesh::write_mesh(folder / name, mesh);
    CHECK(report.bytes == static_cast<std::int64_t>(test::read_bytes(folder / name).size()));
    CHECK(report.local_origin == middle(mesh));
    const MeshFile back = difmesh::read_mesh_file(folder / name);
    check_float_rounded(back.mesh, mesh, report.local_origin);
    CHECK(largest_difference(back.mesh.positions, mesh.positions) <= report.position_error);
    CHECK(back.mesh.triangles == mesh.triangles);
    CHECK(back.mesh.edge_ids == mesh.edge_ids);
    CHECK(largest_difference(back.mesh.normals, mesh.normals) < 1e-7);
    REQUIRE(back.mesh.scalars.size() == 1);
    CHECK(back.mesh.scalars[0].name == "height");
    REQUIRE(back.mesh.scalars[0].values.size() == mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      REQUIRE(back.mesh.scalars[0].values[v] ==
              static_cast<double>(static_cast<float>(mesh.positions[v][2])));
    }
  }
}

TEST_CASE("write_mesh and read_mesh know glb and gltf and drc") {
  const TempFolder folder;
  const Mesh mesh = test::ball(12);
  for (const char* name : {"m.glb", "m.gltf", "m.drc"}) {
    CAPTURE(name);
    const difmesh::MeshFileReport report = difmesh::write_mesh(folder / name, mesh);
    CHECK(report.bytes == static_cast<std::int64_t>(test::read_bytes(folder / name).size()));
    CHECK(report.vertices == static_cast<std::int64_t>(mesh.positions.size()));
    CHECK(report.primitives == 1);
    CHECK((report.position_bits > 0) == (name == std::string("m.drc")));
    const Mesh back = difmesh::read_mesh(folder / name);
    CHECK(back.positions.size() == mesh.positions.size());
    CHECK(back.normals.size() == mesh.positions.size());
    CHECK(back.edge_ids.size() == mesh.positions.size());
    const difmesh::Measure m = difmesh::measure(back);
    CHECK(m.closed);
    CHECK(m.euler_number == 2);
    CHECK(m.volume == doctest::Approx(difmesh::measure(mesh).volume).epsilon(1e-4));
    difmesh::write_mesh(folder / name, mesh, {.normals = false, .edge_ids = false});
    const Mesh bare = difmesh::read_mesh(folder / name);
    CHECK(bare.normals.empty());
    CHECK(bare.edge_ids.empty());
  }
}

TEST_CASE("scalars come with the mesh from the formats that have them") {
  const TempFolder folder;
  Mesh mesh = test::ball(8);
  mesh.scalars = {heights(mesh)};
  for (const difmesh::MeshFormat& format : difmesh::mesh_formats()) {
    const std::string name = "m" + std::string(format.extension);
    CAPTURE(name);
    difmesh::write_mesh(folder / name, mesh, {.scalars = false});
    CHECK(difmesh::read_mesh(folder / name).scalars.empty());
    difmesh::write_mesh(folder / name, mesh);
    const MeshFile back = difmesh::read_mesh_file(folder / name);
    CHECK(back.mesh.positions.size() == mesh.positions.size());
    REQUIRE(back.mesh.scalars.size() == (format.scalars ? 1 : 0));
    CHECK((!format.scalars || back.mesh.scalars[0].name == "height"));
  }
}

TEST_CASE("the format of glTF is that of the options or else of the extension") {
  const TempFolder folder;
  const Mesh mesh = test::ball(8);
  difmesh::write_mesh(folder / "any", mesh, {.format = ".glb"});
  difmesh::write_mesh(folder / "m.glb", mesh);
  CHECK(test::read_bytes(folder / "any") == test::read_bytes(folder / "m.glb"));
  difmesh::write_mesh(folder / "m.glb", mesh, {.format = "gltf"});
  difmesh::write_mesh(folder / "m.gltf", mesh);
  CHECK(test::read_bytes(folder / "m.glb") == test::read_bytes(folder / "m.gltf"));
  test::check_error([&] { difmesh::write_mesh(folder / "m.glb", mesh, {.format = ".xyz"}); },
                    ErrorCode::invalid_argument, {"m.glb", "'.xyz'", ".glb, .gltf and .drc"});
}

TEST_CASE("a small surface far from zero keeps its digits") {
  const TempFolder folder;
  const double spacing = 1e-3;
  const Mesh mesh = test::ball(100, {1e6, 1e6, 1e6}, spacing);
  const auto report = difmesh::write_mesh(folder / "m.glb", mesh);
  const Glb glb(test::read_bytes(folder / "m.glb"));
  const Json& node = glb.json.at("nodes").at(0);
  Vec3 translation{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    translation[axis] = node.at("translation").at(axis).get<double>();
  }
  CHECK(translation == report.local_origin);
  double worst = 0.0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double local = glb.component<float>(glb.attribute("POSITION"), v, axis);
      // Exact: both numbers are multiples of 2^-33 and close to each other.
      const double truth = mesh.positions[v][axis] - translation[axis];
      worst = std::max(worst, std::abs(local - truth));
    }
  }
  CHECK(worst <= 1e-5 * spacing);
  CHECK(worst <= report.position_error);
  // Without the local origin float32 has nothing left: its step at 1e6 is 62 cells.
  difmesh::write_mesh(folder / "m.glb", mesh, {.local_origin = Vec3{0, 0, 0}});
  CHECK(largest_difference(difmesh::read_mesh(folder / "m.glb").positions, mesh.positions) >
        10 * spacing);
}

TEST_CASE("min and max are exact and indices as short as they can be") {
  const TempFolder folder;
  for (const std::uint32_t vertices : {65535U, 65536U}) {
    Mesh mesh = test::sheet(256);
    mesh.positions.resize(vertices);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
      return std::max({t[0], t[1], t[2]}) >= vertices;
    });
    difmesh::write_mesh(folder / "m.glb", mesh);
    const Glb glb(test::read_bytes(folder / "m.glb"));
    const Json& indices =
        glb.json.at("accessors").at(glb.primitive().at("indices").get<std::size_t>());
    CHECK(indices.at("componentType") == (vertices == 65535 ? 5123 : 5125));
    CHECK(indices.at("count") == 3 * mesh.triangles.size());
    const Json& positions = glb.attribute("POSITION");
    CHECK(positions.at("count") == vertices);
    CHECK(positions.at("min") == Json({-127.5, -127.5, 0.0}));
    CHECK(positions.at("max") == Json({127.5, 127.5, 0.0}));
    CHECK(glb.json.at("materials").at(0).at("doubleSided") == true);
    CHECK(difmesh::read_mesh(folder / "m.glb").triangles == mesh.triangles);
  }
}

TEST_CASE("normals of a mesh without any are those of the triangles around") {
  const TempFolder folder;
  Mesh mesh = test::sheet(4);
  mesh.positions.push_back({9, 9, 9});
  mesh.triangles.push_back({16, 16, 16});  // no area, so no normal of its own
  difmesh::write_mesh(folder / "m.glb", mesh);
  const Mesh back = difmesh::read_mesh(folder / "m.glb");
  REQUIRE(back.normals.size() == 17);
  for (const Vec3& normal : back.normals) {
    CHECK(normal == Vec3{0, 0, 1});
  }
  // On a ball they are close to the true ones.
  Mesh ball = test::ball(32);
  ball.normals.clear();
  difmesh::write_mesh(folder / "m.glb", ball);
  const Vec3 centre{16.1, 16.0, 16.0};
  for (std::size_t v = 0; const Vec3& normal : difmesh::read_mesh(folder / "m.glb").normals) {
    double dot = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      dot += normal[axis] * (ball.positions[v][axis] - centre[axis]);
    }
    REQUIRE(dot / (0.4 * 32) > 0.98);
    ++v;
  }
}

TEST_CASE("z up and the unit are in a root node that reading leaves out") {
  const TempFolder folder;
  const Mesh mesh = test::ball(10);
  difmesh::write_mesh(folder / "m.glb", mesh, {.up = difmesh::UpAxis::z, .metres_per_unit = 0.001});
  const Glb glb(test::read_bytes(folder / "m.glb"));
  const Json& root =
      glb.json.at("nodes").at(glb.json.at("scenes").at(0).at("nodes").at(0).get<std::size_t>());
  CHECK(root.at("scale") == Json({0.001, 0.001, 0.001}));
  // The quaternion (x,0,0,w) turns about x: z goes to (0, -2xw, w² - x²), which must be y.
  const double x = root.at("rotation").at(0);
  const double w = root.at("rotation").at(3);
  CHECK(root.at("rotation").at(1) == 0.0);
  CHECK(root.at("rotation").at(2) == 0.0);
  CHECK(-2.0 * x * w == doctest::Approx(1.0));
  CHECK(w * w - x * x == doctest::Approx(0.0));
  check_float_rounded(difmesh::read_mesh(folder / "m.glb"), mesh, middle(mesh));
  // A reader that does not know our frame turns and scales.
  Glb strange = glb;
  strange.json.at("nodes").at(0).erase("extras");
  const Mesh turned = difmesh::read_mesh(folder.file("t.glb", strange.bytes()));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    const Vec3& q = turned.positions[v];
    REQUIRE(std::abs(q[0] - 0.001 * p[0]) + std::abs(q[1] - 0.001 * p[2]) +
                std::abs(q[2] + 0.001 * p[1]) <
            1e-8);
  }
}

TEST_CASE("split meshes have small primitives and come back whole") {
  const TempFolder folder;
  Mesh mesh = test::ball(20);
  mesh.scalars = {heights(mesh)};
  difmesh::write_mesh(folder / "whole.glb", mesh);
  const MeshFile whole = difmesh::read_mesh_file(folder / "whole.glb");
  for (const std::int64_t most : {3, 4, 300}) {
    const auto report = difmesh::write_mesh(folder / "m.glb", mesh, {.most_vertices = most});
    const Glb glb(test::read_bytes(folder / "m.glb"));
    const std::size_t parts = glb.json.at("meshes").at(0).at("primitives").size();
    CHECK(static_cast<std::int64_t>(parts) == report.primitives);
    CHECK(parts * static_cast<std::size_t>(most) >= mesh.positions.size());
    for (std::size_t p = 0; p < parts; ++p) {
      REQUIRE(glb.attribute("POSITION", p).at("count") <= most);
    }
    const MeshFile back = difmesh::read_mesh_file(folder / "m.glb");
    CHECK(back.mesh.positions == whole.mesh.positions);
    CHECK(back.mesh.triangles == whole.mesh.triangles);
    CHECK(back.mesh.normals == whole.mesh.normals);
    CHECK(back.mesh.edge_ids == whole.mesh.edge_ids);
    CHECK(back.mesh.scalars[0].values == whole.mesh.scalars[0].values);
    difmesh::write_mesh(folder / "d.glb", mesh, {.draco = {{}}, .most_vertices = most + 97});
    const difmesh::Measure m = difmesh::measure(difmesh::read_mesh(folder / "d.glb"));
    CHECK(m.closed);
    CHECK(m.vertices == static_cast<std::int64_t>(mesh.positions.size()));
  }
}

TEST_CASE("colors follow the map between the ends of the range") {
  const TempFolder folder;
  Mesh mesh = test::sheet(3);
  mesh.scalars = {{"k", {-2, -1, 0, 1, 2, 3, 4, 5, 6}}};
  const auto color_at = [&](const difmesh::ColorBy& by, std::size_t v) {
    difmesh::write_mesh(folder / "m.glb", mesh, {.color = by});
    const Glb glb(test::read_bytes(folder / "m.glb"));
    const Json& accessor = glb.attribute("COLOR_0");
    CHECK(accessor.at("normalized") == true);
    CHECK(glb.component<std::uint16_t>(accessor, v, 3) == 65535);
    Vec3 color{};
    for (std::size_t c = 0; c < 3; ++c) {
      // Back from linear light to the screen's.
      const double linear = glb.component<std::uint16_t>(accessor, v, c) / 65535.0;
      color[c] = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    }
    return std::pair{color, glb.json.at("meshes").at(0).at("extras").at("difmesh")};
  };
  const auto check_color = [](const Vec3& found, const Vec3& bytes) {
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(std::abs(255.0 * found[c] - bytes[c]) < 1.0);
    }
  };
  const auto [first, extras] = color_at({"k"}, 0);
  check_color(first, {0x44, 0x01, 0x54});
  CHECK(extras.at("COLOR_0") ==
        Json({{"attribute", "_K"}, {"map", "viridis"}, {"low", -2.0}, {"high", 6.0}}));
  CHECK(extras.at("scalars").at("_K") == Json({{"name", "k"}, {"low", -2.0}, {"high", 6.0}}));
  check_color(color_at({"k"}, 8).first, {0xfd, 0xe7, 0x25});
  using difmesh::ColorMap;
  const auto [grey, even] = color_at({"k", ColorMap::cool_warm}, 2);
  check_color(grey, {0xdd, 0xdd, 0xdd});
  CHECK(even.at("COLOR_0").at("low") == -6.0);
  check_color(color_at({"k", ColorMap::cool_warm, {{-1, 1}}}, 0).first, {0x3b, 0x4c, 0xc0});
  check_color(color_at({"k", ColorMap::cool_warm, {{-1, 1}}}, 8).first, {0xb4, 0x04, 0x26});
}

TEST_CASE("names and numbers that glTF cannot hold are refused before a file is made") {
  const TempFolder folder;
  const Mesh mesh = test::sheet(3);
  const auto refused = [&](const Mesh& m, const difmesh::WriteMeshOptions& options,
                           std::initializer_list<std::string> words,
                           ErrorCode code = ErrorCode::invalid_argument) {
    test::check_error([&] { difmesh::write_mesh(folder / "m.glb", m, options); }, code, words);
    CHECK(folder.names().empty());
  };
  const VertexScalar nine{"k", difmesh::Array<double>(9, 1.0)};
  refused({}, {}, {"m.glb", "no triangles"}, ErrorCode::invalid_value);
  Mesh points;
  points.positions = mesh.positions;
  refused(points, {}, {"no triangles"}, ErrorCode::invalid_value);
  refused(test::with_scalars(mesh, {{"k", {1, 2}}}), {}, {"2 values of 'k' for 9 vertices"});
  refused(test::with_scalars(mesh, {{"", nine.values}}), {}, {"''"});
  refused(test::with_scalars(mesh, {{"a b", nine.values}}), {}, {"'a b'"});
  refused(test::with_scalars(mesh, {nine, {"K", nine.values}}), {}, {"'K'", "taken"});
  refused(test::with_scalars(mesh, {{"edge_id", nine.values}}), {}, {"'edge_id'", "taken"});
  VertexScalar bad = nine;
  bad.values[4] = std::numeric_limits<double>::quiet_NaN();
  refused(test::with_scalars(mesh, {bad}), {}, {"'k' of vertex 4 is nan"},
          ErrorCode::invalid_value);
  refused(mesh, {.color = {{"k"}}}, {"'k'", "none of the scalars"});
  refused(test::with_scalars(mesh, {nine}), {.color = {{"k", {}, {{1, 0}}}}}, {"1 to 0"});
  refused(mesh, {.metres_per_unit = 0.0}, {"metres_per_unit is 0"});
  refused(mesh, {.local_origin = Vec3{0, NAN, 0}}, {"local_origin"});
  refused(mesh, {.most_vertices = 2}, {"most_vertices is 2"});
  refused(mesh, {.draco = {{.position_bits = 25}}}, {"position_bits is 25"});
  refused(mesh, {.draco = {{.speed = 11}}}, {"speed is 11"});
  Mesh huge = mesh;
  huge.positions[3][1] = 1e300;
  refused(huge, {}, {"vertex", "float32"}, ErrorCode::invalid_value);
  Mesh tiny = mesh;
  for (Vec3& p : tiny.positions) {
    p = {p[0] * 1e-40, p[1] * 1e-40, 0};
  }
  refused(tiny, {}, {"1e-40", "larger unit"}, ErrorCode::invalid_value);
}

TEST_CASE("files beyond 4 GiB are refused by their size alone") {
  const std::uint64_t most = 0xFFFFFFFF;
  CHECK(difmesh::detail::glb_size("m.glb", 5, 3) == 12 + 8 + 8 + 8 + 4);
  CHECK(difmesh::detail::glb_size("m.glb", 4, most - 35) == most - 3);
  for (const std::uint64_t data : {most - 31, most, most + 1, ~std::uint64_t{0}}) {
    test::check_error([&] { (void)difmesh::detail::glb_size("m.glb", 4, data); },
                      ErrorCode::too_large, {"m.glb", std::to_string(data), "4 GiB", "Draco"});
  }
}
