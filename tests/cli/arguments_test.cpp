// What the program makes of its command line alone.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/version.hpp"
#include "io/files.hpp"
#include "program.hpp"

namespace {

using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::Outcome;
using difmesh::test::OwnedField;
using difmesh::test::run_program;
using test::TempFolder;

bool holds(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

std::string small_field(const TempFolder& folder) {
  const OwnedField field = difmesh::test::drop_field({8, 8, 8});
  write_field(folder / "drop.npy", field.view());
  return (folder / "drop.npy").string();
}

}  // namespace

TEST_CASE("help explains the program and exits with 0") {
  const Outcome help = run_program({"--help"});
  check_succeeds(help);
  for (const char* word : {"reconstruct", "info", "--version", "Examples:", "Exit codes:"}) {
    CAPTURE(word);
    CHECK(holds(help.out, word));
  }
}

TEST_CASE("help of reconstruct names every option and choice") {
  const Outcome help = run_program({"reconstruct", "--help"});
  check_succeeds(help);
  CHECK(holds(help.out, "Usage: difmesh reconstruct FIELD -o MESH [OPTIONS]"));
  for (const char* word : {"--output",
                           "--placement",
                           "midpoint",
                           "linear",
                           "manson",
                           "plic",
                           "--normals",
                           "youngs",
                           "myc",
                           "height_function",
                           "--origin",
                           "--spacing",
                           "--boundary",
                           "open",
                           "mirror",
                           "periodic",
                           "empty",
                           "full",
                           "--purity-tolerance",
                           "--overshoot-bound",
                           "--clearance",
                           "--threads",
                           "--vertex-normals",
                           "--report",
                           "--quiet",
                           "--raw-dims",
                           "--raw-type",
                           "--raw-big-endian",
                           "--raw-offset",
                           "--color-by",
                           "angle",
                           "error",
                           "--shape",
                           "--reference",
                           "Examples:"}) {
    CAPTURE(word);
    CHECK(holds(help.out, word));
  }
}

TEST_CASE("help of info names every option") {
  const Outcome help = run_program({"info", "-h"});
  check_succeeds(help);
  CHECK(holds(help.out, "Usage: difmesh info FIELD|MESH [OPTIONS]"));
  for (const char* word :
       {"--json", "--purity-tolerance", "--origin", "--spacing", "--raw-dims", "Examples:"}) {
    CAPTURE(word);
    CHECK(holds(help.out, word));
  }
}

TEST_CASE("the version is that of the headers") {
  const Outcome version = run_program({"--version"});
  check_succeeds(version);
  CHECK(version.out == "difmesh " DIFMESH_VERSION "\n");
}

TEST_CASE("wrong commands exit with 2") {
  check_fails(run_program(std::vector<std::string>{}), 2, {"no command", "--help"});
  check_fails(run_program({"frobnicate"}), 2, {"frobnicate", "--help"});
  check_fails(run_program({"--frobnicate"}), 2, {"--frobnicate"});
  check_fails(run_program({"reconstruct"}), 2, {"FIELD"});
  check_fails(run_program({"info"}), 2, {"FIELD"});
}

TEST_CASE("wrong values of options exit with 2 and are named") {
  const TempFolder folder;
  const std::string field = small_field(folder);
  const std::string mesh = (folder / "mesh.ply").string();
  struct Wrong {
    std::vector<std::string> arguments;
    std::vector<std::string> words;
  };
  const std::vector<Wrong> cases{
      {{"--placement", "cubic"}, {"--placement", "'cubic'", "midpoint, linear, manson, plic"}},
      {{"--placement", ""}, {"--placement", "''"}},
      {{"--normals", "swartz"},
       {"--normals", "'swartz'", "youngs, myc, height_function, elvira, lvira"}},
      {{"--spacing", "1,2"}, {"--spacing", "'1,2'", "2 values"}},
      {{"--spacing", "1,2,3,4"}, {"--spacing", "4 values"}},
      {{"--spacing", "one"}, {"--spacing", "'one'"}},
      {{"--spacing", "1,2,"}, {"--spacing", "''"}},
      {{"--spacing", "1,2,3m"}, {"--spacing", "'3m'"}},
      {{"--spacing", "0"}, {"--spacing", "'0'", "greater than 0"}},
      {{"--spacing", "1,-1,1"}, {"--spacing", "'1,-1,1'", "greater than 0"}},
      {{"--spacing", "nan"}, {"--spacing", "'nan'"}},
      {{"--spacing", "1,inf,1"}, {"--spacing", "'inf'"}},
      {{"--spacing", "1e999"}, {"--spacing", "'1e999'"}},
      {{"--origin", "0,0"}, {"--origin", "'0,0'", "2 values"}},
      {{"--origin", "nan"}, {"--origin", "'nan'"}},
      {{"--origin", "x,0,0"}, {"--origin", "'x'"}},
      {{"--boundary", "closed"}, {"--boundary", "'closed'", "open, mirror, periodic"}},
      {{"--boundary", "open,open"}, {"--boundary", "2 sides", "xlo,xhi,ylo,yhi,zlo,zhi"}},
      {{"--boundary", "open,open,open,open,open,shut"}, {"--boundary", "'shut'"}},
      {{"--boundary", "open,periodic,open,open,open,open"}, {"--boundary", "both", "periodic"}},
      {{"--purity-tolerance", "0.2"}, {"--purity-tolerance", "'0.2'", "[0, 0.1]"}},
      {{"--purity-tolerance", "-1e-9"}, {"--purity-tolerance", "'-1e-9'"}},
      {{"--purity-tolerance", "tiny"}, {"--purity-tolerance", "'tiny'"}},
      {{"--overshoot-bound", "1.5"}, {"--overshoot-bound", "'1.5'", "[0, 1]"}},
      {{"--overshoot-bound", "nan"}, {"--overshoot-bound", "'nan'"}},
      {{"--clearance", "0"}, {"--clearance", "'0'", "[1e-13, 0.25]"}},
      {{"--threads", "-1"}, {"--threads", "'-1'"}},
      {{"--threads", "2.5"}, {"--threads", "'2.5'"}},
      {{"--threads", "99999999999999999999"}, {"--threads"}},
      {{"--raw-dims", "8,8,8"}, {"--raw-dims", "--raw-type"}},
      {{"--raw-type", "float64"}, {"--raw-type", "--raw-dims"}},
      {{"--raw-offset", "8"}, {"--raw-offset", "--raw-dims"}},
      {{"--raw-big-endian"}, {"--raw-big-endian", "--raw-dims"}},
      {{"--raw-dims", "8,8", "--raw-type", "uint8"}, {"--raw-dims", "'8,8'"}},
      {{"--raw-dims", "8,0,8", "--raw-type", "uint8"}, {"--raw-dims", "'0'"}},
      {{"--raw-dims", "8,8,2.0", "--raw-type", "uint8"}, {"--raw-dims", "'2.0'"}},
      {{"--raw-dims", "8,8,8", "--raw-type", "int12"}, {"--raw-type", "'int12'", "uint16"}},
      {{"--raw-dims", "8,8,8", "--raw-type", "uint8", "--raw-offset", "-1"},
       {"--raw-offset", "'-1'"}},
      {{"--quiet", "--frobnicate"}, {"--frobnicate"}},
      {{"other.npy"}, {"other.npy"}},
      {{"--spacing"}, {"--spacing"}},
      {{"--spacing", "1", "--spacing", "2"}, {"--spacing"}},
  };
  for (const Wrong& wrong : cases) {
    std::vector<std::string> arguments{"reconstruct", field, "-o", mesh};
    arguments.insert(arguments.end(), wrong.arguments.begin(), wrong.arguments.end());
    CAPTURE(wrong.arguments[0]);
    CAPTURE(wrong.arguments.back());
    const Outcome outcome = run_program(arguments);
    check_fails(outcome, 2, {"--help"});
    for (const std::string& word : wrong.words) {
      CAPTURE(word);
      CAPTURE(outcome.err);
      CHECK(holds(outcome.err, word));
    }
    CHECK(folder.names() == std::vector<std::string>{"drop.npy"});
  }
}

TEST_CASE("outputs that cannot be meant exit with 2") {
  const TempFolder folder;
  const std::string field = small_field(folder);
  const std::string mesh = (folder / "mesh.ply").string();
  check_fails(run_program({"reconstruct", field}), 2, {"--output"});
  check_fails(run_program({"reconstruct", field, "-o", mesh + ".xyz"}), 2,
              {"mesh.ply.xyz", "unknown extension", ".ply, .obj, .off, .stl"});
  check_fails(run_program({"reconstruct", field, "-o", (folder / "mesh").string()}), 2,
              {"unknown extension"});
  check_fails(run_program({"reconstruct", field, "-o", mesh, "--report", mesh}), 2,
              {"--report", "mesh.ply"});
  check_fails(run_program({"reconstruct", field, "-o", mesh, "--report",
                           (folder / "." / "mesh.ply").string()}),
              2, {"--report", "mesh.ply"});
  check_fails(run_program({"reconstruct", field, "-o", mesh, "--report", field}), 2,
              {"--report", "drop.npy"});
  check_fails(run_program({"info", field, "--json", field}), 2, {"--json", "drop.npy"});
  CHECK(folder.names() == std::vector<std::string>{"drop.npy"});
}

TEST_CASE("grid options do not go with a mesh") {
  const TempFolder folder;
  const auto mesh = folder.file("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  check_fails(run_program({"info", mesh.string(), "--spacing", "2"}), 2, {"--spacing", "a.off"});
  check_fails(run_program({"info", mesh.string(), "--origin", "2"}), 2, {"--origin", "a.off"});
}
