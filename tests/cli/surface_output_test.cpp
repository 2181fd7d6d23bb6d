// difmesh reconstruct to glTF and Draco: the options reach the files, and the other commands read
// them.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "difmesh/curvature.hpp"
#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/reconstruct.hpp"
#include "io/surfaces.hpp"
#include "program.hpp"
#include "roughness.hpp"
#include "support/differences.hpp"

namespace {

using difmesh::Grid;
using difmesh::Mesh;
using difmesh::MeshFile;
using difmesh::Vec3;
using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::fact;
using difmesh::test::largest_difference;
using difmesh::test::OwnedField;
using difmesh::test::run_program;
using test::Glb;
using test::Json;
using test::TempFolder;
using Words = std::vector<std::string>;

const Grid kGrid{{20, 16, 18}, {-1.5, 2.0, 0.25}, {0.1, 0.125, 0.08}};

struct Place {
  TempFolder folder;
  std::string field = (folder / "drop.nrrd").string();
  OwnedField drop = difmesh::test::drop_field(kGrid.dims);

  Place() { difmesh::write_field(field, drop.view(), kGrid); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
  [[nodiscard]] difmesh::test::Outcome reconstruct(const std::string& name,
                                                   const Words& options) const {
    Words arguments{"reconstruct", field, "-o", path(name)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }
  [[nodiscard]] Mesh wanted() const {
    difmesh::Options options;
    options.vertex_normals = true;
    options.edge_ids = true;
    return difmesh::reconstruct(drop.view(), kGrid, options).mesh;
  }
};

}  // namespace

TEST_CASE("curvature reaches glTF and Draco and colors by it") {
  const Place place;
  const auto wanted = difmesh::curvature(place.wanted());
  const auto largest = [](const difmesh::Array<double>& a, const difmesh::Array<double>& b) {
    REQUIRE(a.size() == b.size());
    double difference = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) {
      difference = std::max(difference, std::abs(a[v] - b[v]));
    }
    return difference;
  };
  const auto check = [&](const std::string& name, const Words& options, double tolerance) {
    CAPTURE(name);
    check_succeeds(place.reconstruct(name, options));
    const MeshFile surface = difmesh::read_mesh_file(place.path(name));
    REQUIRE(surface.mesh.scalars.size() == 2);
    for (const auto& [scalars, values] : surface.mesh.scalars) {
      CAPTURE(scalars);
      const bool is_mean = scalars == "mean_curvature";
      CHECK((is_mean || scalars == "gaussian_curvature"));
      CHECK(largest(values, is_mean ? wanted.mean : wanted.gaussian) <
            (is_mean ? 1.0 : 10.0) * tolerance);
    }
    CHECK(surface.mesh.scalars[0].name != surface.mesh.scalars[1].name);
  };
  check("m.glb", {"--curvature"}, 1e-5);
  check("m.gltf", {"--curvature", "--color-by", "mean-curvature"}, 1e-5);
  check("m.drc", {"--curvature", "--draco-method", "sequential"}, 1e-2);
  // Alone, it is computed for the colours.
  check_succeeds(place.reconstruct("c.glb", {"--color-by", "gaussian-curvature"}));
  const MeshFile colored = difmesh::read_mesh_file(place.path("c.glb"));
  REQUIRE(colored.mesh.scalars.size() == 1);
  CHECK(colored.mesh.scalars[0].name == "gaussian_curvature");
  CHECK(largest(colored.mesh.scalars[0].values, wanted.gaussian) < 1e-4);
}

TEST_CASE("reconstruct writes glb with normals and edge ids and colors") {
  const Place place;
  const auto outcome = place.reconstruct(
      "m.glb",
      {"--edge-ids", "--color-by", "angle", "--color-map", "cool_warm", "--color-range", "-10,20"});
  check_succeeds(outcome);
  const std::string bytes = test::read_bytes(place.path("m.glb"));
  CHECK(fact(outcome.out, "file").starts_with(std::to_string(bytes.size()) + " bytes, "));
  const MeshFile found = difmesh::read_mesh_file(place.path("m.glb"));
  const Mesh wanted = place.wanted();
  CHECK(found.mesh.triangles == wanted.triangles);
  CHECK(found.mesh.edge_ids == wanted.edge_ids);
  CHECK(largest_difference(found.mesh.positions, wanted.positions) < 1e-6);
  CHECK(largest_difference(found.mesh.normals, wanted.normals) < 1e-6);
  REQUIRE(found.mesh.scalars.size() == 1);
  CHECK(found.mesh.scalars[0].name == "angle");
  const difmesh::Array<double> angles = difmesh::cli::largest_angles(wanted);
  for (std::size_t v = 0; v < angles.size(); ++v) {
    REQUIRE(found.mesh.scalars[0].values[v] == doctest::Approx(angles[v]).epsilon(1e-6));
  }
  CHECK(Glb(bytes).json.at("meshes").at(0).at("extras").at("difmesh").at("COLOR_0") ==
        Json({{"attribute", "_ANGLE"}, {"map", "cool_warm"}, {"low", -10.0}, {"high", 20.0}}));
}

#ifdef DIFMESH_WITH_METRICS
namespace {

/// A ball's field, and its surface's distances from the ball as they should be.
struct BallPlace {
  TempFolder folder;
  std::string field = (folder / "ball.nrrd").string();
  std::string glb = (folder / "ball.glb").string();

