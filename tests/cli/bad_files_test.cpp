// Input that is missing, broken or holds what cannot be used: exit code 1, and the file named.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "io/files.hpp"
#include "program.hpp"

namespace {

using difmesh::Grid;
using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::Launch;
using difmesh::test::Outcome;
using difmesh::test::OwnedField;
using difmesh::test::run_program;
using test::TempFolder;

/// Tries to reconstruct the file; no mesh may come of it.
Outcome reconstruct_bad(const TempFolder& folder, const std::string& name,
                        std::vector<std::string> options = {}) {
  const std::vector<std::string> before = folder.names();
  std::vector<std::string> arguments{"reconstruct", (folder / name).string(),
                                     "-o",          (folder / "mesh.ply").string(),
                                     "--report",    (folder / "report.json").string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  Outcome outcome = run_program(arguments);
  CHECK(folder.names() == before);
  return outcome;
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + "}";
  header.resize(118, ' ');
  return "\x93NUMPY" + std::string("\1\0\x76\0", 4) + header + data;
}

}  // namespace

TEST_CASE("a missing file is named with the reason") {
  const TempFolder folder;
  for (const std::string name : {"none.npy", "none.nrrd", "none.nhdr"}) {
    check_fails(reconstruct_bad(folder, name), 1, {name, "No such file"});
    check_fails(run_program({"info", (folder / name).string()}), 1, {name, "No such file"});
  }
  check_fails(reconstruct_bad(folder, "none.bin", {"--raw-dims", "4", "--raw-type", "uint8"}), 1,
              {"none.bin", "No such file"});
  check_fails(run_program({"info", (folder / "none.ply").string()}), 1,
              {"none.ply", "No such file"});
}

TEST_CASE("unknown extensions are named with those that can be read") {
  const TempFolder folder;
  (void)folder.file("field.xyz", "hello");
  (void)folder.file("field", "hello");
  check_fails(reconstruct_bad(folder, "field.xyz"), 1, {"field.xyz", ".npy", ".nrrd"});
  check_fails(reconstruct_bad(folder, "field"), 1, {"field", ".npy"});
  check_fails(run_program({"info", (folder / "field.xyz").string()}), 1,
              {"field.xyz", ".npy", ".ply"});
}

TEST_CASE("truncated and malformed files are named") {
  const TempFolder folder;
  (void)folder.file("empty.npy", "");
  (void)folder.file("short.npy", npy("<f8", "(4, 4, 4)", std::string(63 * 8, '\0')));
  (void)folder.file("long.npy", npy("<f8", "(4, 4, 4)", std::string(65 * 8, '\0')));
  (void)folder.file("short.nrrd",
                    "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\nabc");
  (void)folder.file("text.nrrd", "hello\n");
  (void)folder.file("short.bin", "abc");
  check_fails(reconstruct_bad(folder, "empty.npy"), 1, {"empty.npy"});
  check_fails(reconstruct_bad(folder, "short.npy"), 1, {"short.npy", "truncated", "512"});
  check_fails(reconstruct_bad(folder, "long.npy"), 1, {"long.npy", "512"});
  check_fails(reconstruct_bad(folder, "short.nrrd"), 1, {"short.nrrd"});
  check_fails(reconstruct_bad(folder, "text.nrrd"), 1, {"text.nrrd"});
  check_fails(reconstruct_bad(folder, "short.bin", {"--raw-dims", "4", "--raw-type", "uint8"}), 1,
              {"short.bin", "64 bytes"});
}

TEST_CASE("types and ranks that are no field are named") {
  const TempFolder folder;
  (void)folder.file("complex.npy", npy("<c8", "(2, 2, 2)", std::string(64, '\0')));
  (void)folder.file("flat.npy", npy("<f8", "(4, 4)", std::string(128, '\0')));
  (void)folder.file("zero.npy", npy("<f8", "(4, 0, 4)", ""));
  check_fails(reconstruct_bad(folder, "complex.npy"), 1, {"complex.npy", "<c8"});
  check_fails(reconstruct_bad(folder, "flat.npy"), 1, {"flat.npy", "rank 2"});
  check_fails(reconstruct_bad(folder, "zero.npy"), 1, {"zero.npy", "0"});
}

TEST_CASE("a header that claims 2^40 cells is not believed") {
  const TempFolder folder;
  (void)folder.file("huge.npy", npy("<f8", "(1048576, 1024, 1024)", "abc"));
  (void)folder.file("huge.nrrd",
                    "NRRD0004\ntype: double\nendian: little\ndimension: 3\n"
                    "sizes: 1024 1024 1048576\nencoding: gzip\n\nabc");
  (void)folder.file("overflow.npy",
                    npy("<f8", "(4611686018427387904, 4611686018427387904, 4)", ""));
  for (const std::string name : {"huge.npy", "huge.nrrd", "overflow.npy"}) {
    check_fails(reconstruct_bad(folder, name), 1, {name});
    check_fails(run_program({"info", (folder / name).string()}), 1, {name});
  }
}

TEST_CASE("NaN in the field names the file and the cell") {
  const TempFolder folder;
  OwnedField field = difmesh::test::drop_field({10, 9, 8});
  field.at(7, 5, 3) = std::numeric_limits<double>::quiet_NaN();
  field.at(1, 6, 3) = std::numeric_limits<double>::infinity();
  write_field(folder / "nan.npy", field.view());
  check_fails(reconstruct_bad(folder, "nan.npy"), 1, {"nan.npy", "cell (7, 5, 3)", "nan"});
}

TEST_CASE("overshoot beyond the bound names the file and the cell") {
  const TempFolder folder;
  OwnedField field = difmesh::test::drop_field({10, 9, 8});
  field.at(4, 3, 2) = 1.25;
  write_field(folder / "over.npy", field.view());
  check_fails(reconstruct_bad(folder, "over.npy"), 1,
              {"over.npy", "cell (4, 3, 2)", "1.25", "overshoot"});
  check_fails(reconstruct_bad(folder, "over.npy", {"--overshoot-bound", "0.2"}), 1,
              {"cell (4, 3, 2)"});
  const std::string mesh = (folder / "mesh.ply").string();
  const Outcome within = run_program(
      {"reconstruct", (folder / "over.npy").string(), "-o", mesh, "--overshoot-bound", "0.25"});
  CHECK(within.exit_code == 0);
}

TEST_CASE("a spacing lost in the origin is refused") {
  const TempFolder folder;
  write_field(folder / "drop.npy", difmesh::test::drop_field({8, 8, 8}).view());
  check_fails(reconstruct_bad(folder, "drop.npy", {"--origin", "0,1e9,0", "--spacing", "1e-6"}), 1,
              {"drop.npy", "spacing in y"});
}

TEST_CASE("broken meshes are named") {
  const TempFolder folder;
  const auto cut = folder.file("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
  const auto wild = folder.file("wild.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  check_fails(run_program({"info", cut.string()}), 1, {"cut.off"});
  check_fails(run_program({"info", wild.string()}), 1, {"wild.off", "7"});
}

TEST_CASE("too little memory is an error like any other") {
#ifdef DIFMESH_SANITIZED
  MESSAGE("skipped: sanitizers need more address space than the test allows");
#else
  const TempFolder folder;
  (void)folder.file("sparse.bin", "");
  constexpr std::uintmax_t kBytes = std::uintmax_t{1} << 32;  // 2^32 cells of zeros, all a hole
  std::filesystem::resize_file(folder / "sparse.bin", kBytes);
  Launch launch;
  launch.arguments = {"reconstruct", (folder / "sparse.bin").string(),
                      "-o",          (folder / "mesh.ply").string(),
                      "--raw-dims",  "1024,2048,2048",
                      "--raw-type",  "uint8"};
  launch.memory_limit = std::uint64_t{1} << 30;
  check_fails(run_program(launch), 1, {"out of memory"});
  CHECK(folder.names() == std::vector<std::string>{"sparse.bin"});
#endif
}
