// Vertices on curved surfaces: distances to closed forms, planes, sides, symmetry, and any field.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "difmesh/measure.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "support/fields.hpp"
#include "support/grids.hpp"
#include "support/near_pure.hpp"
#include "support/shape_fields.hpp"

using namespace difmesh;
using namespace difmesh::test;

namespace {

#ifdef DIFMESH_SANITIZED
constexpr double kMostCells = 8.0;
#else
constexpr double kMostCells = 64.0;
#endif

Options curved(Side side = Side::open) {
  Options options;
  options.placement = Placement::curved;
  options.vertex_normals = true;
  options.boundary.fill(side);
  return options;
}

Shape shape_of(const std::string& name) {
  ShapeOptions options;
  options.kind = shape_kind(name);
  options.radius = 1.0;
  options.semi_axes = {1.0, 0.8, 0.6};
  options.tube_radius = 0.4;
  return make_shape(options);
}

// Around the shape, with so many cells per unit of length, anywhere within a cell.
Grid grid_around(const Shape& shape, const Vec3& spacing, std::mt19937_64& random) {
  std::uniform_real_distribution<double> within(0.0, 1.0);
  Grid grid;
  grid.spacing = spacing;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = shape.bounds().low[axis];
    const double extent = shape.bounds().high[axis] - low;
    grid.dims[axis] = static_cast<std::int64_t>(extent / spacing[axis]) + 8;
    grid.origin[axis] = low - (3.0 + within(random)) * spacing[axis];
  }
  return grid;
}

OwnedField fractions(const Grid& grid, const Shape& shape) {
  return fractions_of(grid, shape, 1e-12);
}

using Errors = ErrorSums;

// In the largest spacing.
Errors errors_of(const std::string& name, const Vec3& spacing, int centres,
                 const Options& options = curved()) {
  const Shape shape = shape_of(name);
  std::mt19937_64 random(1);
  Errors errors;
  for (int n = 0; n < centres; ++n) {
    const Grid grid = grid_around(shape, spacing, random);
    const Reconstruction result = reconstruct(fractions(grid, shape).view(), grid, options);
    CHECK(result.report.closed);
    CHECK(measure(result.mesh).manifold);
    for (const Vec3& position : result.mesh.positions) {
      errors.add(shape.distance(position) / std::max({spacing[0], spacing[1], spacing[2]}));
    }
  }
  return errors;
}

}  // namespace

TEST_CASE("curved: distances to a sphere, an ellipsoid and a torus") {
  // From an independent program: rms and largest distance in spacings. Largest ones are those of
  // more centres.
  struct Row {
    const char* shape;
    double cells;
    double rms;
    double most;
  };
  for (const Row& row :
       {Row{"sphere", 4.0, 1.9e-3, 5.6e-3}, Row{"sphere", 8.0, 2.0e-4, 9.9e-4},
        Row{"sphere", 16.0, 2.5e-5, 2.2e-4}, Row{"sphere", 32.0, 1.0e-6, 1.3e-5},
        Row{"sphere", 64.0, 4.5e-8, 8.7e-7}, Row{"ellipsoid", 4.0, 7.3e-3, 2.9e-2},
        Row{"ellipsoid", 8.0, 1.1e-3, 6.8e-3}, Row{"ellipsoid", 16.0, 1.5e-4, 1.4e-3},
        Row{"ellipsoid", 32.0, 1.7e-5, 4.1e-4}, Row{"torus", 8.0, 1.8e-3, 6.9e-3},
        Row{"torus", 16.0, 2.0e-4, 1.6e-3}}) {
    if (row.cells > kMostCells) {
      continue;
    }
    const double h = 1.0 / row.cells;
    const Errors errors = errors_of(row.shape, {h, h, h}, row.cells <= 16.0 ? 4 : 1);
    MESSAGE(row.shape << " " << row.cells << ": " << errors.rms() << " / " << errors.most);
    CHECK(errors.rms() < 1.2 * row.rms);
    CHECK(errors.most < 1.3 * row.most);
  }
}

TEST_CASE("curved: far nearer than plic where cells are flat") {
  const Vec3 spacing{0.025, 0.05, 0.125};
  Options plic = curved();
  plic.placement = Placement::plic;
  const Errors with = errors_of("sphere", spacing, 2);
  const Errors without = errors_of("sphere", spacing, 2, plic);
  MESSAGE("1 : 2 : 5: " << with.rms() << " / " << with.most << ", plic " << without.rms() << " / "
                        << without.most);
  CHECK(with.rms() < 2.7e-5 * 1.2);
  CHECK(with.most < 4.2e-4 * 1.3);
  CHECK(with.rms() < 0.01 * without.rms());
}

