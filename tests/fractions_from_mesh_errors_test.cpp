#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "support/mesh_field.hpp"
#include "support/triangle_meshes.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;

/// Runs and returns the error; fails the test if there is none.
struct Caught {
  ErrorCode code = ErrorCode::file_missing;
  std::string message;
};
Caught caught(const Grid& grid, const TriangleMesh& mesh,
              const FractionsFromMeshOptions& options = {}) {
  try {
    (void)run(grid, mesh, options);
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
  FAIL("no error was thrown");
  return {};
}
void check_error(const Caught& error, ErrorCode code, const std::vector<std::string>& parts) {
  CHECK(error.code == code);
  for (const std::string& part : parts) {
    CHECK_MESSAGE(error.message.find(part) != std::string::npos,
                  "'" << part << "' missing in: " << error.message);
  }
}

}  // namespace

TEST_CASE("a mesh turned inside out needs flip") {
  const TriangleMesh mesh =
      tetrahedron_mesh({Vec3{0.1, 0.2, 0.3}, {3.9, 0.25, 0.2}, {0.3, 2.8, 0.4}, {0.35, 1.4, 3.95}});
  const Grid grid = make_grid({4, 4, 4});
  check_error(caught(grid, mesh.reversed()), ErrorCode::invalid_argument,
              {"inside out", "flip", "--flip"});
  FractionsFromMeshOptions options;
  options.flip = true;
  const FractionsFromMesh flipped = run(grid, mesh.reversed(), options);
  const FractionsFromMesh straight = run(grid, mesh);
  CHECK(
      worst(grid, flipped.fractions, [&](const Index3& cell) {
        return straight.fractions[static_cast<std::size_t>((cell[2] * 4 + cell[1]) * 4 + cell[0])];
      }) < 1e-15);
  CHECK(flipped.report.mesh_volume == doctest::Approx(straight.report.mesh_volume));
  check_error(caught(grid, mesh, options), ErrorCode::invalid_argument,
              {"inside out", "leave out"});
}

TEST_CASE("an open mesh is named by an edge and the column with its gap") {
  const TriangleMesh box = box_mesh({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5});
  const Grid grid = make_grid({4, 4, 4});
  TriangleMesh mesh = box;
  mesh.triangles.erase(mesh.triangles.begin() + 4);  // 0 1 5
  // The row of cells along the missing triangle is cut by the box to half, with nothing to say so.
  check_error(caught(grid, mesh), ErrorCode::invalid_argument,
              {"open", "vertex 0 at (0.5, 0.5, 0.5)", "vertex 1 at (3.5, 0.5, 0.5)",
               "triangle 8 only", "3 such edges", "j = 0, k = 1", "gap of 0.5 of"});
  // The same hole on faces of cells changes no cross-section.
  TriangleMesh aligned = box_mesh({1, 1, 1}, {3, 3, 3});
  aligned.triangles.erase(aligned.triangles.begin() + 4);
  const Caught edge_on = caught(grid, aligned);
  check_error(edge_on, ErrorCode::invalid_argument, {"open", "triangle 8 only", "3 such edges)"});
  CHECK(edge_on.message.find("column") == std::string::npos);
  // Half of the face at the high x; the first column loses an eighth of its cross-section.
  mesh = box;
  mesh.triangles.erase(mesh.triangles.begin() + 3);  // 1 7 5
  check_error(caught(grid, mesh), ErrorCode::invalid_argument,
              {"open", "vertex 1 at (3.5, 0.5, 0.5)", "3 such edges", "column", "j = 0", "k = 0",
               "y = 0.5", "z = 0.5", "gap of 0.125 of its cross-section"});
  Grid upper = grid;
  upper.origin[2] = 2.0;
  check_error(caught(upper, mesh), ErrorCode::invalid_argument,
              {"open", "column", "j = 0", "k = 0", "z = 2.5", "gap of 0.5 of"});
  Grid beside = grid;
  beside.origin[1] = 20.0;
  CHECK(caught(beside, mesh).message.find("column") == std::string::npos);
}

