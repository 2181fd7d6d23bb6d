// The whole chain on shapes with known surfaces: fractions by quadrature, reconstruction, distance
// of the vertices. Errors of plic must fall with the square of the cell size.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "difmesh/fractions_from_function.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"

using namespace difmesh;

namespace {

struct Errors {
  double rms = 0.0;
  double max = 0.0;
};

struct Field {
  Grid grid;
  Array<double> fractions;
};

// The box is the shape's with a margin of three cells, moved by the given share of a cell: the
// maximum depends on how the surface lies in the grid.
Field field_of(const Shape& shape, double spacing, double moved) {
  const Bounds bounds = shape.bounds();
  Field field;
  Grid& grid = field.grid;
  grid.spacing = {spacing, spacing, spacing};
  for (std::size_t a = 0; a < 3; ++a) {
    const double size = bounds.high[a] - bounds.low[a];
    grid.dims[a] = static_cast<std::int64_t>(std::ceil(size / spacing)) + 6;
    const double middle = 0.5 * (bounds.low[a] + bounds.high[a]);
    grid.origin[a] = middle - 0.5 * spacing * static_cast<double>(grid.dims[a]) +
                     moved * spacing * (1.0 - 0.3 * static_cast<double>(a));
  }
  field.fractions = fractions_from_function(grid, shape.function()).fractions;
  return field;
}

// Distances of the vertices, over the cell size.
Errors errors(const Shape& shape, const Field& field, Placement placement) {
  Options options;
  options.placement = placement;
  const Mesh mesh = reconstruct(FieldView::x_fastest(field.fractions.data(), field.grid.dims),
                                field.grid, options)
                        .mesh;
  std::vector<double> distances(mesh.positions.size());
  shape.distances(mesh.positions, distances);
  Errors found;
  for (const double d : distances) {
    found.rms += d * d;
    found.max = std::max(found.max, std::abs(d));
  }
  found.rms = std::sqrt(found.rms / static_cast<double>(distances.size()));
  return {found.rms / field.grid.spacing[0], found.max / field.grid.spacing[0]};
}

// Orders of convergence of rms and maximum over all resolutions; each doubles the one before.
Errors orders(const std::vector<Errors>& found) {
  const auto doublings = static_cast<double>(found.size() - 1);
  return {1.0 + std::log2(found.front().rms / found.back().rms) / doublings,
          1.0 + std::log2(found.front().max / found.back().max) / doublings};
}

constexpr std::array<Placement, 3> kPlacements{Placement::linear, Placement::manson,
                                               Placement::plic};

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
  const Shape sphere = make_shape({});
  for (const Row& row : kTable) {
#ifdef DIFMESH_SANITIZED
    if (row.cells > 16.0) {
      continue;
    }
#endif
    const Field field = field_of(sphere, 1.0 / row.cells, 0.37);
    for (std::size_t n = 0; n < kPlacements.size(); ++n) {
      CAPTURE(row.cells);
      CAPTURE(n);
      const Errors found = errors(sphere, field, kPlacements[n]);
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
  constexpr std::array<double, 4> kMoves{0.07, 0.31, 0.58, 0.83};
  const Shape sphere = make_shape({});
  std::vector<Errors> found;
  double cells = 16.0;
  for (int level = 0; level < kLevels; ++level) {
    Errors mean;
    for (const double moved : kMoves) {
      const Errors one = errors(sphere, field_of(sphere, 1.0 / cells, moved), Placement::plic);
      mean.rms += one.rms / static_cast<double>(kMoves.size());
      mean.max += one.max / static_cast<double>(kMoves.size());
    }
    MESSAGE("plic at R/dx = " << cells << ": rms " << mean.rms << ", max " << mean.max);
    found.push_back(mean);
    cells *= 2.0;
  }
  const Errors order = orders(found);
  MESSAGE("orders: rms " << order.rms << ", max " << order.max);
  CHECK(order.rms >= 1.9);
  // The maximum needs all levels to show its order.
  CHECK(order.max >= (kLevels > 2 ? 1.9 : 1.8));
}

TEST_CASE("convergence: the table of errors for ellipsoid and torus and genus") {
#ifdef DIFMESH_SANITIZED
  constexpr int kLevels = 2;
#else
  constexpr int kLevels = 3;
#endif
  for (const ShapeKind kind : {ShapeKind::ellipsoid, ShapeKind::torus, ShapeKind::genus}) {
    CAPTURE(shape_name(kind));
    ShapeOptions options;
    options.kind = kind;
    options.rotation_degrees = {11.0, 23.0, 37.0};
    const Shape shape = make_shape(options);
    std::array<std::vector<Errors>, kPlacements.size()> found;
    double cells = 16.0;  // per unit of length
    for (int level = 0; level < kLevels; ++level) {
      const Field field = field_of(shape, 1.0 / cells, 0.37);
      for (std::size_t n = 0; n < kPlacements.size(); ++n) {
        found[n].push_back(errors(shape, field, kPlacements[n]));
      }
      const auto& [linear, manson, plic] = found;
      MESSAGE(shape_name(kind) << " at " << cells << " cells per unit: linear " << linear.back().rms
                               << " / " << linear.back().max << ", manson " << manson.back().rms
                               << " / " << manson.back().max << ", plic " << plic.back().rms
                               << " / " << plic.back().max);
      CHECK(plic.back().rms < manson.back().rms);
      CHECK(manson.back().rms < linear.back().rms);
      cells *= 2.0;
    }
    const Errors linear = orders(found[0]);
    const Errors plic = orders(found[2]);
    MESSAGE("orders of plic: rms " << plic.rms << ", max " << plic.max);
    CHECK(plic.rms >= 1.95);
    CHECK(plic.max >= 1.75);
    CHECK(linear.rms == doctest::Approx(1.0).epsilon(0.1));
  }
}
