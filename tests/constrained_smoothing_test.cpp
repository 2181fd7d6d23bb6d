#include "difmesh/constrained_smoothing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "difmesh/curvature.hpp"
#include "difmesh/error.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "support/dual_edges.hpp"
#include "support/fields.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::Array;
using difmesh::ConstrainedSmoothing;
using difmesh::ErrorCode;
using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Mesh;
using difmesh::smooth_within_fractions;
using difmesh::Vec3;
using namespace difmesh::test;

const Vec3 kCentre{14.1, 13.8, 14.3};
constexpr double kRadius = 11.0;
const Grid kGrid{.dims = {28, 28, 28}};

Mesh ball(difmesh::Placement placement) {
  const auto shape = difmesh::make_shape({.centre = kCentre, .radius = kRadius});
  const auto fractions = difmesh::fractions_from_shape(kGrid, shape).fractions;
  difmesh::Options options;
  options.placement = placement;
  options.edge_ids = true;
  return difmesh::reconstruct(FieldView::x_fastest(fractions.data(), kGrid.dims), kGrid, options)
      .mesh;
}

/// A closed surface about noise: everything beyond the domain is empty.
Mesh noise(const Grid& grid, std::uint64_t seed) {
  const OwnedField field = white_noise(grid.dims, seed);
  difmesh::Options options;
  options.edge_ids = true;
  options.boundary.fill(difmesh::Side::empty);
  return difmesh::reconstruct(field.view(), grid, options).mesh;
}

double largest_change(const Mesh& mesh, const Array<Vec3>& positions, const Grid& grid) {
  const auto before = difmesh::fractions_from_mesh(grid, mesh.positions, mesh.triangles).fractions;
  const auto after = difmesh::fractions_from_mesh(grid, positions, mesh.triangles).fractions;
  double largest = 0.0;
  for (std::size_t cell = 0; cell < before.size(); ++cell) {
    largest = std::max(largest, std::abs(after[cell] - before[cell]));
  }
  return largest;
}

double curvature_error(const Array<Vec3>& positions, const Mesh& mesh) {
  double sum = 0.0;
  const auto curvature = difmesh::curvature(positions, mesh.triangles);
  for (const double mean : curvature.mean) {
    sum += (mean * kRadius - 1.0) * (mean * kRadius - 1.0);
  }
  return std::sqrt(sum / static_cast<double>(positions.size()));
}

void attempt(const Mesh& mesh, const Grid& grid,
             const difmesh::ConstrainedSmoothingOptions& options = {}) {
  static_cast<void>(smooth_within_fractions(mesh, grid, options));
}

ErrorCode code_of(const std::function<void()>& call, const std::string& words) {
  try {
    call();
  } catch (const difmesh::Error& error) {
    CAPTURE(error.what());
    CHECK(std::string(error.what()).find(words) != std::string::npos);
    return error.code();
  }
  FAIL("no error was thrown");
  return {};
}

}  // namespace

TEST_CASE("constrained smoothing: no fraction changes by more than the tolerance") {
  for (const auto placement : {difmesh::Placement::linear, difmesh::Placement::manson}) {
    const Mesh mesh = ball(placement);
    for (const double tolerance : {1e-4, 1e-3, 1e-2, 0.1}) {
      CAPTURE(tolerance);
      const ConstrainedSmoothing smooth =
          smooth_within_fractions(mesh, kGrid, {.tolerance = tolerance});
      const double change = largest_change(mesh, smooth.mesh.positions, kGrid);
      CHECK(change == smooth.largest_change);
      CHECK(change <= tolerance);
      CHECK(change > 0.0);
      if (tolerance < 2e-3) {
        CHECK(smooth.held_vertices > 0);
        CHECK(change > 0.9 * tolerance);
      }
    }
  }
}