TEST_CASE("without the check of edges the columns tell") {
  FractionsFromMeshOptions options;
  options.check_edges = false;
  const Grid grid = make_grid({5, 4, 4});
  for (const std::ptrdiff_t side : {0, 1}) {
    // Without one of the two triangles across x. Column (0,0) loses up to a quarter of its face.
    TriangleMesh mesh = box_mesh({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5});
    mesh.triangles.erase(mesh.triangles.begin() + 2 * side);
    check_error(caught(grid, mesh, options), ErrorCode::invalid_argument,
                {"open", "column", "j = 0", "k = 0", "y = 0.5", "z = 0.5", "0.125"});
  }
  // A T-junction: one side of a box has a vertex where the next one has none.
  TriangleMesh mesh = box_mesh({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5});
  mesh.positions.push_back({0.5, 0.5, 2.0});
  mesh.triangles[0] = {0, 8, 6};
  mesh.triangles.push_back({8, 4, 6});
  CHECK(run(grid, mesh, options).report.fraction_volume == doctest::Approx(27.0).epsilon(1e-14));
  check_error(caught(grid, mesh), ErrorCode::invalid_argument,
              {"open", "vertex 4", "3 such edges"});
}

TEST_CASE("a crack within the tolerance is closed") {
  TriangleMesh mesh = box_mesh({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5});
  mesh.positions.push_back({0.5, 0.5, 3.5 - 1e-7});
  mesh.triangles[0] = {0, 8, 6};
  const Grid grid = make_grid({5, 4, 4});
  FractionsFromMeshOptions options;
  options.check_edges = false;
  check_error(caught(grid, mesh, options), ErrorCode::invalid_argument, {"open", "gap"});
  options.tolerance = 1e-6;
  const FractionsFromMesh result = run(grid, mesh, options);
  CHECK(result.report.fraction_volume == doctest::Approx(27.0).epsilon(1e-6));
  CHECK(result.report.largest_gap > 1e-9);
  CHECK(result.report.largest_gap < 1e-6);
  CHECK(result.fractions[(2 * 4 + 1) * 5 + 1] == 1.0);
}

TEST_CASE("mixed orientation names two triangles") {
  TriangleMesh mesh = box_mesh({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5});
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  check_error(caught(make_grid({4, 4, 4}), mesh), ErrorCode::invalid_argument,
              {"orientation", "triangles", "7", "same way", "vertex 2 at (0.5, 3.5, 0.5)"});
  // An edge with three triangles.
  TriangleMesh fin = box_mesh({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5});
  fin.positions.push_back({3.9, 0.5, 0.5});
  fin.triangles.push_back({0, 1, 8});
  check_error(caught(make_grid({4, 4, 4}), fin), ErrorCode::invalid_argument,
              {"vertex 0", "vertex 1", "2", "one way", "3 such edges"});
}

TEST_CASE("overlapping parts that are refused and parts inside out name a cell") {
  const Grid grid = make_grid({8, 8, 8}, {0, 0, 0}, {0.5, 0.5, 0.5});
  FractionsFromMeshOptions refuse;
  refuse.overlaps = Overlaps::refuse;
  TriangleMesh twice = box_mesh({0.5, 0.5, 0.5}, {2.5, 2.5, 2.5});
  twice.append(box_mesh({1.5, 1.5, 1.5}, {3.5, 3.5, 3.5}));
  check_error(caught(grid, twice, refuse), ErrorCode::invalid_argument,
              {"overlap", "cell (3, 3, 3)", "(1.75, 1.75, 1.75)", "has 1 of its volume"});
  TriangleMesh part = box_mesh({0.5, 0.5, 0.5}, {3.5, 3.5, 1.0});
  part.append(box_mesh({1.1, 1.1, 1.6}, {2.5, 2.5, 3.4}).reversed());
  check_error(caught(grid, part, refuse), ErrorCode::invalid_argument,
              {"inside out", "cell (2, 2, 3)", "has 0.512 of its volume inside out"});
  check_error(caught(grid, part), ErrorCode::invalid_argument,
              {"inside out", "cell (3, 3, 4)", "3.528"});
  FractionsFromMeshOptions count;
  count.overlaps = Overlaps::count;
  CHECK(run(grid, part, count).fractions[(3 * 8 + 2) * 8 + 2] ==
        doctest::Approx(-0.512).epsilon(1e-12));
}

