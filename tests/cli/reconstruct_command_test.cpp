// difmesh reconstruct: every option does what its name says, and files hold what the library gives.

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/version.hpp"
#include "io/files.hpp"
#include "program.hpp"

namespace {

using difmesh::Boundary;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::Mesh;
using difmesh::Normals;
using difmesh::Options;
using difmesh::Placement;
using difmesh::Side;
using difmesh::Vec3;
using difmesh::test::box_field;
using difmesh::test::check_succeeds;
using difmesh::test::fact;
using difmesh::test::Outcome;
using difmesh::test::OwnedField;
using difmesh::test::run_program;
using difmesh::test::same_bits;
using test::TempFolder;
using test::write_table;
using Words = std::vector<std::string>;

const Grid kGrid{{20, 16, 18}, {-1.5, 2.0, 0.25}, {0.1, 0.125, 0.08}};

/// A drop with wisps in its bulk and an overshoot of 0.05.
OwnedField rough_drop(const Index3& dims) {
  OwnedField field = difmesh::test::drop_field(dims);
  for (double& value : field.values) {
    value = value == 0.0 ? 1e-4 : value;
  }
  field.at(dims[0] / 2, dims[1] / 2, dims[2] / 2) = 1.05;
  return field;
}

struct Place {
  TempFolder folder;
  std::string mesh = (folder / "mesh.ply").string();

