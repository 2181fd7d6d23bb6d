// Output files appear whole or not at all.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "io/files.hpp"
#include "program.hpp"

namespace {

using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::fact;
using difmesh::test::Launch;
using difmesh::test::Outcome;
using difmesh::test::run_program;
using test::read_bytes;
using test::TempFolder;
using Names = std::vector<std::string>;

/// A folder with a field whose mesh takes some 100 kB.
struct Place {
  TempFolder folder;
  std::string field = (folder / "drop.npy").string();
  std::string mesh = (folder / "mesh.ply").string();
  std::string report = (folder / "report.json").string();

  Place() { write_field(field, difmesh::test::drop_field({24, 24, 24}).view()); }
  [[nodiscard]] Launch launch() const {
    Launch launch;
    launch.arguments = {"reconstruct", field, "-o", mesh, "--report", report, "--quiet"};
    return launch;
  }
};

constexpr const char* kFull = "/dev/full";

}  // namespace

TEST_CASE("unwritable targets are named before the work starts") {
  const Place place;
  const std::string nowhere = (place.folder / "nowhere" / "mesh.ply").string();
  const std::string missing = (place.folder / "missing.npy").string();
  // The field is missing too: that the target is named shows that it was looked at first.
  check_fails(run_program({"reconstruct", missing, "-o", nowhere}), 1,
              {nowhere, "No such file or directory"});
  check_fails(run_program({"reconstruct", missing, "-o", place.mesh, "--report",
                           (place.folder / "nowhere" / "report.json").string()}),
              1, {"report.json", "No such file or directory"});
  std::filesystem::create_directory(place.folder / "folder.ply");
  check_fails(run_program({"reconstruct", missing, "-o", (place.folder / "folder.ply").string()}),
              1, {"folder.ply", "Is a directory"});
  check_fails(run_program({"info", place.field, "--json",
                           (place.folder / "nowhere" / "info.json").string()}),
              1, {"info.json", "No such file or directory"});
  CHECK(place.folder.names() == Names{"drop.npy", "folder.ply"});
}

TEST_CASE("a device that is full is an error") {
  if (!std::filesystem::exists(kFull)) {
    MESSAGE("skipped: no /dev/full here");
    return;
  }
  const Place place;
  std::filesystem::create_symlink(kFull, place.folder / "full.ply");
  std::filesystem::create_symlink(kFull, place.folder / "full.json");
  check_fails(run_program({"reconstruct", place.field, "-o", (place.folder / "full.ply").string(),
                           "--report", place.report}),
              1, {"full.ply", "No space left on device"});
  CHECK(place.folder.names() == Names{"drop.npy", "full.json", "full.ply"});
  check_fails(run_program({"info", place.field, "--json", (place.folder / "full.json").string()}),
              1, {"full.json", "No space left on device"});
  Launch launch;
  launch.arguments = {"info", place.field};
  launch.out_path = kFull;
  check_fails(run_program(launch), 1, {"standard output"});
}

TEST_CASE("a disk that fills up leaves neither mesh nor report") {
  const Place place;
  Launch launch = place.launch();
  launch.file_size_limit = 16384;  // the report fits, the mesh does not
  check_fails(run_program(launch), 1, {"mesh.ply", "File too large"});
  CHECK(place.folder.names() == Names{"drop.npy"});
  launch.file_size_limit = 100;  // not even the report fits
  check_fails(run_program(launch), 1, {"report.json", "File too large"});
  CHECK(place.folder.names() == Names{"drop.npy"});
}

TEST_CASE("older files stay when the work fails and are replaced when it succeeds") {
  const Place place;
  (void)place.folder.file("mesh.ply", "old mesh");
  (void)place.folder.file("report.json", "old report");
  Launch launch = place.launch();
  launch.file_size_limit = 16384;
  CHECK(run_program(launch).exit_code == 1);
  CHECK(read_bytes(place.mesh) == "old mesh");
  CHECK(read_bytes(place.report) == "old report");
  launch.file_size_limit.reset();
  check_succeeds(run_program(launch));
  CHECK(read_bytes(place.mesh).starts_with("ply\n"));
  CHECK(read_bytes(place.report).starts_with("{\n"));
  CHECK(place.folder.names() == Names{"drop.npy", "mesh.ply", "report.json"});
}

TEST_CASE("a link stays a link and its file is replaced") {
  const Place place;
  (void)place.folder.file("real.json", "old");
  std::filesystem::create_symlink("real.json", place.report);
  check_succeeds(run_program(place.launch()));
  CHECK(std::filesystem::is_symlink(place.report));
  CHECK(read_bytes(place.folder / "real.json").starts_with("{\n"));
}

TEST_CASE("links to files that are not there yet stay links") {
  const Place place;
  std::filesystem::create_symlink("new.ply", place.mesh);
  std::filesystem::create_symlink("hop.json", place.report);
  std::filesystem::create_symlink("new.json", place.folder / "hop.json");
  check_succeeds(run_program(place.launch()));
  CHECK(read_bytes(place.folder / "new.ply").starts_with("ply\n"));
  CHECK(read_bytes(place.folder / "new.json").starts_with("{\n"));
  for (const char* name : {"mesh.ply", "report.json", "hop.json"}) {
    CHECK_MESSAGE(std::filesystem::is_symlink(place.folder / name), name);
  }
}

TEST_CASE("links that go in circles or to one file are refused before the work starts") {
  const Place place;
  const std::string missing = (place.folder / "missing.npy").string();
  const std::string loop = (place.folder / "loop.ply").string();
  std::filesystem::create_symlink("loop.ply", loop);
  check_fails(run_program({"reconstruct", missing, "-o", loop}), 1,
              {"loop.ply", "Too many levels of symbolic links"});
  std::filesystem::create_symlink("same", place.mesh);
  std::filesystem::create_symlink("same", place.report);
  check_fails(run_program({"reconstruct", missing, "-o", place.mesh, "--report", place.report}), 2,
              {"report.json", "two things at once"});
  CHECK(place.folder.names() == Names{"drop.npy", "loop.ply", "mesh.ply", "report.json"});
}

