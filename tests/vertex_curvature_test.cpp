// Curvature at vertices from fractions, against closed forms and the patches on the mesh.

#include "difmesh/vertex_curvature.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "support/errors.hpp"
#include "support/fields.hpp"
#include "support/grids.hpp"
#include "support/shape_fields.hpp"

using namespace difmesh;
using namespace difmesh::test;

namespace {

OwnedField fractions(const Grid& grid, const Shape& shape) {
  return fractions_of(grid, shape, 1e-11);
}

Options with_ids(Placement placement = Placement::curved) {
  Options options;
  options.placement = placement;
  options.edge_ids = true;
  return options;
}

using Errors = ErrorSums;

}  // namespace

TEST_CASE("vertex curvature: spheres, beside an independent program") {
  struct Row {
    double radius;
    int centres;
    double rms;
    double most;
  };
  for (const Row& row :
       {Row{7.68, 6, 1.7e-3, 1.1e-2}, Row{12.8, 4, 4.5e-4, 5.9e-3}, Row{15.4, 3, 2.7e-4, 5.4e-3},
        Row{25.6, 2, 1.8e-4, 1.6e-3}, Row{44.2, 1, 2.9e-5, 3.7e-4}}) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> within(-0.5, 0.5);
    Errors cells;
    Errors patches;
    for (int n = 0; n < row.centres; ++n) {
      const auto count = static_cast<std::int64_t>(2.0 * row.radius) + 17;
      const Grid grid{{count, count, count}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
      const double middle = 0.5 * static_cast<double>(count);
      const OwnedField field = fractions(
          grid, ball({middle + within(random), middle + within(random), middle + within(random)},
                     row.radius));
      const Mesh mesh = reconstruct(field.view(), grid, with_ids()).mesh;
      const Curvature found = vertex_curvature(field.view(), grid, mesh, with_ids());
      CHECK(found.undefined_vertices == 0);
      for (const double mean : found.mean) {
        cells.add(mean * row.radius - 1.0);
      }
      for (const double mean : curvature(mesh).mean) {
        patches.add(mean * row.radius - 1.0);
      }
    }
    MESSAGE("R " << row.radius << ": " << cells.rms() << " / " << cells.most << ", patches "
                 << patches.rms() << " / " << patches.most);
    CHECK(cells.rms() < 1.2 * row.rms);
    CHECK(cells.most < 1.3 * row.most);
    CHECK(cells.rms() < patches.rms());
  }
}

TEST_CASE("vertex curvature: plic's vertices have it too, and principal ones agree") {
  const Grid grid{{40, 40, 40}, {-1.25, -1.25, -1.25}, {0.0625, 0.0625, 0.0625}};
  ShapeOptions options;
  options.kind = shape_kind("torus");
  options.radius = 0.8;
  options.tube_radius = 0.35;
  const OwnedField field = fractions(grid, make_shape(options));
  const Options plic = with_ids(Placement::plic);
  const Mesh mesh = reconstruct(field.view(), grid, plic).mesh;
  const Curvature found = vertex_curvature(field.view(), grid, mesh, plic, true);
  Errors mean;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& at = mesh.positions[v];
    const double cosine = (std::hypot(at[0], at[1]) - 0.8) / 0.35;
    const double round = cosine / (0.8 + 0.35 * cosine);
    mean.add(found.mean[v] - 0.5 * (1.0 / 0.35 + round));
    CHECK(found.largest[v] + found.smallest[v] == doctest::Approx(2.0 * found.mean[v]));
    CHECK(found.largest[v] >= found.smallest[v]);
  }
  CHECK(mean.rms() < 0.03);
}

TEST_CASE("vertex curvature: planes are flat on all grids and sides") {
  std::mt19937_64 random(8);
  const Grid stretched = grid_of(growing(9, 1.0, 1.2, -3.0), growing(10, 5.0, 1.0 / 1.2, 7.0),
                                 growing(8, 0.7, 1.2, 0.1));
  const Grid cubes{{9, 10, 8}, {-4.0, 2.0, 1.0}, {1.0, 1.0, 1.0}};
  for (int n = 0; n < 10; ++n) {
    for (const Grid& grid : {stretched, cubes}) {
      TiltedPlane plane{random_direction(random), 0.0};
      plane.offset = dot(plane.normal, grid.cell_centre({4, 4, 4})) + 0.0123;
      const OwnedField field = plane.fractions(grid);
      const Mesh mesh = reconstruct(field.view(), grid, with_ids()).mesh;
      const Curvature found = vertex_curvature(field.view(), grid, mesh, with_ids());
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (!ends_in_sliver(field, edge_of(grid.dims, mesh.edge_ids[v]))) {
          CHECK(std::abs(found.mean[v]) < 1e-4);
        }
      }
    }
  }
}

TEST_CASE("vertex curvature: noise gives numbers, bad meshes are named") {
  for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full}) {
    const OwnedField field = white_noise({7, 8, 6}, 3);
    const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 2.0, 5.0}};
    Options options = with_ids();
    options.boundary.fill(side);
    options.threads = 1;
    const Mesh mesh = reconstruct(field.view(), grid, options).mesh;
    const Curvature found = vertex_curvature(field.view(), grid, mesh, options, true);
    options.threads = 3;
    const Curvature again = vertex_curvature(field.view(), grid, mesh, options, true);
    std::int64_t undefined = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      undefined += std::isnan(found.mean[v]) ? 1 : 0;
      CHECK((found.mean[v] == again.mean[v] || std::isnan(found.mean[v])));
    }
    CHECK(found.undefined_vertices == undefined);
  }
  const OwnedField field = blob({12, 12, 12});
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  Mesh mesh = reconstruct(field.view(), grid, with_ids()).mesh;
  const auto error = [&] {
    return error_of([&] { (void)vertex_curvature(field.view(), grid, mesh, with_ids()); });
  };
  CHECK(error() == "");
  mesh.edge_ids.back() = edge_id_end(grid.dims);
  CHECK(error() == "vertex_curvature: an edge id outside the grid: 8232");
  mesh.edge_ids.pop_back();
  CHECK(error() == "vertex_curvature: the mesh has no edge_ids");
}