TEST_CASE("curved: planes are exact up to open sides, their normals too") {
  std::mt19937_64 random(4);
  const Grid cubes{{12, 11, 10}, {-4.0, 2.0, 1.0}, {1.0, 1.0, 1.0}};
  const Grid flat{{11, 12, 13}, {0.0, 0.0, 0.0}, {1.0, 2.0, 5.0}};
  const Grid stretched = grid_of(growing(11, 1.0, 1.2, -3.0), growing(12, 5.0, 1.0 / 1.2, 7.0),
                                 growing(10, 0.7, 1.2, 0.1));
  std::size_t checked = 0;
  for (int n = 0; n < 30; ++n) {
    for (const Grid& grid : {cubes, flat, stretched}) {
      TiltedPlane plane{random_direction(random), 0.0};
      plane.offset = dot(plane.normal, grid.cell_centre({5, 5, 5})) + 0.0123;
      const OwnedField field = plane.fractions(grid);
      Options options = curved();
      options.normals = Normals::lvira;
      options.purity_tolerance = 0.0;
      options.edge_ids = true;
      const Reconstruction result = reconstruct(field.view(), grid, options);
      CHECK(measure(result.mesh).manifold);
      for (std::size_t v = 0; v < result.mesh.positions.size(); ++v) {
        if (ends_in_sliver(field, edge_of(grid.dims, result.mesh.edge_ids[v]))) {
          continue;
        }
        ++checked;
        const double size = std::max({grid.width(0, 10), grid.width(1, 0), grid.width(2, 9)});
        CHECK(std::abs(dot(plane.normal, result.mesh.positions[v]) - plane.offset) < 1e-11 * size);
        CHECK(length(subtract(result.mesh.normals[v], plane.normal)) < 1e-9);
      }
    }
  }
  CHECK(checked > 8000);
}

TEST_CASE("curved: vertex normals are the surface's") {
  const Shape shape = shape_of("sphere");
  const Grid grid{{40, 40, 40}, {-1.23, -1.21, -1.24}, {1.0 / 16, 1.0 / 16, 1.0 / 16}};
  const Mesh mesh = reconstruct(fractions(grid, shape).view(), grid, curved()).mesh;
  double most = 0.0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    most = std::max(most, length(subtract(mesh.normals[v], unit(mesh.positions[v]))));
  }
  CHECK(most < 2e-3);  // plic: 2e-2
}

TEST_CASE("curved: behind mirrors, and through periodic sides, as in the whole field") {
  const Grid whole{{24, 24, 24}, {-1.2, -1.2, -1.2}, {0.1, 0.1, 0.1}};
  const Shape ball = make_shape([] {
    ShapeOptions options;
    options.kind = shape_kind("sphere");
    options.radius = 0.83;
    return options;
  }());
  const OwnedField field = fractions(whole, ball);
  const Mesh all = reconstruct(field.view(), whole, curved(Side::empty)).mesh;
  const auto distance_to_all = [&](const Vec3& position) {
    double least = 1.0;
    for (const Vec3& other : all.positions) {
      least = std::min(least, length(subtract(position, other)));
    }
    return least;
  };
  SUBCASE("an eighth") {
    const Grid eighth{{12, 12, 12}, {0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}};
    OwnedField part(eighth.dims);
    for_each_cell(eighth, [&](const Index3& cell) {
      part.at(cell[0], cell[1], cell[2]) =
          field.at_cell({cell[0] + 12, cell[1] + 12, cell[2] + 12});
    });
    Options options = curved();
    options.boundary = {Side::mirror, Side::empty,  Side::mirror,
                        Side::empty,  Side::mirror, Side::empty};
    const Mesh mesh = reconstruct(part.view(), eighth, options).mesh;
    std::size_t on_faces = 0;
    for (const Vec3& position : mesh.positions) {
      if (position[0] == 0.0 || position[1] == 0.0 || position[2] == 0.0) {
        ++on_faces;  // the whole mesh has no vertices there, but the ball has
        CHECK(std::abs(length(position) - 0.83) < 2e-4);
      } else {
        CHECK(distance_to_all(position) < 1e-14);
      }
    }
    CHECK(on_faces > 20);
  }
  SUBCASE("shifted") {
    OwnedField shifted(whole.dims);
    for_each_cell(whole, [&](const Index3& cell) {
      shifted.at((cell[0] + 12) % 24, (cell[1] + 3) % 24, (cell[2] + 20) % 24) =
          field.at_cell(cell);
    });
    const Mesh mesh = reconstruct(shifted.view(), whole, curved(Side::periodic)).mesh;
    REQUIRE(mesh.positions.size() >= all.positions.size());
    for (Vec3 position : mesh.positions) {
      const Vec3 shift{1.2, 0.3, 2.0};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        position[axis] -= shift[axis];
        position[axis] += position[axis] < -1.2 + 0.049 ? 2.4 : 0.0;
      }
      CHECK(distance_to_all(position) < 1e-13);
    }
  }
}

