
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "io/surfaces.hpp"
#include "support/differences.hpp"

namespace {

using difmesh::DracoMethod;
using difmesh::ErrorCode;
using difmesh::Mesh;
using difmesh::MeshFile;
using difmesh::Vec3;
using difmesh::VertexScalar;
using difmesh::test::largest_difference;
using test::TempFolder;

/// Vertices that edge ids match are at most `bound` apart in each coordinate.
void check_by_ids(const Mesh& back, const Mesh& mesh, double bound) {
  REQUIRE(back.edge_ids.size() == back.positions.size());
  CHECK(back.positions.size() == mesh.positions.size());
  std::map<std::uint64_t, std::size_t> places;
  for (std::size_t v = 0; v < mesh.edge_ids.size(); ++v) {
    places[mesh.edge_ids[v]] = v;
  }
  for (std::size_t v = 0; v < back.positions.size(); ++v) {
    const auto place = places.find(back.edge_ids[v]);
    REQUIRE(place != places.end());
    REQUIRE(largest_difference(back.positions[v], mesh.positions[place->second]) <= bound);
  }
}

VertexScalar squares(const Mesh& mesh) {
  VertexScalar scalars{"square", {}};
  for (const Vec3& p : mesh.positions) {
    scalars.values.push_back(p[0] * p[0] - p[1]);
  }
  return scalars;
}

}  // namespace

TEST_CASE("sequential draco keeps the order") {
  const TempFolder folder;
  Mesh mesh = test::ball(16);
  const VertexScalar scalars = squares(mesh);
  mesh.scalars = {scalars};
  const auto [low, high] = std::minmax_element(scalars.values.begin(), scalars.values.end());
  for (const int bits : {8, 11, 14, 20}) {
    CAPTURE(bits);
    const difmesh::DracoOptions draco{.position_bits = bits, .method = DracoMethod::sequential};
    const auto report = difmesh::write_mesh(folder / "m.glb", mesh, {.draco = draco});
    CHECK(report.position_bits == bits);
    CHECK(report.position_error < 13.2 / (std::exp2(bits) - 1) / 2.0 + 1e-5);
    const MeshFile back = difmesh::read_mesh_file(folder / "m.glb");
    CHECK(back.mesh.triangles == mesh.triangles);
    CHECK(back.mesh.edge_ids == mesh.edge_ids);
    REQUIRE(back.mesh.positions.size() == mesh.positions.size());
    REQUIRE(back.mesh.scalars.size() == 1);
    const double scalar_error = (*high - *low) / 4095.0 / 2.0 * 1.001;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      REQUIRE(largest_difference(back.mesh.positions[v], mesh.positions[v]) <=
              report.position_error);
      REQUIRE(std::abs(back.mesh.scalars[0].values[v] - scalars.values[v]) <= scalar_error);
      const Vec3& n = back.mesh.normals[v];
      const Vec3& m = mesh.normals[v];
      const double sine = std::hypot(n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2],
                                     n[0] * m[1] - n[1] * m[0]);
      REQUIRE(std::asin(sine) * 180.0 / std::numbers::pi < 0.25);
    }
  }
}

TEST_CASE("edgebreaker draco keeps the shape at every speed") {
  const TempFolder folder;
  const Mesh mesh = test::ball(24);
  const difmesh::Measure wanted = difmesh::measure(mesh);
  for (const int speed : {0, 3, 5, 10}) {
    CAPTURE(speed);
    const auto report =
        difmesh::write_mesh(folder / "m.glb", mesh, {.draco = {{.cell_size = 1, .speed = speed}}});
    CHECK(report.position_error <= 1e-3);
    const Mesh back = difmesh::read_mesh(folder / "m.glb");
    check_by_ids(back, mesh, report.position_error);
    const difmesh::Measure found = difmesh::measure(back);
    CHECK(found.closed);
    CHECK(found.manifold);
    CHECK(found.euler_number == 2);
    CHECK(found.triangles == wanted.triangles);
    // Vertices off by at most e in each coordinate change the volume by at most √3 e times the
    // area.
    CHECK(std::abs(found.volume - wanted.volume) <=
          std::numbers::sqrt3 * report.position_error * wanted.area);
  }
}

