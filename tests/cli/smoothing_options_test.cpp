// difmesh reconstruct --mollify, --smooth and --curvature: files hold what the library gives.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/curvature.hpp"
#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/mollify.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/smoothing.hpp"
#include "difmesh/vertex_curvature.hpp"
#include "io/files.hpp"
#include "program.hpp"

namespace {

using difmesh::Array;
using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Mesh;
using difmesh::MeshFile;
using difmesh::Options;
using difmesh::Vec3;
using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::OwnedField;
using difmesh::test::run_program;
using difmesh::test::same_bytes;
using test::TempFolder;
using Words = std::vector<std::string>;

const Grid kGrid{{20, 16, 18}, {-1.5, 2.0, 0.25}, {0.1, 0.125, 0.08}};

struct Place {
  TempFolder folder;
  std::string field = (folder / "drop.nrrd").string();
  std::string report = (folder / "report.json").string();
  OwnedField drop = difmesh::test::drop_field(kGrid.dims);

  Place() { difmesh::write_field(field, drop.view(), kGrid); }

  [[nodiscard]] difmesh::test::Outcome run(const std::string& mesh, const Words& options) const {
    Words arguments{"reconstruct", field, "-o", (folder / mesh).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }
  [[nodiscard]] MeshFile reconstruct(const Words& options) const {
    Words all{"--quiet", "--report", report};
    all.insert(all.end(), options.begin(), options.end());
    check_succeeds(run("mesh.ply", all));
    return difmesh::read_mesh_file(folder / "mesh.ply");
  }
  [[nodiscard]] nlohmann::json facts() const {
    return nlohmann::json::parse(test::read_bytes(report));
  }
  [[nodiscard]] Mesh wanted() const {
    Options options;
    options.edge_ids = true;
    return difmesh::reconstruct(drop.view(), kGrid, options).mesh;
  }
};

}  // namespace

TEST_CASE("--mollify smooths the field first") {
  const Place place;
  for (const double radius : {2.0, 3.5}) {
    difmesh::MollifyOptions options;
    options.radius = radius;
    options.boundary.fill(difmesh::Side::empty);
    const Array<double> smooth = difmesh::mollify(place.drop.view(), options);
    Options wanted;
    wanted.boundary = options.boundary;
    const Mesh expected =
        difmesh::reconstruct(FieldView::x_fastest(smooth.data(), kGrid.dims), kGrid, wanted).mesh;
    const Mesh mesh =
        place.reconstruct({radius == 2.0 ? "--mollify" : "--mollify=3.5", "--boundary", "empty"})
            .mesh;
    CHECK(difmesh::test::same_bits(mesh, expected));
    CHECK(place.facts()["options"]["mollify"] == radius);
  }
  static_cast<void>(place.reconstruct({}));
  CHECK(place.facts()["options"]["mollify"].is_null());
  CHECK(place.facts()["options"]["smooth"].is_null());
}

TEST_CASE("--mollify names the cell of the field that is out of bounds") {
  Place place;
  place.drop.at(3, 4, 5) = 1.5;
  difmesh::write_field(place.field, place.drop.view(), kGrid);
  check_fails(place.run("mesh.ply", {"--mollify"}), 1, {"drop.nrrd", "(3, 4, 5)", "1.5"});
}

TEST_CASE("--smooth moves the vertices as the library does") {
  const Place place;
  const Mesh given = place.wanted();
  const auto check = [&](const std::string& words, const Array<Vec3>& expected) {
    CAPTURE(words);
    const Mesh mesh = place.reconstruct({"--smooth", words}).mesh;
    CHECK(same_bytes(mesh.positions, expected));
    CHECK(same_bytes(mesh.triangles, given.triangles));
    CHECK(mesh.edge_ids.empty());
    CHECK_FALSE(same_bytes(mesh.positions, given.positions));
    const nlohmann::json facts = place.facts();
    CHECK(facts["mesh"]["enclosed_volume"] ==
          doctest::Approx(difmesh::measure(expected, given.triangles).volume).epsilon(1e-14));
    const std::string told = facts["options"]["smooth"];
    CHECK(told.starts_with(words.substr(0, words.find(':')) + ":"));
  };
  difmesh::LaplacianOptions laplacian;
  check("laplacian", difmesh::smooth_laplacian(given.positions, given.triangles, laplacian));
  laplacian.steps = 7;
  check("laplacian:7", difmesh::smooth_laplacian(given.positions, given.triangles, laplacian));
  difmesh::TaubinOptions taubin;
  check("taubin", difmesh::smooth_taubin(given.positions, given.triangles, taubin));
  taubin.steps = 4;
  check("taubin:4", difmesh::smooth_taubin(given.positions, given.triangles, taubin));
  difmesh::CurvatureFlowOptions flow;
  flow.time = 0.25 * 0.08 * 0.08;
  check("flow:0.25", difmesh::smooth_by_curvature_flow(given.positions, given.triangles, flow));
  difmesh::ConstrainedSmoothingOptions constrained;
  check("constrained", difmesh::smooth_within_fractions(given, kGrid, constrained).mesh.positions);
  constrained.tolerance = 2e-3;
  check("constrained:2e-3",
        difmesh::smooth_within_fractions(given, kGrid, constrained).mesh.positions);
}

TEST_CASE("--smooth renews normals and keeps edge ids where they are asked for") {
  const Place place;
  const Mesh mesh =
      place.reconstruct({"--smooth", "taubin:3", "--vertex-normals", "--edge-ids"}).mesh;
  CHECK(same_bytes(mesh.edge_ids, place.wanted().edge_ids));
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  // Every normal is on the side of its triangles.
  for (const difmesh::Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    Vec3 u;
    Vec3 v;
    for (std::size_t n = 0; n < 3; ++n) {
      u[n] = mesh.positions[t[1]][n] - a[n];
      v[n] = mesh.positions[t[2]][n] - a[n];
    }
    const Vec3 area{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
    const double size = std::hypot(area[0], area[1], area[2]);
    for (const std::uint32_t corner : t) {
      const Vec3& n = mesh.normals[corner];
      REQUIRE(std::hypot(n[0], n[1], n[2]) == doctest::Approx(1.0).epsilon(1e-12));
      REQUIRE(n[0] * area[0] + n[1] * area[1] + n[2] * area[2] > 0.3 * size);
    }
  }
}

TEST_CASE("--curvature comes with the vertices bit for bit") {
  const Place place;
  const MeshFile surface = place.reconstruct({"--curvature"});
  const difmesh::Curvature expected = difmesh::curvature(surface.mesh);
  REQUIRE(surface.mesh.scalars.size() == 2);
  CHECK(surface.mesh.scalars[0].name == "mean_curvature");
  CHECK(same_bytes(surface.mesh.scalars[0].values, expected.mean));
  CHECK(surface.mesh.scalars[1].name == "gaussian_curvature");
  CHECK(same_bytes(surface.mesh.scalars[1].values, expected.gaussian));
  CHECK(place.facts()["options"]["curvature"] == true);
}

TEST_CASE("--curvature of curved surfaces is that of the cells") {
  const Place place;
  const MeshFile surface = place.reconstruct({"--curvature", "--placement", "curved"});
  CHECK(surface.mesh.edge_ids.empty());
  Options options;
  options.placement = difmesh::Placement::curved;
  options.edge_ids = true;
  const Mesh mesh = difmesh::reconstruct(place.drop.view(), kGrid, options).mesh;
  const difmesh::Curvature expected =
      difmesh::vertex_curvature(place.drop.view(), kGrid, mesh, options);
  REQUIRE(surface.mesh.scalars.size() == 2);
  CHECK(same_bytes(surface.mesh.scalars[0].values, expected.mean));
  CHECK(same_bytes(surface.mesh.scalars[1].values, expected.gaussian));
}

TEST_CASE("--curvature writes 0 where there is none and says so") {
  const TempFolder folder;
  OwnedField field({9, 9, 9});
  field.at(4, 4, 4) = 1.0;
  const std::string path = (folder / "cell.npy").string();
  difmesh::write_field(path, field.view());
  const std::string mesh = (folder / "mesh.ply").string();
  const auto outcome = run_program({"reconstruct", path, "-o", mesh, "--curvature"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("no curvature") != std::string::npos);
  CHECK(outcome.err.find("6 of 6 vertices") != std::string::npos);
  const MeshFile surface = difmesh::read_mesh_file(mesh);
  REQUIRE(surface.mesh.scalars.size() == 2);
  CHECK(std::all_of(surface.mesh.scalars[0].values.begin(), surface.mesh.scalars[0].values.end(),
                    [](double value) { return value == 0.0; }));
  check_succeeds(run_program({"reconstruct", path, "-o", mesh, "--curvature", "--quiet"}));
}

TEST_CASE("wrong words for smoothing are named") {
  const Place place;
  check_fails(place.run("m.ply", {"--smooth", "sand"}), 2,
              {"--smooth", "'sand'", "laplacian, taubin, flow, constrained"});
  check_fails(place.run("m.ply", {"--smooth", "taubin:0"}), 2, {"--smooth", "'0'"});
  check_fails(place.run("m.ply", {"--smooth", "taubin:1.5"}), 2, {"--smooth", "'1.5'"});
  check_fails(place.run("m.ply", {"--smooth", "constrained:0.6"}), 2, {"--smooth", "'0.6'"});
  check_fails(place.run("m.ply", {"--smooth", "flow:"}), 2, {"--smooth", "''"});
  check_fails(place.run("m.ply", {"--mollify=0.5"}), 2, {"--mollify", "'0.5'"});
  for (const std::string name : {"m.obj", "m.off", "m.stl"}) {
    check_fails(place.run(name, {"--curvature"}), 2, {"--curvature", name});
  }
  // Fractions are measured under closed surfaces only.
  OwnedField half(kGrid.dims);
  for (std::size_t n = 0; n < half.values.size() / 2; ++n) {
    half.values[n] = 1.0;
  }
  difmesh::write_field(place.field, half.view(), kGrid);
  check_fails(place.run("m.ply", {"--smooth", "constrained"}), 2, {"drop.nrrd", "open"});
}