TEST_CASE("curved: an open side is met where the surface meets it") {
  // A ball cut by the domain, as a drop on a wall at an angle.
  const Grid grid{{36, 36, 20}, {-1.2, -1.2, -0.3}, {1.0 / 15, 1.0 / 15, 1.0 / 15}};
  const Shape shape = shape_of("sphere");
  const Mesh mesh = reconstruct(fractions(grid, shape).view(), grid, curved()).mesh;
  Errors on_face;
  Errors all;
  for (const Vec3& position : mesh.positions) {
    const double error = (length(position) - 1.0) * 15.0;
    all.add(error);
    if (position[2] == grid.origin[2]) {
      on_face.add(error);
    }
  }
  MESSAGE("open side: " << all.rms() << " / " << all.most << ", on it " << on_face.rms() << " / "
                        << on_face.most);
  CHECK(on_face.count > 60.0);
  CHECK(on_face.rms() < 1e-3);
  CHECK(on_face.most < 5e-3);
  CHECK(measure(mesh).manifold);
}

TEST_CASE("curved: any field gives a manifold mesh whose vertices keep their edges") {
  for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full}) {
    for (const OwnedField& field :
         {white_noise({9, 8, 10}, 1), half_noise({8, 9, 7}, 2), near_half_noise({9, 8, 7}, 3),
          white_noise({1, 7, 8}, 4), white_noise({1, 1, 9}, 5), blob({16, 15, 14})}) {
      const Grid grid{field.dims, {0.5, -1.0, 2.0}, {1.0, 0.5, 20.0}};
      Options options = curved(side);
      options.edge_ids = true;
      const Reconstruction result = reconstruct(field.view(), grid, options);
      CAPTURE(static_cast<int>(side));
      CAPTURE(field.dims[0]);
      const Measure facts = measure(result.mesh);
      CHECK(facts.manifold);
      CHECK((side == Side::open || side == Side::mirror || side == Side::periodic ||
             result.report.closed));
      for (std::size_t v = 0; v < result.mesh.positions.size(); ++v) {
        const DualEdgeName edge = edge_of(grid.dims, result.mesh.edge_ids[v]);
        const Vec3& position = result.mesh.positions[v];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          REQUIRE(std::isfinite(position[axis]));
          // Nodes on domain faces lie half a cell nearer.
          const double index = (position[axis] - grid.origin[axis]) / grid.spacing[axis] - 0.5;
          const auto low = static_cast<double>(edge.lower[axis]);
          const bool is_along = static_cast<std::size_t>(edge.axis) == axis;
          CHECK(index > low - 0.5 - 1e-8);
          CHECK(index < low + (is_along ? 1.0 : 0.5) + 1e-8);
        }
        CHECK(length(result.mesh.normals[v]) == doctest::Approx(1.0));
      }
    }
  }
}

TEST_CASE("curved: noise on a sphere stays near plic's distances") {
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  const Shape shape = shape_of("sphere");
  const Grid grid{{56, 56, 56}, {-1.17, -1.16, -1.15}, {1.0 / 24, 1.0 / 24, 1.0 / 24}};
  const OwnedField exact = fractions(grid, shape);
  for (const double level : {1e-3, 1e-2, 5e-2}) {
    OwnedField field = exact;
    for (double& value : field.values) {
      const bool is_interfacial = value > 0.0 && value < 1.0;
      value = is_interfacial ? std::clamp(value + level * normal(random), 0.0, 1.0) : value;
    }
    Errors errors[2];
    for (int n = 0; n < 2; ++n) {
      Options options = curved();
      options.placement = n == 0 ? Placement::plic : Placement::curved;
      const Mesh mesh = reconstruct(field.view(), grid, options).mesh;
      CHECK(measure(mesh).manifold);
      for (const Vec3& position : mesh.positions) {
        errors[n].add((length(position) - 1.0) * 24.0);
      }
    }
    MESSAGE("noise " << level << ": plic " << errors[0].rms() << " / " << errors[0].most
                     << ", curved " << errors[1].rms() << " / " << errors[1].most);
    CHECK(errors[1].rms() < 1.03 * errors[0].rms());
  }
}