TEST_CASE("the default position bits keep errors within a thousandth of a cell") {
  const TempFolder folder;
  for (const std::int64_t cells : {8, 16, 48}) {
    const Mesh mesh = test::ball(cells, {0, 0, 0}, 0.125);
    const auto report =
        difmesh::write_mesh(folder / "m.drc", mesh, {.draco = {{.cell_size = 0.125}}});
    CHECK(report.position_error <= 1.01e-3 * 0.125);
    // One bit less would not do.
    const auto less = difmesh::write_mesh(folder / "less.drc", mesh,
                                          {.draco = {{.position_bits = report.position_bits - 1}}});
    CHECK(less.position_error > 1e-3 * 0.125);
    const auto guessed = difmesh::write_mesh(folder / "m.drc", mesh);
    CHECK(std::abs(guessed.position_bits - report.position_bits) <= 1);
  }
}

TEST_CASE("the error of draco holds away from the origin too") {
  const TempFolder folder;
  const difmesh::DracoOptions draco{.position_bits = 13, .method = DracoMethod::sequential};
  // The further away, the coarser float32 is there; positions of the last are about its centre.
  for (const double place : {0.0, 300.0, 1500.0, 2500.0, 1e6}) {
    CAPTURE(place);
    const Mesh mesh = test::ball(16, {place, -place, place});
    const auto drc = difmesh::write_mesh(folder / "m.drc", mesh, {.draco = draco});
    CHECK(largest_difference(difmesh::read_mesh(folder / "m.drc").positions, mesh.positions) <=
          drc.position_error);
    const auto glb = difmesh::write_mesh(folder / "m.glb", mesh,
                                         {.draco = draco, .local_origin = Vec3{0, 0, 0}});
    CHECK(largest_difference(difmesh::read_mesh(folder / "m.glb").positions, mesh.positions) <=
          glb.position_error);
  }
}

TEST_CASE("drc files come back with ids and scalars and their place") {
  const TempFolder folder;
  Mesh near = test::ball(16);
  Mesh far = test::ball(16, {1e6, -1e6, 1e6}, 1e-3);
  near.scalars = {squares(near)};
  far.scalars = {squares(far)};
  for (const Mesh* mesh : {&near, &far}) {
    const double spacing = mesh == &near ? 1.0 : 1e-3;
    const auto report =
        difmesh::write_mesh(folder / "m.drc", *mesh, {.draco = {{.cell_size = spacing}}});
    const std::string bytes = test::read_bytes(folder / "m.drc");
    CHECK(report.bytes == static_cast<std::int64_t>(bytes.size()));
    CHECK((bytes.find("difmesh_origin") != std::string::npos) == (mesh == &far));
    CHECK((report.local_origin != Vec3{0, 0, 0}) == (mesh == &far));
    const MeshFile back = difmesh::read_mesh_file(folder / "m.drc");
    CHECK(report.position_error <= 1.01e-3 * spacing);
    // The rounding of float64 at 1e6 comes on top.
    check_by_ids(back.mesh, *mesh, report.position_error + (mesh == &far ? 3e-10 : 0.0));
    REQUIRE(back.mesh.scalars.size() == 1);
    CHECK(back.mesh.scalars[0].name == "square");
  }
}

TEST_CASE("draco packs soups that are no manifold") {
  const TempFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}};
  for (const DracoMethod method : {DracoMethod::edgebreaker, DracoMethod::sequential}) {
    const auto report =
        difmesh::write_mesh(folder / "m.glb", mesh, {.draco = {{.method = method}}});
    const Mesh back = difmesh::read_mesh(folder / "m.glb");
    CHECK(report.vertices == static_cast<std::int64_t>(back.positions.size()));
    CHECK(report.triangles == static_cast<std::int64_t>(back.triangles.size()));
    CHECK(difmesh::measure(back).area == doctest::Approx(1.5).epsilon(1e-3));
    CHECK(back.triangles.size() == (method == DracoMethod::sequential ? 4 : 3));
  }
}

TEST_CASE("draco refuses what it cannot hold and says why") {
  const TempFolder folder;
  const auto refused = [&](const Mesh& mesh, const difmesh::WriteMeshOptions& options,
                           std::initializer_list<std::string> words, ErrorCode code) {
    test::check_error([&] { difmesh::write_mesh(folder / "m.drc", mesh, options); }, code, words);
    CHECK(folder.names().empty());
  };
  refused({}, {}, {"no triangles"}, ErrorCode::invalid_value);
  const Mesh mesh = test::sheet(3);
  refused(mesh, {.draco = {{.normal_bits = 1}}}, {"normal_bits is 1"}, ErrorCode::invalid_argument);
  refused(mesh, {.draco = {{.cell_size = -1}}}, {"cell_size"}, ErrorCode::invalid_argument);
  refused(test::with_scalars(mesh, {{"k", {}}}), {}, {"0 values"}, ErrorCode::invalid_argument);
}