TEST_CASE("a slight overlap passes with a tolerance and is reported") {
  const Grid grid = make_grid({4, 4, 4});
  TriangleMesh mesh = box_mesh({0.5, 0.0, 0.0}, {2.01, 3.0, 3.0});
  mesh.append(box_mesh({2.0, 0.0, 0.0}, {3.5, 3.0, 3.0}));
  FractionsFromMeshOptions options;
  options.overlaps = Overlaps::refuse;
  check_error(caught(grid, mesh, options), ErrorCode::invalid_argument,
              {"overlap", "cell (2, 0, 0)"});
  options.tolerance = 0.02;
  const FractionsFromMesh result = run(grid, mesh, options);
  CHECK(result.report.highest_raw == doctest::Approx(1.01).epsilon(1e-12));
  CHECK(result.report.overlap.volume == doctest::Approx(0.09).epsilon(1e-12));
  CHECK(*std::max_element(result.fractions.begin(), result.fractions.end()) == 1.0);
}

TEST_CASE("bad vertices and indices and grids and options are named") {
  const Grid grid = make_grid({4, 4, 4});
  const TriangleMesh box = box_mesh({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5});
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = box;
    mesh.positions[5][1] = bad;
    check_error(caught(grid, mesh), ErrorCode::invalid_argument, {"vertex 5", "not finite"});
  }
  TriangleMesh far = box;
  far.positions[6][2] = -1e300;
  check_error(caught(grid, far), ErrorCode::invalid_argument, {"vertex 6", "2^32"});
  TriangleMesh indices = box;
  indices.triangles[3][1] = 8;
  check_error(caught(grid, indices), ErrorCode::invalid_argument, {"triangle 3", "8", "range"});
  check_error(caught(grid, {}), ErrorCode::invalid_argument, {"empty"});
  check_error(caught(make_grid({4, 0, 4}), box), ErrorCode::invalid_grid, {"y"});
  check_error(caught(make_grid({4, 4, 4}, {0, 0, 0}, {1, 1, -1}), box), ErrorCode::invalid_grid,
              {"spacing"});
  check_error(caught(make_grid({1 << 20, 1 << 20, 1 << 20}), box), ErrorCode::too_large, {"cells"});
  FractionsFromMeshOptions options;
  options.threads = -1;
  check_error(caught(grid, box, options), ErrorCode::invalid_argument, {"threads"});
  for (const double tolerance : {0.0, 0.251, std::numeric_limits<double>::quiet_NaN()}) {
    options = {};
    options.tolerance = tolerance;
    check_error(caught(grid, box, options), ErrorCode::invalid_argument, {"tolerance"});
  }
}

TEST_CASE("progress rises to 1 and can cancel") {
  const TriangleMesh box = box_mesh({0.5, 0.5, 0.5}, {30.5, 30.5, 30.5});
  const Grid grid = make_grid({32, 32, 32});
  std::vector<double> shares;
  FractionsFromMeshOptions options;
  options.progress = [&](double share) {
    shares.push_back(share);
    return true;
  };
  (void)run(grid, box, options);
  CHECK(shares.size() >= 20);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.back() == 1.0);
  options.progress = [](double share) { return share < 0.5; };
  check_error(caught(grid, box, options), ErrorCode::cancelled, {"cancelled"});
}