  /// Runs the program on the file and reads its mesh back.
  Mesh reconstruct(const std::string& field, const Words& options) {
    Words arguments{"reconstruct", (folder / field).string(), "-o", mesh, "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    check_succeeds(run_program(arguments));
    return difmesh::read_mesh(mesh);
  }
  /// Runs it without --quiet.
  Outcome run(const std::string& field, const Words& options = {}) {
    Words arguments{"reconstruct", (folder / field).string(), "-o", mesh};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }
};

nlohmann::json read_json(const std::filesystem::path& path) {
  return nlohmann::json::parse(test::read_bytes(path));
}

}  // namespace

TEST_CASE("the mesh in the file is that of the library bit for bit") {
  Place place;
  const OwnedField field = rough_drop(kGrid.dims);
  write_field(place.folder / "drop.nrrd", field.view(), kGrid);
  const auto check = [&](const Words& arguments, const Options& options) {
    CAPTURE(arguments.back());
    const Mesh expected = reconstruct(field.view(), kGrid, options).mesh;
    REQUIRE(expected.triangles.size() > 500);
    CHECK(same_bits(place.reconstruct("drop.nrrd", arguments), expected));
  };
  Options options;
  check({"--quiet"}, options);
  for (const auto& [name, placement] : {std::pair{"midpoint", Placement::midpoint},
                                        {"linear", Placement::linear},
                                        {"manson", Placement::manson},
                                        {"plic", Placement::plic}}) {
    options.placement = placement;
    check({"--placement", name}, options);
  }
  for (const auto& [name, normals] : {std::pair{"youngs", Normals::youngs},
                                      {"myc", Normals::myc},
                                      {"elvira", Normals::elvira},
                                      {"lvira", Normals::lvira},
                                      {"height_function", Normals::height_function}}) {
    options.normals = normals;
    check({"--normals", name}, options);
  }
  options.vertex_normals = true;
  check({"--vertex-normals"}, options);
  options.vertex_normals = false;
  options.purity_tolerance = 1e-3;
  check({"--purity-tolerance", "1e-3"}, options);
}

TEST_CASE("the choices of method change the mesh") {
  // Otherwise the case above could not tell an option that is read from one that is not.
  const OwnedField field = rough_drop(kGrid.dims);
  const auto mesh_of = [&](auto change) {
    Options options;
    change(options);
    return reconstruct(field.view(), kGrid, options).mesh;
  };
  const Mesh usual = mesh_of([](Options&) {});
  CHECK(!same_bits(usual, mesh_of([](Options& o) { o.placement = Placement::linear; })));
  CHECK(!same_bits(usual, mesh_of([](Options& o) { o.normals = Normals::youngs; })));
  CHECK(!same_bits(usual, mesh_of([](Options& o) { o.purity_tolerance = 1e-3; })));
}

TEST_CASE("boundaries are those of the library") {
  Place place;
  OwnedField field = difmesh::test::white_noise({6, 5, 7}, 3);
  write_field(place.folder / "noise.npy", field.view());
  const Grid grid{field.dims, {0, 0, 0}, {1, 1, 1}};
  const auto check = [&](const std::string& text, const Boundary& boundary) {
    CAPTURE(text);
    Options options;
    options.boundary = boundary;
    const Mesh expected = reconstruct(field.view(), grid, options).mesh;
    CHECK(same_bits(place.reconstruct("noise.npy", {"--boundary", text}), expected));
  };
  for (const auto& [name, side] : {std::pair{"open", Side::open},
                                   {"mirror", Side::mirror},
                                   {"periodic", Side::periodic},
                                   {"empty", Side::empty},
                                   {"full", Side::full}}) {
    check(name, {side, side, side, side, side, side});
  }
  check("open,mirror,empty,full,periodic,periodic",
        {Side::open, Side::mirror, Side::empty, Side::full, Side::periodic, Side::periodic});
}

TEST_CASE("stretched axes come from files") {
  Place place;
  OwnedField field = difmesh::test::white_noise({4, 5, 3}, 3);
  write_field(place.folder / "noise.npy", field.view());
  Grid grid{field.dims, {0.5, 0, 0}, {2.0, 1, 1}};
  grid.faces[1] = {0.0, 1.0, 2.5, 3.0, 4.0, 7.0};
  grid.faces[2] = {-1.0, 1.0, 1.5, 3.0};
  write_table(place.folder / "y.npy", grid.faces[1]);
  write_table(place.folder / "z.npy", grid.faces[2]);
  const std::string y = (place.folder / "y.npy").string();
  const std::string z = (place.folder / "z.npy").string();
  const Mesh mesh = place.reconstruct(
      "noise.npy", {"--edges", "," + y + "," + z, "--origin", "0.5,0,0", "--spacing", "2,1,1"});
  CHECK(same_bits(mesh, reconstruct(field.view(), grid).mesh));
  CHECK(place.run("noise.npy", {"--edges", y + "," + y + "," + z})
            .err.find("faces in x: 6 for 4 cells") != std::string::npos);
  const Outcome twice =
      place.run("noise.npy", {"--edges", y + "," + y + "," + y, "--spacing", "2"});
  CHECK(twice.exit_code == 2);
  CHECK(twice.err.find("--spacing: --edges tells it already") != std::string::npos);
  CHECK(place.run("noise.npy", {"--edges", "," + y + "," + z, "--mollify"})
            .err.find("not with --edges") != std::string::npos);
  CHECK(place.run("noise.npy", {"--edges", y}).err.find("three files wanted") != std::string::npos);
  CHECK(place.run("noise.npy", {"--edges", ",,none.npy"}).err.find("none.npy") !=
        std::string::npos);
}

TEST_CASE("a box on a grid of its own unit keeps its place and volume") {
  Place place;
  const Grid grid{{16, 14, 18}, {0, 0, 0}, {0.5, 0.5, 0.5}};
  const Vec3 low{1.3, 1.1, 0.9};
  const Vec3 high{6.6, 5.9, 7.2};
  write_field(place.folder / "box.npy", box_field(grid, low, high).view());
  const Outcome outcome = place.run("box.npy", {"--spacing", "0.5"});
  check_succeeds(outcome);
  const Mesh mesh = difmesh::read_mesh(place.mesh);
  const difmesh::Measure facts = measure(mesh);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Faces are exact but for what the box's edges do to them: a hundredth of a cell.
    CHECK(std::abs(facts.low[axis] - low[axis]) < 0.005);
    CHECK(std::abs(facts.high[axis] - high[axis]) < 0.005);
  }
  CHECK(fact(outcome.out, "vertices") == std::to_string(mesh.positions.size()));
  CHECK(fact(outcome.out, "triangles") == std::to_string(mesh.triangles.size()));
  CHECK(fact(outcome.out, "closed") == "yes");
  CHECK(fact(outcome.out, "mesh") == place.mesh);
  CHECK(fact(outcome.out, "cells").starts_with("16 x 14 x 18, interfacial: "));
  const double volume = 5.3 * 4.8 * 6.3;
  CHECK(std::stod(fact(outcome.out, "fraction volume")) == doctest::Approx(volume).epsilon(1e-9));
  const double enclosed = std::stod(fact(outcome.out, "enclosed volume"));
  CHECK(enclosed == doctest::Approx(facts.volume).epsilon(1e-9));
  CHECK(std::stod(fact(outcome.out, "difference")) ==
        doctest::Approx(facts.volume / volume - 1.0).epsilon(0.01));
  CHECK(fact(outcome.out, "seconds").find("read") != std::string::npos);
}