TEST_CASE("constrained smoothing: vertices stay on their edges and the surface a manifold") {
  const Grid grid{.dims = {13, 12, 11}, .origin = {-3.0, 5.0, 100.0}, .spacing = {0.5, 1.0, 2.0}};
  const Mesh mesh = noise(grid, 17);
  const double clearance = 0.01;
  const ConstrainedSmoothing smooth =
      smooth_within_fractions(mesh, grid, {.steps = 2, .tolerance = 0.2, .clearance = clearance});
  CHECK(largest_change(mesh, smooth.mesh.positions, grid) <= 0.2);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const DualEdge edge = dual_edge(mesh.edge_ids[v], grid.dims);
    for (std::size_t a = 0; a < 3; ++a) {
      if (a != edge.axis) {
        REQUIRE(smooth.mesh.positions[v][a] == mesh.positions[v][a]);
      } else if (smooth.mesh.positions[v][a] != mesh.positions[v][a]) {
        const double share =
            (smooth.mesh.positions[v][a] - grid.cell_centre(edge.node)[a]) / grid.spacing[a];
        const double was =
            (mesh.positions[v][a] - grid.cell_centre(edge.node)[a]) / grid.spacing[a];
        REQUIRE(share >= std::min(was, clearance) - 1e-12);
        REQUIRE(share <= std::max(was, 1.0 - clearance) + 1e-12);
        ++moved;
      }
    }
  }
  CHECK(moved > mesh.positions.size() / 4);
  const auto measure = difmesh::measure(smooth.mesh.positions, mesh.triangles);
  CHECK(measure.closed);
  CHECK(measure.manifold);
  CHECK(measure.volume > 0.0);
}

TEST_CASE("constrained smoothing: smooths what the tolerance lets it and keeps the volume") {
  const Mesh manson = ball(difmesh::Placement::manson);
  const double before = curvature_error(manson.positions, manson);
  const double volume = difmesh::measure(manson).volume;
  double last = before;
  for (const int steps : {1, 3, 10}) {
    const ConstrainedSmoothing smooth =
        smooth_within_fractions(manson, kGrid, {.steps = steps, .tolerance = 0.02});
    const double error = curvature_error(smooth.mesh.positions, manson);
    CHECK(error < last);
    last = error;
    CHECK(difmesh::measure(smooth.mesh.positions, manson.triangles).volume ==
          doctest::Approx(volume).epsilon(5e-4));
  }
  CHECK(last < 0.75 * before);
  const ConstrainedSmoothing none = smooth_within_fractions(manson, kGrid, {.steps = 0});
  CHECK(same_bytes(none.mesh.positions, manson.positions));
  CHECK(none.largest_change == 0.0);
}

TEST_CASE("constrained smoothing: no bit depends on the number of threads") {
  const Mesh mesh = ball(difmesh::Placement::linear);
  const ConstrainedSmoothing one = smooth_within_fractions(mesh, kGrid, {.threads = 1});
  for (const int threads : {2, 3, 0}) {
    const ConstrainedSmoothing other = smooth_within_fractions(mesh, kGrid, {.threads = threads});
    CHECK(same_bytes(one.mesh.positions, other.mesh.positions));
    CHECK(one.largest_change == other.largest_change);
    CHECK(one.held_vertices == other.held_vertices);
    CHECK(one.measurements == other.measurements);
  }
}

TEST_CASE("constrained smoothing: bad input is named") {
  const Mesh mesh = ball(difmesh::Placement::linear);
  const auto invalid = ErrorCode::invalid_argument;
  CHECK(code_of([&] { attempt(mesh, kGrid, {.steps = -1}); }, "steps is -1") == invalid);
  CHECK(code_of([&] { attempt(mesh, kGrid, {.tolerance = 0.6}); }, "tolerance is 0.6") == invalid);
  CHECK(code_of([&] { attempt(mesh, kGrid, {.clearance = 0.3}); }, "clearance is 0.3") == invalid);
  Mesh unnamed = mesh;
  unnamed.edge_ids.clear();
  CHECK(code_of([&] { attempt(unnamed, kGrid); }, "no edge_ids") == invalid);
  Grid other = kGrid;
  other.origin[1] = 0.25;
  CHECK(code_of([&] { attempt(mesh, other); }, "vertex 0 at") == invalid);
  other.dims = {5, 5, 5};
  CHECK(code_of([&] { attempt(mesh, other); }, "vertex") == invalid);
  Mesh open = mesh;
  open.triangles.pop_back();
  CHECK(code_of([&] { attempt(open, kGrid); }, "") == invalid);
  CHECK(code_of([&] { attempt(mesh, kGrid, {.progress = [](double) { return false; }}); },
                "cancelled") == ErrorCode::cancelled);
  CHECK(smooth_within_fractions({}, kGrid).mesh.positions.empty());
}
