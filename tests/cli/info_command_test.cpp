// difmesh info: what fields and meshes hold, against counts and closed forms.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "io/files.hpp"
#include "program.hpp"
#include "support/triangle_meshes.hpp"

namespace {

using difmesh::Grid;
using difmesh::Vec3;
using difmesh::test::box_mesh;
using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::fact;
using difmesh::test::Outcome;
using difmesh::test::OwnedField;
using difmesh::test::run_program;
using difmesh::test::TriangleMesh;
using difmesh::test::write_triangles;
using test::TempFolder;
using test::write_table;
using Words = std::vector<std::string>;

/// 4 x 3 x 2 cells, one of each kind that solvers leave, the rest empty.
OwnedField zoo() {
  OwnedField field({4, 3, 2});
  field.at(0, 0, 0) = 1.0;
  field.at(1, 0, 0) = 0.25;
  field.at(2, 0, 0) = 0.5;
  field.at(3, 0, 0) = 1e-6;        // a wisp, just
  field.at(0, 1, 0) = 2e-6;        // interfacial, just
  field.at(1, 1, 0) = -1e-9;       // a wisp and outside
  field.at(2, 1, 0) = 1.0 - 5e-7;  // nearly full
  field.at(3, 1, 0) = 1.0 + 5e-7;  // outside
  field.at(0, 2, 0) = -0.125;      // the farthest outside
  field.at(3, 2, 1) = 1.0625;
  return field;
}

std::string info(const std::filesystem::path& path, Words options = {}) {
  Words arguments{"info", path.string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = run_program(arguments);
  check_succeeds(outcome);
  return outcome.out;
}

nlohmann::json info_json(const std::filesystem::path& path, Words options = {}) {
  options.insert(options.end(), {"--json", "-"});
  return nlohmann::json::parse(info(path, options));
}

}  // namespace

TEST_CASE("info tells type and grid of a field and where the grid came from") {
  const TempFolder folder;
  write_field(folder / "zoo.npy", zoo().view());
  write_field(folder / "zoo.nrrd", zoo().view(), Grid{{4, 3, 2}, {-1, 0.5, 2}, {0.5, 0.25, 0.125}});
  const std::string npy = info(folder / "zoo.npy");
  CHECK(fact(npy, "field") == (folder / "zoo.npy").string());
  CHECK(fact(npy, "type") == "float64");
  CHECK(fact(npy, "cells") == "4 x 3 x 2 = 24");
  CHECK(fact(npy, "origin").starts_with("0 0 0  (assumed"));
  CHECK(fact(npy, "spacing").starts_with("1 1 1  (assumed"));
  const std::string nrrd = info(folder / "zoo.nrrd", {"--origin", "7"});
  CHECK(fact(nrrd, "origin") == "7 7 7");
  CHECK(fact(nrrd, "spacing") == "0.5 0.25 0.125");
  const nlohmann::json json = info_json(folder / "zoo.nrrd", {"--origin", "7"});
  CHECK(json["field"]["origin"] == Vec3{7, 7, 7});
  CHECK(json["field"]["origin_from"] == "command line");
  CHECK(json["field"]["spacing_from"] == "file");
  CHECK(info_json(folder / "zoo.npy")["field"]["spacing_from"] == "assumed");
}

TEST_CASE("info tells stretched axes and says nothing of a spacing along them") {
  const TempFolder folder;
  write_field(folder / "zoo.npy", zoo().view());
  const auto write_faces = [&](const char* name, const std::vector<double>& numbers) {
    write_table(folder / name, numbers);
    return (folder / name).string();
  };
  const std::string y = write_faces("y.npy", {0.0, 1.0, 1.5, 4.0});
  const std::string text = info(folder / "zoo.npy", {"--edges", "," + y + ",", "--spacing", "2"});
  CHECK(fact(text, "spacing") == "2 - 2");
  CHECK(fact(text, "origin").starts_with("0 - 0  (assumed"));
  CHECK(fact(text, "faces in y") == "0 to 4, the least width 0.5");
  const nlohmann::json json = info_json(folder / "zoo.npy", {"--edges", "," + y + ","})["field"];
  CHECK(json["spacing"][0] == 1.0);
  CHECK(json["spacing"][1].is_null());
  CHECK(json["origin"][1].is_null());
  CHECK(json["edges"][1] == std::vector<double>{0.0, 1.0, 1.5, 4.0});
  CHECK(json["edges"][0].is_null());
  const std::string x = write_faces("x.npy", {0.0, 1.0, 1.5, 4.0, 5.0});
  const std::string z = write_faces("z.npy", {-1.0, 1.0, 2.0});
  const std::string all = info(folder / "zoo.npy", {"--edges", x + "," + y + "," + z});
  CHECK(all.find("spacing") == std::string::npos);
  CHECK(fact(all, "faces in z") == "-1 to 2, the least width 1");
  write_triangles(folder / "box.obj", box_mesh({0, 0, 0}, {1, 1, 1}));
  check_fails(run_program({"info", (folder / "box.obj").string(), "--edges", "," + y + ","}), 2,
              {"--edges", "is a mesh, it has no grid"});
}

TEST_CASE("info counts what solvers leave in a field") {
  const TempFolder folder;
  write_field(folder / "zoo.npy", zoo().view());
  const std::string text = info(folder / "zoo.npy", {"--spacing", "0.5"});
  CHECK(fact(text, "lowest fraction") == "-0.125");
  CHECK(fact(text, "highest fraction") == "1.0625");
  const double sum = 1.0 + 0.25 + 0.5 + 1e-6 + 2e-6 + (1.0 - 5e-7) + 1.0 + 1.0;
  CHECK(std::stod(fact(text, "fraction volume")) == doctest::Approx(0.125 * sum).epsilon(1e-9));
  CHECK(fact(text, "interfacial").starts_with("3 cells "));
  CHECK(fact(text, "exactly 0") == "14 cells");
  CHECK(fact(text, "exactly 1") == "1 cell");
  CHECK(fact(text, "nearly 0").starts_with("2 cells "));
  CHECK(fact(text, "nearly 1").starts_with("1 cell "));
  CHECK(fact(text, "outside [0, 1]") == "4 cells, the farthest by 0.125 at (0, 2, 0)");
  CHECK(fact(text, "NaN") == "0 cells");

  const nlohmann::json field = info_json(folder / "zoo.npy", {"--spacing", "0.5"})["field"];
  CHECK(field["cells"] == 24);
  CHECK(field["fraction_volume"].get<double>() == doctest::Approx(0.125 * sum).epsilon(1e-14));
  CHECK(field["interfacial_cells"] == 3);
  CHECK(field["empty_cells"] == 14);
  CHECK(field["full_cells"] == 1);
  CHECK(field["nearly_empty_cells"] == 2);
  CHECK(field["nearly_full_cells"] == 1);
  CHECK(field["cells_outside"] == 4);
  CHECK(field["largest_overshoot"] == 0.125);
  CHECK(field["largest_overshoot_cell"] == difmesh::Index3{0, 2, 0});
  CHECK(field["nan_cells"] == 0);
  CHECK(field["first_nan_cell"].is_null());
}

TEST_CASE("the purity tolerance moves the line between wisps and interface") {
  const TempFolder folder;
  write_field(folder / "zoo.npy", zoo().view());
  const nlohmann::json none = info_json(folder / "zoo.npy", {"--purity-tolerance", "0"})["field"];
  CHECK(none["interfacial_cells"] == 5);
  CHECK(none["nearly_empty_cells"] == 0);
  CHECK(none["nearly_full_cells"] == 0);
  const nlohmann::json wide = info_json(folder / "zoo.npy", {"--purity-tolerance", "0.1"})["field"];
  CHECK(wide["interfacial_cells"] == 2);
  CHECK(wide["nearly_empty_cells"] == 3);
  CHECK(wide["nearly_full_cells"] == 1);
  check_fails(run_program({"info", (folder / "zoo.npy").string(), "--purity-tolerance", "0.3"}), 2,
              {"--purity-tolerance", "'0.3'"});
}

TEST_CASE("info looks on after NaN and infinity") {
  const TempFolder folder;
  OwnedField field = zoo();
  field.at(2, 1, 1) = std::numeric_limits<double>::quiet_NaN();
  field.at(3, 2, 0) = -std::numeric_limits<double>::quiet_NaN();
  write_field(folder / "nan.npy", field.view());
  const std::string text = info(folder / "nan.npy");
  CHECK(fact(text, "NaN") == "2 cells, the first at (3, 2, 0)");
  CHECK(fact(text, "exactly 0") == "12 cells");
  CHECK(fact(text, "highest fraction") == "1.0625");
  CHECK(info_json(folder / "nan.npy")["field"]["first_nan_cell"] == difmesh::Index3{3, 2, 0});

  field.at(1, 2, 1) = std::numeric_limits<double>::infinity();
  write_field(folder / "inf.npy", field.view());
  CHECK(fact(info(folder / "inf.npy"), "outside [0, 1]") ==
        "5 cells, the farthest by inf at (1, 2, 1)");

  const OwnedField nothing({2, 2, 2}, std::numeric_limits<double>::quiet_NaN());
  write_field(folder / "all.npy", nothing.view());
  const std::string all = info(folder / "all.npy");
  CHECK(fact(all, "lowest fraction") == "none");
  CHECK(fact(all, "NaN") == "8 cells, the first at (0, 0, 0)");
}

TEST_CASE("info scales integers by the range of their type") {
  const TempFolder folder;
  (void)folder.file("bytes.dat", std::string("\x00\x33\xff\xff", 4));
  const nlohmann::json bytes =
      info_json(folder / "bytes.dat", {"--raw-dims", "2,2,1", "--raw-type", "uint8"})["field"];
  CHECK(bytes["type"] == "uint8");
  CHECK(bytes["dims"] == difmesh::Index3{2, 2, 1});
  CHECK(bytes["highest"] == 1.0);
  CHECK(bytes["fraction_volume"].get<double>() == doctest::Approx(2.2).epsilon(1e-14));
  CHECK(bytes["full_cells"] == 2);
  const nlohmann::json words =
      info_json(folder / "bytes.dat",
                {"--raw-dims", "2,1,1", "--raw-type", "uint16", "--raw-big-endian"})["field"];
  CHECK(words["lowest"] == 0x33 / 65535.0);
  CHECK(words["highest"] == 1.0);
}

TEST_CASE("info counts as reconstruct does on real fields") {
  for (const std::string name : {"gerris_drops64_t0.45.npy", "interfoam_dambreak_64x40x80_t0.3.npy",
                                 "isofoam_vortex64_t1.5.npy"}) {
    const std::string path = std::string(DIFMESH_SHARED_DATA) + "/" + name;
    if (!std::filesystem::exists(path)) {
      MESSAGE("skipped: " << path << " is not here");
      continue;
    }
    CAPTURE(name);
    const TempFolder folder;
    const Outcome outcome =
        run_program({"reconstruct", path, "-o", (folder / "m.ply").string(), "--report", "-"});
    CHECK(outcome.exit_code == 0);
    const nlohmann::json report = nlohmann::json::parse(outcome.out)["field"];
    const nlohmann::json field = info_json(path)["field"];
    CHECK(field["interfacial_cells"] == report["interfacial_cells"]);
    CHECK(field["cells_outside"] == report["clamped_cells"]);
    CHECK(field["largest_overshoot"] == report["largest_overshoot"]);
    CHECK(field["fraction_volume"].get<double>() ==
          doctest::Approx(report["fraction_volume"].get<double>()).epsilon(1e-12));
  }
}

TEST_CASE("info measures a closed mesh") {
  const TempFolder folder;
  const Vec3 low{-1, 2, 0.5};
  const Vec3 high{1, 5, 1.5};
  for (const std::string name : {"box.ply", "box.obj", "box.off", "box.stl", "BOX.PLY"}) {
    CAPTURE(name);
    const auto path = write_triangles(folder / name, box_mesh(low, high));
    const std::string text = info(path);
    CHECK(fact(text, "mesh") == path.string());
    CHECK(fact(text, "vertices") == "8");
    CHECK(fact(text, "triangles") == "12");
    CHECK(fact(text, "closed") == "yes");
    CHECK(fact(text, "manifold") == "yes");
    CHECK(fact(text, "components") == "1");
    CHECK(fact(text, "Euler number") == "2");
    CHECK(std::stod(fact(text, "area")) == doctest::Approx(2 * (6 + 2 + 3)));
    CHECK(std::stod(fact(text, "enclosed volume")) == doctest::Approx(6));
    CHECK(fact(text, "box") == "-1 2 0.5  to  1 5 1.5");
    CHECK(std::stod(fact(text, "roughness")) ==
          doctest::Approx(90.0 * std::sqrt(12.0 / 18.0)).epsilon(1e-3));
  }
}

TEST_CASE("info tells what is wrong with a mesh") {
  const TempFolder folder;
  TriangleMesh soup = box_mesh({0, 0, 0}, {1, 1, 1});
  soup.triangles.pop_back();
  soup.append(box_mesh({2, 0, 0}, {3, 1, 1}));
  soup.positions.push_back({9, 9, 9});
  soup.triangles.push_back({8, 8, 9});
  const std::string open = info(write_triangles(folder / "open.ply", soup));
  CHECK(fact(open, "vertices") == "17, of these in no triangle: 1");
  CHECK(fact(open, "triangles") == "24, of these without area: 1");
  CHECK(fact(open, "closed") == "no: 3 boundary edges");
  CHECK(fact(open, "manifold") == "yes");
  CHECK(fact(open, "components") == "2");
  CHECK(fact(open, "enclosed volume").starts_with("none"));
  const nlohmann::json json = info_json(folder / "open.ply")["mesh"];
  CHECK(json["closed"] == false);
  CHECK(json["boundary_edges"] == 3);
  CHECK(json["volume"].is_null());
  CHECK(json["isolated_vertices"] == 1);
  CHECK(json["degenerate_triangles"] == 1);

  TriangleMesh fins{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                    {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  const std::string bad = info(write_triangles(folder / "fins.ply", fins));
  CHECK(fact(bad, "manifold") ==
        "no: 1 non-manifold edge, 2 non-manifold vertices, 0 misoriented edges");
  CHECK(fact(bad, "roughness").starts_with("none"));

  TriangleMesh mixed = box_mesh({0, 0, 0}, {1, 1, 1});
  std::swap(mixed.triangles[7][0], mixed.triangles[7][1]);
  const std::string turned = info(write_triangles(folder / "turned.ply", mixed));
  CHECK(fact(turned, "closed") == "yes");
  CHECK(fact(turned, "manifold").ends_with("3 misoriented edges"));
  CHECK(fact(turned, "enclosed volume") == "none, the mesh has mixed orientation");
  CHECK(info_json(folder / "turned.ply")["mesh"]["volume"].is_null());
}

TEST_CASE("info tells meshes with split vertices from open ones") {
  const TempFolder folder;
  const TriangleMesh whole = box_mesh({0, 0, 0}, {1, 2, 3});
  TriangleMesh split;
  for (const difmesh::Triangle& t : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(split.positions.size());
    for (const std::uint32_t v : t) {
      split.positions.push_back(whole.positions[v]);
    }
    split.triangles.push_back({first, first + 1, first + 2});
  }
  const auto path = write_triangles(folder / "split.ply", split);
  const std::string text = info(path);
  CHECK(fact(text, "closed") == "no: 36 boundary edges; closed where equal positions are joined");
  CHECK(std::stod(fact(text, "enclosed volume")) == doctest::Approx(6));
  const nlohmann::json json = info_json(path)["mesh"];
  CHECK(json["closed"] == false);
  CHECK(json["closed_by_position"] == true);
  CHECK(json["volume"].get<double>() == doctest::Approx(6).epsilon(1e-14));

  TriangleMesh doubled = whole;
  doubled.triangles.push_back(doubled.triangles[0]);
  const auto twice = write_triangles(folder / "doubled.ply", doubled);
  const std::string bad = info(twice);
  CHECK(fact(bad, "closed") == "no: 3 edges of three triangles or more unbalanced");
  CHECK(fact(bad, "enclosed volume") == "none, the mesh is not closed");
  CHECK(info_json(twice)["mesh"]["closed_by_position"] == false);
  CHECK(info_json(twice)["mesh"]["unbalanced_edges"] == 3);
}

TEST_CASE("info in JSON goes to the file and nothing is printed") {
  const TempFolder folder;
  const auto mesh = write_triangles(folder / "box.ply", box_mesh({0, 0, 0}, {1, 2, 3}));
  const auto path = folder / "info.json";
  CHECK(info(mesh, {"--json", path.string()}).empty());
  const nlohmann::json json = nlohmann::json::parse(test::read_bytes(path));
  CHECK(json["program"] == "difmesh");
  CHECK(json["path"] == mesh.string());
  CHECK(json["mesh"]["vertices"] == 8);
  CHECK(json["mesh"]["edges"] == 18);
  CHECK(json["mesh"]["euler_number"] == 2);
  CHECK(json["mesh"]["volume"].get<double>() == doctest::Approx(6).epsilon(1e-14));
  CHECK(json["mesh"]["area"].get<double>() == doctest::Approx(22).epsilon(1e-14));
  CHECK(json["mesh"]["low"] == Vec3{0, 0, 0});
  CHECK(json["mesh"]["high"] == Vec3{1, 2, 3});
  CHECK(json["mesh"]["vertex_normals"] == false);
  CHECK(json["mesh"]["roughness_degrees"].get<double>() ==
        doctest::Approx(90.0 * std::sqrt(12.0 / 18.0)).epsilon(1e-14));
}
