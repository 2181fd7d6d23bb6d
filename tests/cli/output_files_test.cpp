// Output files appear whole or not at all.

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "io/files.hpp"
#include "program.hpp"

namespace {

using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
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

TEST_CASE("plain names are written to the current folder") {
  const Place place;
  Launch launch;
  launch.arguments = {"reconstruct", "drop.npy",  "-o",     "here.off",
                      "--report",    "here.json", "--quiet"};
  launch.folder = place.folder / ".";
  check_succeeds(run_program(launch));
  CHECK(place.folder.names() == Names{"drop.npy", "here.json", "here.off"});
}