TEST_CASE("vertices that no triangle uses cost the surface nothing") {
  const TempFolder folder;
  Mesh mesh = test::ball(12, {5e5, 5.4e6, 300}, 0.01);
  mesh.scalars = {squares(mesh)};
  Mesh stray = mesh;
  stray.positions.insert(stray.positions.begin(), {0, 0, 0});
  stray.positions.push_back({1e9, -1e9, 3});
  stray.normals.insert(stray.normals.begin(), {0, 0, 1});
  stray.normals.push_back({0, 0, 1});
  stray.edge_ids.insert(stray.edge_ids.begin(), 0);
  stray.edge_ids.push_back(~std::uint64_t{0});
  for (difmesh::Triangle& t : stray.triangles) {
    t = {t[0] + 1, t[1] + 1, t[2] + 1};
  }
  stray.scalars = mesh.scalars;
  stray.scalars[0].values.insert(stray.scalars[0].values.begin(), -1e30);
  stray.scalars[0].values.push_back(1e30);
  for (const char* name : {"m.glb", "m.gltf", "m.drc", "c.glb"}) {
    for (const DracoMethod method : {DracoMethod::edgebreaker, DracoMethod::sequential}) {
      CAPTURE(name);
      const difmesh::DracoOptions draco{.method = method};
      const auto write = [&](const Mesh& what) {
        difmesh::WriteMeshOptions options;
        if (name == std::string("m.drc") || name == std::string("c.glb")) {
          options.draco = draco;
        }
        return difmesh::write_mesh(folder / name, what, options);
      };
      const auto plain = write(mesh);
      const std::string bytes = test::read_bytes(folder / name);
      const auto report = write(stray);
      CHECK(test::read_bytes(folder / name) == bytes);  // ranges, boxes, origin and all
      CHECK(report.vertices == static_cast<std::int64_t>(mesh.positions.size()));
      CHECK(report.position_error == plain.position_error);
      CHECK(report.position_error < 1e-5 * 1.01);
      const MeshFile back = difmesh::read_mesh_file(folder / name);
      // float64 itself has steps of 1e-9 there.
      check_by_ids(back.mesh, mesh, report.position_error + 2e-9);
      CHECK(difmesh::measure(back.mesh).volume ==
            doctest::Approx(difmesh::measure(mesh).volume).epsilon(1e-3));
    }
  }
}

TEST_CASE("draco holds meshes with more vertices than three per triangle") {
  const TempFolder folder;
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {7, 7, 7}, {0, 0, 1}, {0.5, 0.5, 0.5}};
  mesh.triangles = {{0, 1, 3}};
  for (const DracoMethod method : {DracoMethod::edgebreaker, DracoMethod::sequential}) {
    difmesh::write_mesh(folder / "m.drc", mesh, {.draco = {{.method = method}}});
    difmesh::write_mesh(folder / "m.glb", mesh, {.draco = {{.method = method}}});
    for (const char* name : {"m.drc", "m.glb"}) {
      const Mesh back = difmesh::read_mesh(folder / name);
      CHECK(back.positions.size() == 3);
      CHECK(difmesh::measure(back).area == doctest::Approx(std::sqrt(0.75)).epsilon(1e-3));
    }
  }
}

TEST_CASE("drc: normals and scalars that are not finite are left out") {
  const TempFolder folder;
  // A float that both attributes hold and no position, so that its bytes can be found and changed.
  Mesh mesh = test::sheet(3);
  mesh.normals.assign(9, {0, 0, 1});
  mesh.scalars = {{"k", difmesh::Array<double>(9, 0.3)}};
  difmesh::write_mesh(folder / "m.drc", mesh);
  std::string bytes = test::read_bytes(folder / "m.drc");
  CHECK(difmesh::read_mesh_file(folder / "m.drc").warnings.empty());
  // The low end of the scalars' range, from which all are counted.
  const std::size_t low = bytes.find(test::bytes_of(0.3F));
  REQUIRE(low != std::string::npos);
  bytes.replace(low, 4, test::bytes_of(std::numeric_limits<float>::quiet_NaN()));
  const auto path = folder.file("m.drc", bytes);
  const MeshFile found = difmesh::read_mesh_file(path);
  CHECK(found.mesh.triangles.size() == 8);
  CHECK(found.mesh.normals.size() == 9);
  CHECK(found.mesh.scalars.empty());
  REQUIRE(found.warnings.size() == 1);
  CHECK(found.warnings[0] ==
        "'" + path.string() + "': the attribute 'k' is not finite everywhere, and was left out.");
}

