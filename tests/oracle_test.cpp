// The library's vertices against Algorithm 1 of E19, iterated as printed over clipped boxes.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "difmesh/reconstruct.hpp"
#include "support/algorithm1.hpp"
#include "support/crossed_edges.hpp"
#include "support/dual_edges.hpp"
#include "support/fractions.hpp"
#include "support/shapes.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::Options;
using difmesh::Reconstruction;
using difmesh::Vec3;
using namespace difmesh::test;

/// A field, its reconstruction, and the dual edge of every vertex as the oracle sees it.
struct OracleCase {
  Grid grid;
  std::vector<double> fractions;
  Reconstruction result;
  std::vector<DualEdge> dual_edges;
  std::vector<CrossedEdge> edges;

  template <class Shape>
  OracleCase(const Shape& shape, const Grid& grid_of_case)
      : OracleCase(cell_fractions(shape, grid_of_case), grid_of_case) {}

  OracleCase(std::vector<double> fractions_of_case, const Grid& grid_of_case)
      : grid(grid_of_case), fractions(std::move(fractions_of_case)) {
    Options options;
    options.edge_ids = true;
    result = reconstruct(FieldView::x_fastest(fractions.data(), grid.dims), grid, options);
    for (const std::uint64_t id : result.mesh.edge_ids) {
      dual_edges.push_back(dual_edge(id, grid.dims));
    }
    edges = crossed_edges(fractions, grid, options, result.mesh.edge_ids);
    for (const CrossedEdge& edge : edges) {
      REQUIRE(edge.outer_fraction < 0.5);
      REQUIRE(edge.inner_fraction >= 0.5);
    }
  }

  /// Where the library put a vertex, from the outer cell's centre (0) to the inner one's (1).
  [[nodiscard]] double library_mu(std::size_t vertex) const {
    return share_along(edges[vertex], result.mesh.edge_ids[vertex], grid,
                       result.mesh.positions[vertex]);
  }
};

Grid grid_about(const Vec3& half_size, const Vec3& spacing) {
  Grid grid;
  grid.spacing = spacing;
  for (std::size_t a = 0; a < 3; ++a) {
    const double half = std::ceil(half_size[a] / spacing[a]) + 2.0;
    grid.dims[a] = 2 * static_cast<std::int64_t>(half);
    grid.origin[a] = -half * spacing[a];
  }
  return grid;
}

/// What sampling tells of the window's fraction along an edge.
struct Sampled {
  int roots = 0;
  bool falls = false;  ///< somewhere on the way from the outer cell to the inner one

  explicit Sampled(const CrossedEdge& edge) {
    constexpr int kSamples = 48;
    constexpr double kRounding = 1e-13;
    double before = window_fraction(edge, 0.0);
    for (int n = 1; n <= kSamples; ++n) {
      const double after = window_fraction(edge, static_cast<double>(n) / kSamples);
      roots += (before < 0.5) != (after < 0.5) ? 1 : 0;
      falls = falls || after < before - kRounding;
      before = after;
    }
  }
};

/// A value to be bounded over all vertices, and the vertex where it is largest.
struct Worst {
  double value = 0.0;
  std::size_t vertex = 0;

  void see(double found, std::size_t at) {
    if (!(found <= value)) {  // NaN as well
      value = found;
      vertex = at;
    }
  }
  void check(const OracleCase& test, double bound) const {
    const DualEdge& dual = test.dual_edges[vertex];
    const CrossedEdge& edge = test.edges[vertex];
    CAPTURE(vertex);
    CAPTURE(dual.node[0]);
    CAPTURE(dual.node[1]);
    CAPTURE(dual.node[2]);
    CAPTURE(dual.axis);
    CAPTURE(edge.outer_fraction);
    CAPTURE(edge.inner_fraction);
    CAPTURE(test.library_mu(vertex));
    CHECK(value <= bound);
  }
};

/// True where the window fills up on the way from the outer cell to the inner one, as it must where
/// a vertex separates the two.
bool rises(const CrossedEdge& edge, double mu) {
  constexpr double kStep = 1e-7;
  return window_fraction(edge, mu + kStep) >= window_fraction(edge, mu - kStep);
}