TEST_CASE("a far origin is too much for stl and warned of") {
  const Place place;
  const auto run = [&](const char* name, std::initializer_list<std::string> more) {
    std::vector<std::string> arguments{
        "reconstruct", place.field, "-o", (place.folder / name).string(), "--report", place.report};
    arguments.insert(arguments.end(), more);
    return run_program(arguments);
  };
  const std::string far = "500000,5400000,300";
  const Outcome stl = run("far.stl", {"--origin", far, "--spacing", "0.01"});
  CHECK(stl.exit_code == 0);
  const auto report = nlohmann::json::parse(read_bytes(place.report));
  // What the file holds, against the same surface in double precision.
  check_succeeds(run("far.ply", {"--origin", far, "--spacing", "0.01"}));
  const difmesh::Mesh exact = difmesh::read_mesh(place.folder / "far.ply");
  double error = 0.0;
  std::int64_t collapsed = 0;
  for (const difmesh::Triangle& t : exact.triangles) {
    std::array<difmesh::Vec3, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double coordinate = exact.positions[t[c]][axis];
        corners[c][axis] = static_cast<double>(static_cast<float>(coordinate));
        error = std::max(error, std::abs(coordinate - corners[c][axis]));
      }
    }
    const difmesh::Triangle whole{0, 1, 2};
    collapsed += difmesh::measure(corners, {&whole, 1}).area == 0.0 ? 1 : 0;
  }
  CHECK(error > 0.1);  // ulps of float32 are 1/2 there
  CHECK(collapsed > 100);
  CHECK(report["file"]["position_error"] == error);
  CHECK(report["file"]["collapsed_triangles"] == collapsed);
  CHECK(report["file"]["bytes"] == std::filesystem::file_size(place.folder / "far.stl"));
  REQUIRE(report["warnings"].size() == 1);
  CHECK(stl.err == "difmesh: warning: " + report["warnings"][0].get<std::string>() + "\n");
  for (const std::string& word : {std::string("far.stl"), std::to_string(collapsed) + " of ",
                                  std::string(" times the spacing")}) {
    CHECK_MESSAGE(stl.err.find(word) != std::string::npos, word);
  }
  const std::string file = fact(stl.out, "file");
  const std::string words = "coordinates off by ";
  REQUIRE(file.find(words) != std::string::npos);
  CHECK(std::stod(file.substr(file.find(words) + words.size())) ==
        doctest::Approx(error).epsilon(0.01));

  // Without triangles that collapse it is a matter of the spacing: 3e-4 of it, then 0.03.
  check_succeeds(run("near.stl", {"--origin", "5000", "--spacing", "1"}));
  const Outcome coarse = run("coarse.stl", {"--origin", "500000", "--spacing", "1"});
  CHECK(coarse.exit_code == 0);
  CHECK(coarse.err.find(" times the spacing") != std::string::npos);
}

TEST_CASE("what is in the file is told for every format") {
  const Place place;
  for (const char* name : {"m.ply", "m.obj", "m.off"}) {
    const Outcome outcome =
        run_program({"reconstruct", place.field, "-o", (place.folder / name).string()});
    check_succeeds(outcome);
    CHECK(fact(outcome.out, "file") ==
          std::to_string(std::filesystem::file_size(place.folder / name)) +
              " bytes, coordinates exact");
  }
  const Outcome stl =
      run_program({"reconstruct", place.field, "-o", (place.folder / "m.stl").string()});
  check_succeeds(stl);
  CHECK(fact(stl.out, "file").find(" bytes, coordinates off by ") != std::string::npos);
}

TEST_CASE("names of files reach no terminal as they are") {
  const Place place;
  const std::string name =
      "a\x1b[31m\nb\x7f\xc2\x9b"
      "c.ply";
  const std::string path = (place.folder / name).string();
  const std::string shown = "a\\x1b[31m\\nb\\x7f";
  const auto check_printable = [&](const std::string& text) {
    CAPTURE(text);
    CHECK(std::none_of(text.begin(), text.end(),
                       [](char c) { return (c >= 0 && c < ' ' && c != '\n') || c == '\x7f'; }));
    CHECK(text.find("\xc2\x9b") == std::string::npos);
  };
  const Outcome made = run_program({"reconstruct", place.field, "-o", path});
  check_succeeds(made);
  check_printable(made.out);
  CHECK(fact(made.out, "mesh").find(shown) != std::string::npos);
  const Outcome told = run_program({"info", path});
  check_succeeds(told);
  check_printable(told.out);
  CHECK(fact(told.out, "mesh").find(shown) != std::string::npos);
  const Outcome json = run_program({"info", path, "--json", "-"});
  check_succeeds(json);
  check_printable(json.out);
  CHECK(nlohmann::json::parse(json.out)["path"] == path);
  const Outcome missing = run_program({"info", path + ".ply"});
  CHECK(missing.exit_code == 1);
  check_printable(missing.err);
  CHECK(missing.err.find(shown) != std::string::npos);
}

TEST_CASE("plain names are written to the current folder") {
  const Place place;
  Launch launch;
  launch.arguments = {"reconstruct", "drop.npy",  "-o",     "here.off",
                      "--report",    "here.json", "--quiet"};
  launch.folder = place.folder / ".";
  check_succeeds(run_program(launch));
  CHECK(place.folder.names() == Names{"drop.npy", "here.json", "here.off"});
}
