// The whole chain on shapes with known surfaces: fractions by quadrature, reconstruction, distance. Errors
// must fall with the square of the cell size.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "difmesh/distance.hpp"
#include "difmesh/fractions_from_function.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"

using namespace difmesh;

namespace {

struct Errors {
  double rms = 0.0;
  double max = 0.0;
};

// Distances of the vertices, over the cell size. The box is the shape's with a margin of three cells, moved
// by the given share of a cell: the maximum depends on how the surface lies in the grid.
Errors errors(const Shape& shape, double spacing, Placement placement, double moved) {
  const Bounds bounds = shape.bounds();
  Grid grid;
  grid.spacing = {spacing, spacing, spacing};
  for (std::size_t a = 0; a < 3; ++a) {
    const double size = bounds.high[a] - bounds.low[a];
    grid.dims[a] = static_cast<std::int64_t>(std::ceil(size / spacing)) + 6;
    const double middle = 0.5 * (bounds.low[a] + bounds.high[a]);
    grid.origin[a] = middle - 0.5 * spacing * static_cast<double>(grid.dims[a]) +
                     moved * spacing * (1.0 - 0.3 * static_cast<double>(a));
  }
  const FractionsFromFunction field = fractions_from_function(grid, shape.function());
  Options options;
  options.placement = placement;
  const Mesh mesh =
      reconstruct(FieldView::x_fastest(field.fractions.data(), grid.dims), grid, options).mesh;
  const DistanceStatistics vertices = distance(mesh, shape).vertices;
  return {vertices.rms / spacing, vertices.maximum / spacing};
}

// Orders of convergence of rms and maximum over all resolutions; each doubles the one before.
Errors orders(const std::vector<Errors>& found) {
  const auto doublings = static_cast<double>(found.size() - 1);
  return {1.0 + std::log2(found.front().rms / found.back().rms) / doublings,
          1.0 + std::log2(found.front().max / found.back().max) / doublings};
}

constexpr std::array<double, 4> kMoves{0.07, 0.31, 0.58, 0.83};

std::vector<Errors> refine(const Shape& shape, double cells_per_unit, int levels) {
  std::vector<Errors> found;
  for (int level = 0; level < levels; ++level) {
    Errors mean;
    for (const double moved : kMoves) {
      const Errors one = errors(shape, 1.0 / cells_per_unit, Placement::plic, moved);
      mean.rms += one.rms / static_cast<double>(kMoves.size());
      mean.max += one.max / static_cast<double>(kMoves.size());
    }
    found.push_back(mean);
    MESSAGE(shape_name(shape.options().kind) << " at " << cells_per_unit << " cells per unit: rms "
                                             << found.back().rms << ", max " << found.back().max);
    cells_per_unit *= 2.0;
  }
  return found;
}

}  // namespace

TEST_CASE("convergence: the table of errors from quadrature fields") {
  struct Row {
    double cells;
    std::array<Errors, 3> expected;  // linear, manson, plic
  };
  constexpr std::array<Row, 4> kTable{{
      {8.0, {{{4.05e-2, 9.1e-2}, {1.69e-2, 3.0e-2}, {1.265e-2, 1.6e-2}}}},
      {16.0, {{{3.86e-2, 8.8e-2}, {8.56e-3, 1.9e-2}, {6.31e-3, 8.6e-3}}}},
      {32.0, {{{3.92e-2, 8.7e-2}, {4.46e-3, 1.4e-2}, {3.16e-3, 4.7e-3}}}},
      {64.0, {{{3.93e-2, 8.6e-2}, {2.58e-3, 1.1e-2}, {1.58e-3, 2.4e-3}}}},
  }};
  constexpr std::array<Placement, 3> kPlacements{Placement::linear, Placement::manson,
                                                 Placement::plic};
  const Shape sphere = make_shape({});
  for (const Row& row : kTable) {
#ifdef DIFMESH_SANITIZED
    if (row.cells > 16.0) {
      continue;
    }
#endif
    for (std::size_t n = 0; n < kPlacements.size(); ++n) {
      CAPTURE(row.cells);
      CAPTURE(n);
      const Errors found = errors(sphere, 1.0 / row.cells, kPlacements[n], 0.37);
      CHECK(found.rms == doctest::Approx(row.expected[n].rms).epsilon(0.05));
      CHECK(found.max == doctest::Approx(row.expected[n].max).epsilon(0.3));
    }
  }
}

TEST_CASE("convergence: plic on a sphere is of second order in rms and maximum") {
#ifdef DIFMESH_SANITIZED
  constexpr int kLevels = 2;
#else
  constexpr int kLevels = 4;
#endif
  const Errors order = orders(refine(make_shape({}), 16.0, kLevels));
  CHECK(order.rms >= 1.9);
  // The maximum needs all levels to show its order.
  CHECK(order.max >= (kLevels > 2 ? 1.9 : 1.8));
}

TEST_CASE("convergence: plic on ellipsoid and torus and genus") {
  constexpr int kLevels = 2;
  for (const ShapeKind kind : {ShapeKind::ellipsoid, ShapeKind::torus, ShapeKind::genus}) {
    ShapeOptions options;
    options.kind = kind;
    options.rotation_degrees = {11.0, 23.0, 37.0};
    const Errors order = orders(refine(make_shape(options), 20.0, kLevels));
    CHECK(order.rms >= 1.8);
    CHECK(order.max >= 1.5);
  }
}