  BallPlace() {
    check_succeeds(run_program({"sample", "sphere", "-o", field, "--cells", "16", "--radius", "2",
                                "--centre", "1,2,3", "--quiet"}));
  }
  [[nodiscard]] static difmesh::Array<double> errors(const Mesh& mesh) {
    difmesh::Array<double> errors;
    for (const Vec3& p : mesh.positions) {
      errors.push_back(std::hypot(p[0] - 1.0, p[1] - 2.0, p[2] - 3.0) - 2.0);
    }
    return errors;
  }
};

}  // namespace

TEST_CASE("reconstruct colors by the error against a shape and a mesh") {
  const BallPlace place;
  check_succeeds(run_program({"reconstruct", place.field, "-o", place.glb, "--color-by", "error",
                              "--shape", "sphere", "--radius", "2", "--centre", "1,2,3"}));
  const MeshFile found = difmesh::read_mesh_file(place.glb);
  const difmesh::Array<double> wanted = BallPlace::errors(found.mesh);
  REQUIRE(found.mesh.scalars.size() == 1);
  CHECK(found.mesh.scalars[0].name == "error");
  double largest = 0.0;
  for (std::size_t v = 0; v < wanted.size(); ++v) {
    REQUIRE(std::abs(found.mesh.scalars[0].values[v] - wanted[v]) < 1e-6);
    largest = std::max(largest, std::abs(found.mesh.scalars[0].values[v]));
  }
  CHECK(largest > 1e-3);
  CHECK(largest < 0.02);
  const Json color = Glb(test::read_bytes(place.glb))
                         .json.at("meshes")
                         .at(0)
                         .at("extras")
                         .at("difmesh")
                         .at("COLOR_0");
  CHECK(color.at("attribute") == "_ERROR");
  CHECK(color.at("map") == "cool_warm");  // the one that diverges, unless told otherwise
  CHECK(color.at("high").get<double>() == doctest::Approx(largest));
  CHECK(color.at("low").get<double>() == doctest::Approx(-largest));

  // Against a mesh of it that is finer than the errors, and written without colours.
  const std::string fine = (place.folder / "fine.nrrd").string();
  const std::string reference = (place.folder / "fine.ply").string();
  check_succeeds(run_program({"sample", "sphere", "-o", fine, "--cells", "64", "--radius", "2",
                              "--centre", "1,2,3", "--quiet"}));
  check_succeeds(run_program({"reconstruct", fine, "-o", reference, "--quiet"}));
  for (const std::string name : {"again.glb", "again.drc", "again.ply"}) {
    const std::string again = (place.folder / name).string();
    check_succeeds(
        run_program({"reconstruct", place.field, "-o", again, "--reference", reference}));
    const MeshFile other = difmesh::read_mesh_file(again);
    REQUIRE(other.mesh.scalars.size() == 1);
    CHECK(other.mesh.scalars[0].name == "error");
    const difmesh::Array<double> errors = BallPlace::errors(other.mesh);
    double difference = 0.0;
    for (std::size_t v = 0; v < errors.size(); ++v) {
      difference = std::max(difference, std::abs(other.mesh.scalars[0].values[v] - errors[v]));
    }
    CHECK(difference < 0.25 * largest);
  }
}

TEST_CASE("what errors are against is checked before the work begins") {
  const BallPlace place;
  const auto refused = [&](const std::string& name, const Words& options, int code,
                           std::initializer_list<std::string> words) {
    Words all{"reconstruct", place.field, "-o", (place.folder / name).string()};
    all.insert(all.end(), options.begin(), options.end());
    check_fails(run_program(all), code, words);
    CHECK(place.folder.names() == Words{"ball.nrrd"});
  };
  refused("m.glb", {"--color-by", "error"}, 2, {"'error'", "--shape or --reference"});
  refused("m.glb", {"--shape", "cube"}, 2, {"--shape", "'cube'", "sphere"});
  refused("m.glb", {"--radius", "2"}, 2, {"--radius", "only with --shape"});
  refused("m.glb", {"--shape", "sphere", "--reference", "a.ply"}, 2, {"--shape", "--reference"});
  refused("m.obj", {"--shape", "sphere"}, 2, {"--shape", "m.obj", ".ply"});
  refused("m.glb", {"--shape", "sphere", "--tube-radius", "2"}, 2, {"--tube-radius"});
  refused("m.glb", {"--reference", place.folder / "none.ply"}, 1, {"none.ply"});
}
#endif

TEST_CASE("reconstruct compresses with as many bits as asked or needed") {
  const Place place;
  const Mesh wanted = place.wanted();
  for (const Words& options :
       {Words{"--draco"}, Words{"--draco=11"}, Words{"--draco=18", "--draco-speed", "0"}}) {
    Words all = options;
    all.insert(all.end(), {"--draco-method", "sequential"});
    for (const std::string name : {"m.glb", "m.gltf", "m.drc"}) {
      check_succeeds(place.reconstruct(name, all));
      const Mesh found = difmesh::read_mesh(place.path(name));
      CHECK(found.triangles == wanted.triangles);
      const double difference = largest_difference(found.positions, wanted.positions);
      // A thousandth of the least spacing, or half a step of the longest side.
      const double bound = options[0] == "--draco"      ? 1.01e-3 * 0.08
                           : options[0] == "--draco=11" ? 1.8 / 2047 / 2
                                                        : 1.8 / 262143 / 2;
      CHECK(difference <= bound);
      CHECK(difference > bound / 20);
    }
  }
}

TEST_CASE("info and compare and sample read glb and drc") {
  const Place place;
  check_succeeds(place.reconstruct("m.ply", {}));
  const std::string volume =
      fact(run_program({"info", place.path("m.ply")}).out, "enclosed volume");
  for (const std::string name : {"m.glb", "d.glb", "m.drc"}) {
    CAPTURE(name);
    check_succeeds(place.reconstruct(name, name == "d.glb" ? Words{"--draco"} : Words{}));
    const auto info = run_program({"info", place.path(name)});
    check_succeeds(info);
    CHECK(fact(info.out, "closed").starts_with("yes"));
    CHECK(fact(info.out, "enclosed volume").substr(0, 4) == volume.substr(0, 4));
    check_succeeds(
        run_program({"sample", place.path(name), "-o", place.path("again.nrrd"), "--cells", "12"}));
#ifdef DIFMESH_WITH_METRICS
    const std::string json = place.path("c.json");
    check_succeeds(run_program(
        {"compare", place.path(name), "--reference", place.path("m.ply"), "--json", json}));
    CHECK(Json::parse(test::read_bytes(json)).at("hausdorff").get<double>() < 2e-4);
#endif
  }
}

TEST_CASE("up and the unit reach the root node") {
  const Place place;
  check_succeeds(place.reconstruct("m.glb", {"--up", "z", "--metres-per-unit", "0.01"}));
  const Glb glb(test::read_bytes(place.path("m.glb")));
  CHECK(glb.json.at("nodes").at(0).at("scale") == Json({0.01, 0.01, 0.01}));
  CHECK(glb.json.at("nodes").at(0).at("rotation").at(0).get<double>() < -0.7);
  CHECK(largest_difference(difmesh::read_mesh(place.path("m.glb")).positions,
                           place.wanted().positions) < 1e-6);
}

TEST_CASE("options that the format does not have are wrong arguments") {
  const Place place;
  const auto refused = [&](const std::string& name, const Words& options,
                           std::initializer_list<std::string> words) {
    check_fails(place.reconstruct(name, options), 2, words);
    CHECK(place.folder.names() == Words{"drop.nrrd"});
  };
  refused("m.ply", {"--draco"}, {"--draco", "m.ply"});
  refused("m.glb", {"--draco=25"}, {"--draco", "25"});
  refused("m.glb", {"--draco=x"}, {"--draco", "'x'"});
  refused("m.glb", {"--draco-speed", "3"}, {"--draco-speed"});
  refused("m.glb", {"--draco", "--draco-speed", "11"}, {"--draco-speed", "11"});
  refused("m.glb", {"--draco", "--draco-method", "zip"}, {"'zip'", "edgebreaker"});
  refused("m.stl", {"--color-by", "z"}, {"--color-by", "m.stl"});
  refused("m.glb", {"--color-by", "curvature"}, {"'curvature'", "x, y, z, angle"});
  refused("m.glb", {"--color-map", "viridis"}, {"--color-map", "needs --color-by"});
  refused("m.glb", {"--color-by", "z", "--color-map", "jet"}, {"'jet'", "viridis, cool_warm"});
  refused("m.glb", {"--color-by", "z", "--color-range", "1"}, {"'1'"});
  refused("m.glb", {"--color-by", "z", "--color-range", "2,1"}, {"'2,1'"});
  refused("m.off", {"--up", "z"}, {"--up", "m.off"});
  refused("m.glb", {"--up", "x"}, {"'x'", "y, z"});
  refused("m.glb", {"--metres-per-unit", "0"}, {"--metres-per-unit"});
}

TEST_CASE("an empty surface is no glb and the message says so") {
  const Place place;
  const OwnedField nothing(kGrid.dims);
  difmesh::write_field(place.path("empty.nrrd"), nothing.view(), kGrid);
  check_fails(run_program({"reconstruct", place.path("empty.nrrd"), "-o", place.path("m.glb")}), 1,
              {"m.glb", "no triangles"});
}
