// difmesh compare: distances whose closed forms are known, and the way from a shape to its surface
// and back.

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "io/files.hpp"
#include "program.hpp"
#include "support/triangle_meshes.hpp"

namespace {

using difmesh::Vec3;
using difmesh::test::box_mesh;
using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::fact;
using difmesh::test::Outcome;
using difmesh::test::run_program;
using difmesh::test::TriangleMesh;
using difmesh::test::write_triangles;
using nlohmann::json;
using std::numbers::pi;
using test::TempFolder;
using Words = std::vector<std::string>;

struct Place {
  TempFolder folder;

  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
  [[nodiscard]] std::string write(const std::string& name, const TriangleMesh& mesh) const {
    return write_triangles(folder / name, mesh).string();
  }
  [[nodiscard]] json compare(const std::string& mesh, const Words& options) const {
    Words arguments{"compare", mesh, "--json", path("report.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_program(arguments);
    check_succeeds(outcome);
    CHECK(outcome.out.empty());
    return json::parse(test::read_bytes(path("report.json")));
  }
  /// sample, then reconstruct: the mesh.
  [[nodiscard]] std::string surface(const std::string& body, const Words& options) const {
    Words sample{"sample", body, "-o", path("field.nrrd"), "--quiet"};
    sample.insert(sample.end(), options.begin(), options.end());
    check_succeeds(run_program(sample));
    check_succeeds(
        run_program({"reconstruct", path("field.nrrd"), "-o", path("surface.ply"), "--quiet"}));
    return path("surface.ply");
  }
};

/// All corners on the unit sphere about 0.
TriangleMesh octahedron() {
  return {{{1.0, 0.0, 0.0},
           {-1.0, 0.0, 0.0},
           {0.0, 1.0, 0.0},
           {0.0, -1.0, 0.0},
           {0.0, 0.0, 1.0},
           {0.0, 0.0, -1.0}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

constexpr double kThird = 1.0 / 3.0;

}  // namespace

TEST_CASE("sample and reconstruct and compare find a sphere again to second order") {
  const Place place;
  const double radius = 1.5;
  const Words sphere{"--radius", "1.5", "--centre", "0.1,-0.2,0.3"};
  std::vector<double> rms;
  for (const char* const cells : {"26", "46"}) {  // 20 and 40 across the ball
    CAPTURE(cells);
    Words sample = sphere;
    sample.insert(sample.end(), {"--cells", cells});
    Words compare = sphere;
    compare.insert(compare.end(), {"--shape", "sphere"});
    const json found = place.compare(place.surface("sphere", sample), compare);
    // A facet of edge h on a sphere of radius R is h^2 / (8 R) below it at the middle of an edge.
    const double spacing = 2.0 * radius / (std::stod(cells) - 6.0);
    const double sagitta = spacing * spacing / (8.0 * radius);
    CHECK(found["to_reference"]["vertices"]["rms"].get<double>() < sagitta);
    CHECK(found["to_reference"]["facets"]["rms"].get<double>() < 3.0 * sagitta);
    CHECK(found["to_reference"]["facets"]["maximum"].get<double>() < 6.0 * sagitta);
    CHECK(found["to_reference"]["facets"]["signed_mean"].get<double>() < 0.0);
    const double exact = 4.0 / 3.0 * pi * std::pow(radius, 3);
    CHECK(found["reference_volume"].get<double>() == doctest::Approx(exact).epsilon(1e-14));
    CHECK(found["volume_difference"].get<double>() ==
          doctest::Approx(found["volume"].get<double>() / exact - 1.0).epsilon(1e-9));
    CHECK(std::abs(found["volume_difference"].get<double>()) < 9.0 * sagitta / radius);
    rms.push_back(found["to_reference"]["vertices"]["rms"].get<double>());
  }
  CHECK(rms[0] > 3.4 * rms[1]);
}

TEST_CASE("an octahedron in a sphere is farthest from it at the centres of its facets") {
  const Place place;
  const std::string mesh = place.write("octahedron.off", octahedron());
  const json found = place.compare(mesh, {"--shape", "sphere"});
  CHECK(found["path"] == mesh);
  CHECK(found["reference"]["shape"]["name"] == "sphere");
  CHECK(found["reference"]["shape"]["radius"] == 1.0);
  CHECK(found["from_reference"].is_null());
  CHECK(found["hausdorff"].is_null());
  const json& to = found["to_reference"];
  CHECK(to["area"].get<double>() == doctest::Approx(4.0 * std::sqrt(3.0)).epsilon(1e-14));
  CHECK(to["vertices"]["points"] == 6);
  CHECK(to["vertices"]["maximum"].get<double>() < 1e-15);
  CHECK(to["facets"]["maximum"].get<double>() ==
        doctest::Approx(1.0 - std::sqrt(kThird)).epsilon(1e-14));
  CHECK(to["facets"]["lowest"] == -to["facets"]["maximum"].get<double>());
  CHECK(to["facets"]["maximum_index"] == 0);
  for (const json& coordinate : to["facets"]["maximum_position"]) {
    CHECK(coordinate.get<double>() == doctest::Approx(kThird).epsilon(1e-14));
  }
  CHECK(found["volume_difference"].get<double>() == doctest::Approx(1.0 / pi - 1.0).epsilon(1e-12));
}

TEST_CASE("compare says as text what it says as JSON") {
  const Place place;
  const std::string mesh = place.write("octahedron.off", octahedron());
  const Words shape{"--shape", "sphere", "--radius", "0.75"};
  const json found = place.compare(mesh, shape);
  Words arguments{"compare", mesh, "--threads", "1"};
  arguments.insert(arguments.end(), shape.begin(), shape.end());
  const Outcome outcome = run_program(arguments);
  check_succeeds(outcome);
  const auto same = [&](const std::string& name, const json& value) {
    CAPTURE(name);
    CHECK(std::stod(fact(outcome.out, name)) == doctest::Approx(value.get<double>()).epsilon(1e-5));
  };
  for (const std::string of : {"vertices", "facets"}) {
    for (const std::string what : {"rms", "mean", "maximum"}) {
      same(of + " " + what, found["to_reference"][of][what]);
    }
  }
  same("facets bias", found["to_reference"]["facets"]["signed_mean"]);
  same("volume", found["volume"]);
  same("reference volume", found["reference_volume"]);
  CHECK(fact(outcome.out, "vertices maximum").ends_with("vertex 0"));
  CHECK(found["to_reference"]["vertices"]["signed_mean"].get<double>() ==
        doctest::Approx(0.25).epsilon(1e-14));
}

TEST_CASE("two cubes one inside the other are as far apart as their corners") {
  const Place place;
  const std::string outer = place.write("outer.ply", box_mesh({-0.1, -0.1, -0.1}, {1.1, 1.1, 1.1}));
  const std::string inner = place.write("inner.stl", box_mesh({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  const json found = place.compare(outer, {"--reference", inner});
  CHECK(found["reference"]["path"] == inner);
  const double corner = 0.1 * std::sqrt(3.0);
  const json& to = found["to_reference"];
  CHECK(to["has_sign"] == true);
  for (const char* what : {"rms", "mean", "signed_mean", "maximum"}) {
    CAPTURE(what);
    CHECK(to["vertices"][what].get<double>() == doctest::Approx(corner).epsilon(1e-12));
    // Every point of the inner cube is 0.1 below the nearest face of the outer one.
    const double sign = std::string(what) == "signed_mean" ? -1.0 : 1.0;
    CHECK(sign * found["from_reference"]["facets"][what].get<double>() ==
          doctest::Approx(0.1).epsilon(1e-12));
  }
  CHECK(found["hausdorff"].get<double>() == doctest::Approx(corner).epsilon(1e-12));
  CHECK(found["volume_difference"].get<double>() ==
        doctest::Approx(1.2 * 1.2 * 1.2 - 1.0).epsilon(1e-12));

  const Outcome outcome = run_program({"compare", inner, "--reference", outer});
  check_succeeds(outcome);
  CHECK(std::stod(fact(outcome.out, "Hausdorff")) == doctest::Approx(corner).epsilon(1e-5));
  CHECK(std::stod(fact(outcome.out, "back maximum")) <= corner * (1.0 + 1e-5));
  CHECK(std::stod(fact(outcome.out, "facets bias")) == doctest::Approx(-0.1).epsilon(1e-5));
}

TEST_CASE("an open reference has neither sign nor volume") {
  const Place place;
  const std::string cube = place.write("cube.off", box_mesh({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  const std::string sheet = place.write(
      "sheet.off", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  const json found = place.compare(cube, {"--reference", sheet});
  CHECK(found["to_reference"]["has_sign"] == false);
  CHECK(found["to_reference"]["vertices"]["signed_mean"].is_null());
  CHECK(found["to_reference"]["vertices"]["mean"].get<double>() == doctest::Approx(0.5));
  CHECK(found["to_reference"]["vertices"]["maximum"] == 1.0);
  CHECK(found["volume"].get<double>() == doctest::Approx(1.0));
  CHECK(found["reference_volume"].is_null());
  CHECK(found["volume_difference"].is_null());
  const Outcome outcome = run_program({"compare", cube, "--reference", sheet});
  check_succeeds(outcome);
  CHECK(fact(outcome.out, "reference volume").starts_with("none"));
  CHECK(outcome.out.find("bias") == std::string::npos);
}

TEST_CASE("compare says what is wrong with its arguments") {
  const Place place;
  const std::string mesh = place.write("mesh.off", octahedron());
  check_fails(run_program({"compare"}), 2, {"MESH"});
  check_fails(run_program({"compare", mesh}), 2, {"--shape", "--reference"});
  check_fails(run_program({"compare", mesh, "--shape", "sphere", "--reference", mesh}), 2,
              {"--shape", "--reference", "together"});
  check_fails(run_program({"compare", mesh, "--shape", "ball"}), 2,
              {"--shape", "'ball'", "sphere, ellipsoid, torus, genus, smooth_box, golf_ball"});
  check_fails(run_program({"compare", mesh, "--reference", mesh, "--radius", "2"}), 2,
              {"--radius", "--shape"});
  check_fails(run_program({"compare", mesh, "--shape", "genus", "--radius", "2"}), 2,
              {"--radius", "genus", "--scale"});
  check_fails(run_program({"compare", mesh, "--shape", "sphere", "--json", mesh}), 2,
              {"--json", "mesh.off"});
  check_fails(run_program({"compare", mesh, "--shape", "sphere", "--threads", "-1"}), 2,
              {"--threads"});
  CHECK(place.folder.names() == Words{"mesh.off"});
}

TEST_CASE("compare names a mesh that it cannot use") {
  const Place place;
  const std::string mesh = place.write("mesh.off", octahedron());
  const std::string empty = place.write("empty.off", {});
  const std::string none = place.path("none.ply");
  check_fails(run_program({"compare", none, "--shape", "sphere"}), 1, {"none.ply", "No such file"});
  check_fails(run_program({"compare", mesh, "--reference", none}), 1, {"none.ply", "No such file"});
  check_fails(run_program({"compare", empty, "--shape", "sphere"}), 1,
              {"empty.off", "no triangles"});
  check_fails(run_program({"compare", mesh, "--reference", empty}), 1,
              {"empty.off", "no triangles"});
}

TEST_CASE("sample and reconstruct and compare find the bunny again") {
  const std::filesystem::path bunny =
      std::filesystem::path(DIFMESH_SHARED_DATA) / "bunny00_75k.off";
  if (!std::filesystem::exists(bunny)) {
    MESSAGE("skipped: no " << bunny.string());
    return;
  }
  const Place place;
  const json found = place.compare(place.surface(bunny.string(), {"--cells", "56"}),
                                   {"--reference", bunny.string()});
  const double spacing = 0.02;  // about 1 / 50
  CHECK(found["to_reference"]["facets"]["rms"].get<double>() < 0.1 * spacing);
  CHECK(found["from_reference"]["facets"]["rms"].get<double>() < 0.1 * spacing);
  CHECK(found["hausdorff"].get<double>() < 1.5 * spacing);
  CHECK(found["reference_volume"].get<double>() == doctest::Approx(0.1992055537).epsilon(1e-9));
  CHECK(std::abs(found["volume_difference"].get<double>()) < 0.01);
}