TEST_CASE("origin and spacing of the command line come before those of the file") {
  Place place;
  const OwnedField field = difmesh::test::drop_field(kGrid.dims);
  write_field(place.folder / "drop.nrrd", field.view(), kGrid);
  write_field(place.folder / "drop.npy", field.view());
  const auto check = [&](const std::string& name, const Words& arguments, const Grid& grid) {
    CAPTURE(name);
    CHECK(same_bits(place.reconstruct(name, arguments), reconstruct(field.view(), grid).mesh));
  };
  const Vec3 origin{-1e-3, 20, 3.5};
  const Vec3 spacing{0.1, 0.2, 0.3};
  check("drop.npy", {}, {kGrid.dims, {0, 0, 0}, {1, 1, 1}});
  check("drop.nrrd", {}, kGrid);
  check("drop.nrrd", {"--origin", "-1e-3,20,3.5"}, {kGrid.dims, origin, kGrid.spacing});
  check("drop.nrrd", {"--spacing", "0.1,0.2,0.3"}, {kGrid.dims, kGrid.origin, spacing});
  check("drop.npy", {"--origin", "-2", "--spacing", "+0.5"},
        {kGrid.dims, {-2, -2, -2}, {0.5, 0.5, 0.5}});
}

TEST_CASE("the summary says where the grid was assumed") {
  Place place;
  const OwnedField field = difmesh::test::drop_field(kGrid.dims);
  write_field(place.folder / "drop.nrrd", field.view(), kGrid);
  write_field(place.folder / "drop.npy", field.view());
  const std::string assumed = place.run("drop.npy", {"--origin", "1,2,3"}).out;
  CHECK(fact(assumed, "origin") == "1 2 3");
  CHECK(fact(assumed, "spacing").starts_with("1 1 1  (assumed"));
  const std::string told = place.run("drop.nrrd").out;
  CHECK(fact(told, "origin") == "-1.5 2 0.25");
  CHECK(fact(told, "spacing") == "0.1 0.125 0.08");
}

