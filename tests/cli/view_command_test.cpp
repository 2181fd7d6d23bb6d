// difmesh view: what the page holds. Browsers look at it in tests/gltf.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/reconstruct.hpp"
#include "io/surfaces.hpp"
#include "program.hpp"

namespace {

using difmesh::Mesh;
using difmesh::MeshFile;
using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::run_program;
using test::Json;
using test::TempFolder;

Json scene_of(const std::string& page) {
  const std::string head = R"(<script type="application/json" id="scene">)";
  const std::size_t from = page.find(head) + head.size();
  REQUIRE(page.find(head) != std::string::npos);
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// The surface of a page, read as the .gltf file that a data: URI makes.
MeshFile surface_of(const Json& surface, const TempFolder& folder) {
  static const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : surface.at("glb").get<std::string>()) {
    if (c == '=') {
      break;
    }
    bits = (bits << 6U) | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xFFU);
    }
  }
  return difmesh::read_mesh_file(folder.file("embedded.glb", bytes));
}

}  // namespace

TEST_CASE("view puts meshes with their scalars into one page") {
  const TempFolder folder;
  const Mesh ball = test::ball(10);
  const std::string plain = (folder / "<b>ball.ply").string();
  difmesh::write_mesh(plain, ball);
  Mesh tall = ball;
  tall.scalars = {{"height", difmesh::Array<double>(ball.positions.size(), 0.25)}};
  const std::string glb = (folder / "ball.glb").string();
  difmesh::write_mesh(glb, tall);
  const std::string page = (folder / "page.html").string();
  check_succeeds(run_program(
      {"view", plain, glb, "-o", page, "--color-by", "angle", "--color-range", "0,30", "--quiet"}));
  const std::string text = test::read_bytes(page);
  const Json scene = scene_of(text);
  CHECK(scene.at("title") == "<b>ball.ply, ball.glb");
  CHECK(scene.at("colorBy") == "angle");
  CHECK(scene.at("range") == Json({0, 30}));
  REQUIRE(scene.at("surfaces").size() == 2);
  for (std::size_t s = 0; s < 2; ++s) {
    const MeshFile shown = surface_of(scene.at("surfaces").at(s), folder);
    CHECK(shown.mesh.triangles == ball.triangles);
    std::vector<std::string> names;
    for (const difmesh::VertexScalar& scalars : shown.mesh.scalars) {
      names.push_back(scalars.name);
    }
    std::sort(names.begin(), names.end());
    const std::vector<std::string> wanted =
        s == 0 ? std::vector<std::string>{"angle", "gaussian_curvature", "mean_curvature", "x", "y",
                                          "z"}
               : std::vector<std::string>{
                     "angle", "gaussian_curvature", "height", "mean_curvature", "x", "y", "z"};
    CHECK(names == wanted);
  }
  // One file: no script, style or picture comes from elsewhere.
  CHECK(text.find("<script src") == std::string::npos);
  CHECK(text.find("<link rel=\"stylesheet\"") == std::string::npos);
}

TEST_CASE("view reconstructs a field in two ways") {
  const TempFolder folder;
  const difmesh::Grid grid{{12, 14, 16}, {1, 2, 3}, {0.1, 0.1, 0.1}};
  const auto drop = difmesh::test::drop_field(grid.dims);
  const std::string field = (folder / "drop.nrrd").string();
  difmesh::write_field(field, drop.view(), grid);
  const std::string page = (folder / "page.html").string();
  const auto outcome = run_program({"view", field, "-o", page});
  check_succeeds(outcome);
  CHECK(difmesh::test::fact(outcome.out, "size") ==
        std::to_string(test::read_bytes(page).size()) + " bytes");
  const Json scene = scene_of(test::read_bytes(page));
  for (const auto& [s, name, placement] : {std::tuple{0U, "linear", difmesh::Placement::linear},
                                           std::tuple{1U, "plic", difmesh::Placement::plic}}) {
    CHECK(scene.at("surfaces").at(s).at("name") == name);
    difmesh::Options options;
    options.placement = placement;
    const Mesh wanted = difmesh::reconstruct(drop.view(), grid, options).mesh;
    const Mesh found = surface_of(scene.at("surfaces").at(s), folder).mesh;
    REQUIRE(found.positions.size() == wanted.positions.size());
    for (std::size_t v = 0; v < wanted.positions.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        REQUIRE(std::abs(found.positions[v][axis] - wanted.positions[v][axis]) < 1e-6);
      }
    }
  }
}

TEST_CASE("view offers the error against a shape") {
  const TempFolder folder;
  const std::string field = (folder / "ball.nrrd").string();
  const std::string page = (folder / "page.html").string();
  check_succeeds(run_program({"sample", "sphere", "-o", field, "--cells", "16", "--quiet"}));
  check_succeeds(run_program(
      {"view", field, "-o", page, "--color-by", "error", "--shape", "sphere", "--quiet"}));
  const Json scene = scene_of(test::read_bytes(page));
  CHECK(scene.at("colorBy") == "error");
  CHECK(scene.at("diverging") == true);
  std::vector<double> largest;
  for (const Json& surface : scene.at("surfaces")) {
    const MeshFile shown = surface_of(surface, folder);
    const auto errors =
        std::find_if(shown.mesh.scalars.begin(), shown.mesh.scalars.end(),
                     [](const difmesh::VertexScalar& one) { return one.name == "error"; });
    REQUIRE(errors != shown.mesh.scalars.end());
    largest.push_back(0.0);
    for (std::size_t v = 0; v < errors->values.size(); ++v) {
      const difmesh::Vec3& p = shown.mesh.positions[v];
      REQUIRE(std::abs(errors->values[v] - (std::hypot(p[0], p[1], p[2]) - 1.0)) < 1e-6);
      largest.back() = std::max(largest.back(), std::abs(errors->values[v]));
    }
  }
  REQUIRE(largest.size() == 2);
  CHECK(largest[1] < 0.5 * largest[0]);  // plic against linear
  check_fails(run_program({"view", field, "-o", page, "--color-by", "error"}), 2,
              {"'error'", "--shape or --reference"});
}

TEST_CASE("view says what is wrong with its arguments") {
  const TempFolder folder;
  const std::string mesh = (folder / "m.ply").string();
  const std::string page = (folder / "page.html").string();
  difmesh::write_mesh(mesh, test::sheet(3));
  check_fails(run_program({"view", mesh, "-o", page, "--color-by", "curvature"}), 2,
              {"'curvature'", "x, y, z, angle"});
  check_fails(run_program({"view", mesh, "-o", mesh}), 2, {"m.ply"});
  check_fails(run_program({"view", (folder / "m.step").string(), "-o", page}), 1,
              {"m.step", "extension"});
  check_fails(run_program({"view", (folder / "n.ply").string(), "-o", page}), 1, {"n.ply"});
  difmesh::write_mesh(mesh, Mesh{});
  check_fails(run_program({"view", mesh, "-o", page}), 1, {"m.ply", "empty"});
  CHECK(folder.names() == std::vector<std::string>{"m.ply"});
}

TEST_CASE("view warns once of each file whose reader left something out") {
  const TempFolder folder;
  const std::string ball = (folder / "ball.glb").string();
  difmesh::write_mesh(ball, test::ball(8));
  (void)folder.file("ball.glb", test::read_bytes(ball) + "tail");
  const std::string page = (folder / "p.html").string();
  const auto outcome = run_program({"view", ball, ball, "-o", page});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.starts_with("difmesh: warning: '" + ball + "': what follows"));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  check_succeeds(run_program({"view", ball, "-o", page, "--quiet"}));
}
