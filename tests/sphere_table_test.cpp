// Distances of the vertices to a sphere, by placement and resolution, against the figures of an
// independent implementation of the method in docs/method.md.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "difmesh/reconstruct.hpp"
#include "support/fractions.hpp"
#include "support/shapes.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Options;
using difmesh::Placement;
using namespace difmesh::test;

struct Errors {
  double rms = 0.0;
  double max = 0.0;
};

/// The figures of one resolution, in Δx.
struct TableRow {
  double radius;  ///< R/Δx
  Errors linear;
  Errors manson;
  Errors plic;
};

#ifdef DIFMESH_SANITIZED
constexpr std::size_t kRows = 2;
#else
constexpr std::size_t kRows = 4;
#endif
constexpr std::array<TableRow, 4> kTable{{
    {8.0, {4.05e-2, 9.1e-2}, {1.69e-2, 3.0e-2}, {1.265e-2, 1.6e-2}},
    {16.0, {3.86e-2, 8.8e-2}, {8.56e-3, 1.9e-2}, {6.31e-3, 8.6e-3}},
    {32.0, {3.92e-2, 8.7e-2}, {4.46e-3, 1.4e-2}, {3.16e-3, 4.7e-3}},
    {64.0, {3.93e-2, 8.6e-2}, {2.58e-3, 1.1e-2}, {1.58e-3, 2.4e-3}},
}};

/// A sphere whose centre lies anywhere in the middle cell of a grid of unit cells.
struct SphereCase {
  Sphere sphere;
  Grid grid;
  std::vector<double> fractions;

  SphereCase(double radius, Random& random) {
    const auto half = static_cast<std::int64_t>(radius) + 5;
    grid.dims = {2 * half, 2 * half, 2 * half};
    sphere.radius = radius;
    for (double& coordinate : sphere.centre) {
      coordinate = static_cast<double>(half) + random.uniform();
    }
    fractions = cell_fractions(sphere, grid);
  }
};

Errors errors_of(const SphereCase& test, Placement placement) {
  Options options;
  options.placement = placement;
  const auto result =
      reconstruct(FieldView::x_fastest(test.fractions.data(), test.grid.dims), test.grid, options);
  REQUIRE(result.mesh.positions.size() > 1000);
  Errors errors;
  for (const difmesh::Vec3& position : result.mesh.positions) {
    const double away = distance(test.sphere, position);
    errors.rms += away * away;
    errors.max = std::max(errors.max, away);
  }
  errors.rms = std::sqrt(errors.rms / static_cast<double>(result.mesh.positions.size()));
  return errors;
}

void check_against(const Errors& found, const Errors& expected) {
  CHECK(found.rms == doctest::Approx(expected.rms).epsilon(0.05));
  CHECK(found.max == doctest::Approx(expected.max).epsilon(0.3));
}

}  // namespace

TEST_CASE("sphere table: errors by placement and resolution") {
  Random random(2019);
  std::array<Errors, kRows> plic{};
  for (std::size_t n = 0; n < kRows; ++n) {
    const TableRow& row = kTable[n];
    CAPTURE(row.radius);
    const SphereCase test(row.radius, random);
    check_against(errors_of(test, Placement::linear), row.linear);
    check_against(errors_of(test, Placement::manson), row.manson);
    plic[n] = errors_of(test, Placement::plic);
    check_against(plic[n], row.plic);
  }
  // Errors in Δx halve with Δx: second order in the unit of the sphere. Linear placement stays of
  // first order, as the table itself shows.
  const double doublings = static_cast<double>(kRows - 1);
  const double rms_order = 1.0 + std::log2(plic.front().rms / plic.back().rms) / doublings;
  const double max_order = 1.0 + std::log2(plic.front().max / plic.back().max) / doublings;
  CHECK(rms_order > 1.95);
  CHECK(rms_order < 2.1);
  CHECK(max_order > 1.75);
}