/// Every vertex must stand where the window is half full; where Algorithm 1 arrives at such a place
/// from Manson's guess, at that one. Algorithm 1 may also run off the edge, about for ever, or to
/// where the window empties, all where the surface is nearly parallel to the edge or the planes
/// face backwards. Then the vertex must stand at the only root or at one where the window fills up.
/// \return share of the edges where Algorithm 1 does not arrive
double check_all_vertices(const OracleCase& test) {
  constexpr int kMostSteps = 80;
  Worst away_from_algorithm1;
  Worst away_from_half;
  std::int64_t without_arrival = 0;
  std::int64_t falling = 0;
  for (std::size_t v = 0; v < test.edges.size(); ++v) {
    const CrossedEdge& edge = test.edges[v];
    const double mu = test.library_mu(v);
    away_from_half.see(std::abs(window_fraction(edge, mu) - 0.5), v);
    const Sampled sampled(edge);
    falling += sampled.falls ? 1 : 0;
    const double start = initial_guess(Guess::manson, edge.outer_fraction, edge.inner_fraction);
    const Algorithm1Result expected = algorithm1(edge, start, 1e-12, kMostSteps);
    if (expected.converged && rises(edge, expected.mu)) {
      away_from_algorithm1.see(std::abs(mu - expected.mu), v);
    } else {
      ++without_arrival;
      CHECK((sampled.roots == 1 || rises(edge, mu)));
    }
  }
  away_from_algorithm1.check(test, 1e-10);  // edge lengths
  away_from_half.check(test, 1e-12);
  const auto all = static_cast<std::int64_t>(test.edges.size());
  CHECK(all > 500);
  CHECK(all == test.result.report.solved_edges);
  // Sampling may miss a short fall, never see one that is not there.
  CHECK(falling <= test.result.report.non_monotone_edges);
  CHECK(test.result.report.non_monotone_edges <= falling + all / 100);
  return static_cast<double>(without_arrival) / static_cast<double>(all);
}

double mean_steps(const OracleCase& test, Guess guess) {
  double steps = 0.0;
  for (const CrossedEdge& edge : test.edges) {
    const double start = initial_guess(guess, edge.outer_fraction, edge.inner_fraction);
    steps += algorithm1(edge, start).steps;
  }
  return steps / static_cast<double>(test.edges.size());
}

const Vec3 kCube{1.0, 1.0, 1.0};
const Vec3 kFlat{1.0, 2.0, 5.0};

}  // namespace

TEST_CASE("oracle: vertices of a sphere") {
  const Sphere sphere{{0.123, 0.37, -0.29}, 16.0};
  CHECK(check_all_vertices(OracleCase(sphere, grid_about({16.5, 16.5, 16.5}, kCube))) < 0.01);
}

TEST_CASE("oracle: vertices of a sphere in flat cells") {
  const Sphere sphere{{0.123, 0.37, -0.29}, 22.0};
  CHECK(check_all_vertices(OracleCase(sphere, grid_about({22.5, 22.5, 22.5}, kFlat))) < 0.01);
}

TEST_CASE("oracle: vertices of an ellipsoid") {
  const Ellipsoid ellipsoid{{0.2, -0.1, 0.4}, {9.0, 14.0, 18.0}};
  CHECK(check_all_vertices(OracleCase(ellipsoid, grid_about({9.5, 14.5, 18.5}, kCube))) < 0.01);
}

TEST_CASE("oracle: vertices of an ellipsoid in flat cells") {
  const Ellipsoid ellipsoid{{0.2, -0.1, 0.4}, {9.0, 14.0, 38.0}};
  CHECK(check_all_vertices(OracleCase(ellipsoid, grid_about({9.5, 14.5, 38.5}, kFlat))) < 0.01);
}

TEST_CASE("oracle: vertices of the genus") {
  const Genus genus{{0.31, 0.17, -0.23}, 14.0};
  CHECK(check_all_vertices(OracleCase(genus, grid_about({26.5, 26.5, 14.5}, kCube))) < 0.01);
}

TEST_CASE("oracle: vertices of the genus in flat cells") {
  const Genus genus{{0.31, 0.17, -0.23}, 22.0};
  CHECK(check_all_vertices(OracleCase(genus, grid_about({41.5, 41.5, 22.5}, kFlat))) < 0.01);
}

TEST_CASE("oracle: vertices of noise") {
  // Normals that know nothing of each other, and windows that are half full nearly everywhere: here
  // edges with several roots occur.
  Random random(16);
  Grid grid;
  grid.dims = {18, 16, 14};
  std::vector<double> fractions(static_cast<std::size_t>(grid.cell_count()), 0.0);
  for (std::int64_t k = 2; k < grid.dims[2] - 2; ++k) {
    for (std::int64_t j = 2; j < grid.dims[1] - 2; ++j) {
      for (std::int64_t i = 2; i < grid.dims[0] - 2; ++i) {
        fractions[element({i, j, k}, grid.dims)] = random.uniform(0.48, 0.52);
      }
    }
  }
  check_all_vertices(OracleCase(fractions, grid));
}

TEST_CASE("oracle: steps that Algorithm 1 takes from its starts") {
  const Sphere sphere{{0.123, 0.37, -0.29}, 16.0};
  const OracleCase test(sphere, grid_about({16.5, 16.5, 16.5}, kCube));
  CHECK(mean_steps(test, Guess::mid_edge) == doctest::Approx(4.75).epsilon(0.05));
  CHECK(mean_steps(test, Guess::linear) == doctest::Approx(4.25).epsilon(0.05));
  CHECK(mean_steps(test, Guess::manson) == doctest::Approx(3.57).epsilon(0.05));
}