TEST_CASE("raw files are read in each type and order") {
  Place place;
  const OwnedField field = difmesh::test::drop_field(kGrid.dims);
  const auto raw = [&](auto convert, bool big_endian) {
    std::string bytes;
    for (const double value : field.values) {
      bytes += test::bytes_of(convert(value), big_endian);
    }
    return bytes;
  };
  const auto check = [&](const auto& values, const std::string& bytes, const Words& options) {
    CAPTURE(options[1]);
    (void)place.folder.file("field.dat", bytes);
    Words arguments{"--raw-dims", "20,16,18"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Mesh expected =
        reconstruct(difmesh::FieldView::x_fastest(values.data(), kGrid.dims), {kGrid.dims}).mesh;
    CHECK(same_bits(place.reconstruct("field.dat", arguments), expected));
  };
  const auto converted = [&](auto convert) {
    std::vector<decltype(convert(0.0))> values;
    for (const double value : field.values) {
      values.push_back(convert(value));
    }
    return values;
  };
  const auto to_float = [](double value) { return static_cast<float>(value); };
  const auto to_byte = [](double value) { return static_cast<std::uint8_t>(255.0 * value); };
  const auto to_word = [](double value) { return static_cast<std::uint16_t>(65535.0 * value); };
  const auto to_double = [](double value) { return value; };
  check(converted(to_double), raw(to_double, false), {"--raw-type", "float64"});
  check(converted(to_float), raw(to_float, false), {"--raw-type", "float32"});
  check(converted(to_byte), raw(to_byte, false), {"--raw-type", "uint8"});
  check(converted(to_word), raw(to_word, false), {"--raw-type", "uint16"});
  check(converted(to_word), raw(to_word, true), {"--raw-type", "uint16", "--raw-big-endian"});
  check(converted(to_float), "seven b" + raw(to_float, true),
        {"--raw-type", "float32", "--raw-big-endian", "--raw-offset", "7"});
}

TEST_CASE("the extension tells the format of the mesh") {
  Place place;
  write_field(place.folder / "drop.npy", difmesh::test::drop_field(kGrid.dims).view());
  const Mesh ply = place.reconstruct("drop.npy", {});
  for (const std::string extension : {"obj", "off", "OFF", "stl"}) {
    CAPTURE(extension);
    place.mesh = (place.folder / ("mesh." + extension)).string();
    const Mesh mesh = place.reconstruct("drop.npy", {});
    CHECK(mesh.positions.size() == ply.positions.size());
    CHECK(mesh.triangles.size() == ply.triangles.size());
    if (extension != "stl") {
      CHECK(same_bits(mesh, ply));
    }
  }
}

TEST_CASE("files are the same bytes for any number of threads") {
  Place place;
  write_field(place.folder / "noise.npy", difmesh::test::white_noise({40, 36, 32}, 5).view());
  Words bytes;
  for (const std::string threads : {"1", "3", "0"}) {
    (void)place.reconstruct("noise.npy", {"--threads", threads, "--vertex-normals"});
    bytes.push_back(test::read_bytes(place.mesh));
  }
  CHECK(bytes[0].size() > 100000);
  CHECK(bytes[0] == bytes[1]);
  CHECK(bytes[0] == bytes[2]);
}

TEST_CASE("quiet prints nothing at all") {
  Place place;
  write_field(place.folder / "drop.npy", rough_drop(kGrid.dims).view());
  const Outcome outcome = place.run("drop.npy", {"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.empty());
}

TEST_CASE("clamped cells and an empty mesh are worth a warning") {
  Place place;
  write_field(place.folder / "drop.npy", rough_drop(kGrid.dims).view());
  const Outcome clamped = place.run("drop.npy");
  CHECK(clamped.exit_code == 0);
  CHECK(clamped.err.starts_with("difmesh: warning: "));
  CHECK(clamped.err.find("drop.npy': clamped 1 cell outside [0, 1], the farthest by 0.05\n") !=
        std::string::npos);

  write_field(place.folder / "thin.npy", OwnedField({4, 4, 4}, 0.25).view());
  const Outcome empty = place.run("thin.npy");
  CHECK(empty.exit_code == 0);
  CHECK(empty.err.find("thin.npy': no fraction crosses 1/2, the mesh is empty\n") !=
        std::string::npos);
  CHECK(difmesh::read_mesh(place.mesh).positions.empty());
}

TEST_CASE("a mesh that is not closed has no volume to compare") {
  Place place;
  const Grid grid{{6, 6, 6}, {0, 0, 0}, {1, 1, 1}};
  write_field(place.folder / "slab.npy", box_field(grid, {-1, -1, -1}, {7, 7, 2.3}).view());
  const std::string summary = place.run("slab.npy", {"--report", place.mesh + ".json"}).out;
  CHECK(fact(summary, "closed").starts_with("no"));
  CHECK(fact(summary, "enclosed volume").starts_with("none"));
  CHECK(summary.find("difference") == std::string::npos);
  CHECK(std::stod(fact(summary, "fraction volume")) == doctest::Approx(6 * 6 * 2.3));
  const difmesh::Measure facts = measure(difmesh::read_mesh(place.mesh));
  CHECK(facts.area == doctest::Approx(36).epsilon(1e-12));
  CHECK(facts.low[2] == doctest::Approx(2.3).epsilon(1e-12));
  CHECK(facts.high[2] == doctest::Approx(2.3).epsilon(1e-12));
  const nlohmann::json report = read_json(place.mesh + ".json");
  CHECK(report["mesh"]["closed"] == false);
  CHECK(report["mesh"]["enclosed_volume"].is_null());
  CHECK(report["mesh"]["volume_difference"].is_null());
}

TEST_CASE("the surface of the empty part has no volume to compare") {
  Place place;
  OwnedField field({6, 6, 6}, 1.0);
  field.at(3, 3, 3) = 0.0;
  write_field(place.folder / "hole.npy", field.view());
  const std::string summary = place.run("hole.npy", {"--boundary", "full"}).out;
  CHECK(fact(summary, "closed") == "yes");
  CHECK(std::stod(fact(summary, "enclosed volume")) < 0.0);
  CHECK(summary.find("difference") == std::string::npos);
}

TEST_CASE("the report holds what the library reports") {
  Place place;
  OwnedField field = difmesh::test::drop_field(kGrid.dims);
  field.at(10, 8, 9) = 1.05;
  write_field(place.folder / "drop.nrrd", field.view(), kGrid);
  const auto path = place.folder / "report.json";
  const Outcome outcome =
      place.run("drop.nrrd", {"--report", path.string(), "--spacing", "0.1", "--boundary",
                              "periodic,periodic,open,mirror,empty,open"});
  CHECK(outcome.exit_code == 0);
  Options options;
  options.boundary = {Side::periodic, Side::periodic, Side::open,
                      Side::mirror,   Side::empty,    Side::open};
  const Grid grid{kGrid.dims, kGrid.origin, {0.1, 0.1, 0.1}};
  const auto [mesh, expected] = reconstruct(field.view(), grid, options);
  const nlohmann::json report = read_json(path);

  CHECK(report["program"] == "difmesh");
  CHECK(report["version"] == DIFMESH_VERSION);
  CHECK(report["field"]["path"] == (place.folder / "drop.nrrd").string());
  CHECK(report["field"]["type"] == "float64");
  CHECK(report["field"]["dims"] == kGrid.dims);
  CHECK(report["field"]["origin"] == grid.origin);
  CHECK(report["field"]["origin_from"] == "file");
  CHECK(report["field"]["spacing"] == grid.spacing);
  CHECK(report["field"]["spacing_from"] == "command line");
  CHECK(report["field"]["cells"] == expected.cells);
  CHECK(report["field"]["interfacial_cells"] == expected.interfacial_cells);
  CHECK(report["field"]["clamped_cells"] == 1);
  CHECK(report["field"]["largest_overshoot"] == expected.largest_overshoot);
  CHECK(report["field"]["fraction_volume"] == expected.fraction_volume);
  CHECK(report["options"]["placement"] == "plic");
  CHECK(report["options"]["normals"] == "height_function");
  CHECK(report["options"]["boundary"] ==
        Words{"periodic", "periodic", "open", "mirror", "empty", "open"});
  CHECK(report["options"]["purity_tolerance"] == 1e-6);
  CHECK(report["options"]["overshoot_bound"] == 0.1);
  CHECK(report["options"]["clearance"] == 1e-12);
  CHECK(report["options"]["vertex_normals"] == false);
  CHECK(report["options"]["threads"] == 0);
  CHECK(report["mesh"]["path"] == place.mesh);
  CHECK(report["mesh"]["vertices"] == mesh.positions.size());
  CHECK(report["mesh"]["triangles"] == mesh.triangles.size());
  CHECK(report["mesh"]["closed"] == true);
  CHECK(report["mesh"]["enclosed_volume"] == expected.enclosed_volume);
  CHECK(report["mesh"]["volume_difference"].get<double>() ==
        doctest::Approx(expected.enclosed_volume / expected.fraction_volume - 1.0).epsilon(1e-9));
  CHECK(report["work"]["planes"] == expected.planes);
  CHECK(report["work"]["height_function_cells"] == expected.height_function_cells);
  CHECK(report["work"]["gradient_free_cells"] == expected.gradient_free_cells);
  CHECK(report["work"]["solved_edges"] == expected.solved_edges);
  CHECK(report["work"]["newton_steps_mean"] == expected.newton_steps_mean);
  CHECK(report["work"]["newton_steps_max"] == expected.newton_steps_max);
  CHECK(report["work"]["non_monotone_edges"] == expected.non_monotone_edges);
  double phases = 0.0;
  for (const char* phase : {"classify", "normals", "count", "vertices", "triangles"}) {
    phases += report["seconds"][phase].get<double>();
  }
  CHECK(phases > 0.0);
  CHECK(phases <= 1.001 * report["seconds"]["reconstruct"].get<double>());
}

TEST_CASE("the report can go to standard output in place of the summary") {
  Place place;
  write_field(place.folder / "drop.npy", difmesh::test::drop_field(kGrid.dims).view());
  const Outcome outcome = place.run("drop.npy", {"--report", "-"});
  check_succeeds(outcome);
  CHECK(nlohmann::json::parse(outcome.out)["mesh"]["closed"] == true);
  CHECK(place.folder.names() == Words{"drop.npy", "mesh.ply"});
}