TEST_CASE("drc: vertices that are not finite are left out where no triangle uses them") {
  std::string bytes = "DRACO\2\2\1";
  bytes += std::string(3, '\0') + "\2\4\1";                   // two faces, four points
  bytes += std::string("\0\2\3\0\3\2\1\1\0\x9\3\0\0\0", 14);  // the faces, an attribute of floats
  const float bad = std::numeric_limits<float>::infinity();
  for (const float x : {0.F, 0.F, 0.F, 1.F, bad, 1.F, 2.F, 0.F, 0.F, 0.F, 2.F, 0.F}) {
    bytes += test::bytes_of(x);
  }
  const TempFolder folder;
  const MeshFile found = difmesh::read_mesh_file(folder.file("m.drc", bytes));
  CHECK(found.mesh.positions == difmesh::Array<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  CHECK(found.mesh.triangles == difmesh::Array<difmesh::Triangle>{{0, 1, 2}, {0, 2, 1}});
  CHECK(found.warnings.size() == 1);
  bytes[15] = '\1';  // the second corner
  const auto path = folder.file("m.drc", bytes);
  test::check_error([&] { (void)difmesh::read_mesh(path); }, ErrorCode::file_format,
                    {"m.drc", "vertex 1", "not finite"});
}

TEST_CASE("drc: older bitstreams are read by the letter of their versions") {
  // A tetrahedron of Draco's plainest kind: indices in bytes, coordinates as they are.
  const auto bitstream = [](char major, char minor, char geometry) {
    const auto number = [&](std::uint32_t value, bool is_long) {
      return is_long ? test::bytes_of(value) : std::string(1, static_cast<char>(value));
    };
    const int version = 10 * major + minor;
    std::string bytes = "DRACO";
    bytes += {major, minor, geometry, 0, 0, 0};                           // sequential, no flags
    bytes += number(4, version < 22) + number(4, version < 22);           // faces and points
    bytes += std::string("\1\0\2\1\0\1\3\1\2\3\0\3\2", 13);               // plain indices
    bytes += '\1' + number(1, version < 20);                              // a decoder, an attribute
    bytes += std::string("\0\x9\3\0", 4);                                 // positions, 3 x float32
    bytes += version < 13 ? std::string(2, '\0') : std::string(1, '\0');  // their id
    bytes += '\0';                                                        // as they are
    for (const float x : {0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 0.F, 3.F, 0.F, 0.F, 0.F, 4.F}) {
      bytes += test::bytes_of(x);
    }
    return bytes;
  };
  const TempFolder folder;
  const auto read = [&](char major, char minor, char geometry = 1) {
    return difmesh::read_mesh(folder.file("m.drc", bitstream(major, minor, geometry)));
  };
  for (const auto& [major, minor] :
       {std::array<char, 2>{1, 0}, {1, 1}, {1, 2}, {1, 3}, {2, 0}, {2, 1}, {2, 2}}) {
    const std::string version = std::to_string(major) + "." + std::to_string(minor);
    CAPTURE(version);
    const Mesh mesh = read(major, minor);
    CHECK(mesh.positions == difmesh::Array<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}});
    CHECK(difmesh::measure(mesh).volume == doctest::Approx(4.0));
  }
  const auto refused = [&](char major, char minor, char geometry, const char* word) {
    test::check_error([&] { (void)read(major, minor, geometry); }, ErrorCode::file_format, {word});
  };
  refused(0, 9, 1, "version 0.9; 1.0 to 2.2");
  refused(2, 3, 1, "version 2.3");
  refused(2, 3, 0, "a point cloud of Draco, which has no triangles");
  refused(1, 1, 0, "a point cloud of Draco, which has no triangles");
  refused(2, 2, 2, "no mesh of Draco");
}

TEST_CASE("drc: no beginning of a good file is good and no changed byte harms") {
  const TempFolder folder;
  const Mesh mesh = test::ball(4);
  for (const DracoMethod method : {DracoMethod::edgebreaker, DracoMethod::sequential}) {
    difmesh::write_mesh(folder / "m.drc", mesh, {.draco = {{.method = method}}});
    const std::string bytes = test::read_bytes(folder / "m.drc");
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const auto path = folder.file("m.drc", bytes.substr(0, length));
      CHECK_THROWS_AS((void)difmesh::read_mesh(path), difmesh::Error);
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const char change : {'\1', '\x10', '\x7f', '\xff'}) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ change);
        const auto path = folder.file("m.drc", changed);
        try {
          const Mesh back = difmesh::read_mesh(path);
          for (const difmesh::Triangle& t : back.triangles) {
            REQUIRE(std::max({t[0], t[1], t[2]}) < back.positions.size());
          }
        } catch (const difmesh::Error& error) {
          CHECK(std::string(error.what()).find("m.drc") != std::string::npos);
        }
      }
    }
  }
}
