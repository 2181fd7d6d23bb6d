// What readers of meshes warn of, in every command that reads one.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "difmesh/io/mesh_file.hpp"
#include "io/files.hpp"
#include "program.hpp"

namespace {

using difmesh::test::box_mesh;
using difmesh::test::Outcome;
using difmesh::test::run_program;
using difmesh::test::TriangleMesh;
using test::TempFolder;
using Words = std::vector<std::string>;

/// A cube as .glb, with some bytes behind its end.
std::string cube_with_tail(const TempFolder& folder, const std::string& name) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  difmesh::Mesh mesh;
  mesh.positions.assign(box.positions.begin(), box.positions.end());
  mesh.triangles.assign(box.triangles.begin(), box.triangles.end());
  difmesh::write_mesh(folder / name, mesh);
  return folder.file(name, test::read_bytes(folder / name) + "tail").string();
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

/// Runs the program and checks that it warned of each file once, and said nothing else on standard
/// error. \return standard output
std::string warned(const Words& arguments, const Words& files) {
  const Outcome outcome = run_program(arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  for (const std::string& file : files) {
    CHECK(count_of(outcome.err, "difmesh: warning: '" + file + "': what follows") == 1);
  }
  CHECK(count_of(outcome.err, "\n") == files.size());
  return outcome.out;
}

void check_json(const std::string& text, const Words& files) {
  const nlohmann::json warnings = nlohmann::json::parse(text)["warnings"];
  REQUIRE(warnings.size() == files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    CHECK(warnings[i].get<std::string>().starts_with("'" + files[i] + "': "));
  }
}

}  // namespace

TEST_CASE("info and sample warn of what a mesh's reader left out") {
  const TempFolder folder;
  const std::string cube = cube_with_tail(folder, "cube.glb");
  CHECK(difmesh::test::fact(warned({"info", cube}, {cube}), "enclosed volume") == "1");
  check_json(warned({"info", cube, "--json", "-"}, {cube}), {cube});
  const std::string field = (folder / "f.nrrd").string();
  (void)warned({"sample", cube, "-o", field, "--spacing", "0.15"}, {cube});
  const Outcome quiet = run_program({"sample", cube, "-o", field, "--spacing", "0.15", "--quiet"});
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.err.empty());
}

#ifdef DIFMESH_WITH_METRICS
TEST_CASE("compare and reconstruct warn of a reference too and once of each file") {
  const TempFolder folder;
  const std::string cube = cube_with_tail(folder, "cube.glb");
  const std::string other = cube_with_tail(folder, "other.glb");
  (void)warned({"compare", cube, "--reference", other}, {cube, other});
  (void)warned({"compare", cube, "--shape", "sphere"}, {cube});
  check_json(warned({"compare", cube, "--reference", other, "--json", "-"}, {cube, other}),
             {cube, other});
  CHECK(count_of(run_program({"compare", cube, "--reference", cube}).err, "warning") == 1);
  const std::string field = (folder / "f.nrrd").string();
  REQUIRE(run_program({"sample", cube, "-o", field, "--spacing", "0.15", "--quiet"}).exit_code ==
          0);
  check_json(warned({"reconstruct", field, "-o", (folder / "m.glb").string(), "--reference", other,
                     "--color-by", "error", "--report", "-"},
                    {other}),
             {other});
}
#endif
