// Grids whose axes are tables of faces.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "difmesh/cell_planes.hpp"
#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/edge_id.hpp"
#include "difmesh/error.hpp"
#include "difmesh/fractions_from_function.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/plane.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "support/blocks.hpp"
#include "support/differences.hpp"
#include "support/errors.hpp"
#include "support/fields.hpp"
#include "support/grids.hpp"
#include "support/near_pure.hpp"
#include "support/reports.hpp"
#include "support/slabs.hpp"

using namespace difmesh;
using namespace difmesh::test;

namespace {

/// Largest of the cell that a point lies in, or of a neighbour.
double local_size(const Grid& grid, const Vec3& point) {
  double size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& faces = grid.faces[axis];
    const auto above = std::upper_bound(faces.begin() + 1, faces.end() - 1, point[axis]);
    size = std::max(size, *above - *(above - 1));
  }
  return size;
}

}  // namespace

TEST_CASE("stretched: tilted planes are exact up to open sides") {
  // Widths from 1 to 7, and from 5 to 0.6.
  const Grid grid = grid_of(growing(12, 1.0, 1.2, -3.0), growing(13, 5.0, 1.0 / 1.2, 7.0),
                            growing(11, 0.7, 1.2, 0.1));
  const Vec3 middle = grid.cell_centre({6, 6, 5});
  std::mt19937_64 random(4);
  for (int n = 0; n < 150; ++n) {
    TiltedPlane plane{random_direction(random), 0.0};
    // Not through the centre itself, from which vertices keep their clearance.
    plane.offset = dot(plane.normal, middle) + 0.0123;
    const OwnedField field = plane.fractions(grid);
    for (const Normals normals : {Normals::height_function, Normals::elvira, Normals::lvira}) {
      Options options;
      options.normals = normals;
      options.vertex_normals = true;
      options.edge_ids = true;
      options.threads = 1;
      // On domain faces a corner of 1e-6 of a cell's volume may be 1e-4 of the face.
      options.purity_tolerance = 0.0;
      const Reconstruction result = reconstruct(field.view(), grid, options);
      REQUIRE(result.mesh.positions.size() > 20);
      double worst = 0.0;
      double turned = 0.0;
      for (std::size_t v = 0; v < result.mesh.positions.size(); ++v) {
        const Vec3& position = result.mesh.positions[v];
        if (ends_in_sliver(field, edge_of(grid.dims, result.mesh.edge_ids[v]))) {
          continue;
        }
        worst = std::max(worst, std::abs(dot(plane.normal, position) - plane.offset) /
                                    local_size(grid, position));
        turned = std::max(turned, test::largest_difference(result.mesh.normals[v], plane.normal));
      }
      CAPTURE(n);
      CAPTURE(static_cast<int>(normals));
      // ELVIRA has no candidate for all planes next to open sides, on uniform axes neither.
      if (normals != Normals::elvira) {
        CHECK(worst < 1e-12);
        CHECK(turned < 1e-11);
      }
      const Measure facts = measure(result.mesh);
      CHECK(facts.manifold);
    }
  }
}

TEST_CASE("stretched: ELVIRA is exact inside") {
  // Where cells grow by a fifth each, a plane in thousands leaves a column of five by a wisp.
  const Grid grid = grid_of(growing(11, 1.0, 1.1, -3.0), growing(12, 5.0, 1.0 / 1.1, 7.0),
                            growing(10, 0.7, 1.1, 0.1));
  std::mt19937_64 random(11);
  std::int64_t cells_seen = 0;
  for (int n = 0; n < 200; ++n) {
    TiltedPlane plane{random_direction(random), 0.0};
    plane.offset = dot(plane.normal, grid.cell_centre({5, 5, 4})) + 0.0123;
    const OwnedField field = plane.fractions(grid);
    Options options;
    options.normals = Normals::elvira;
    options.purity_tolerance = 0.0;  // what it lets pass as empty or full is missing in columns
    const Array<Index3> cells = interfacial_cells(field.view(), grid, options);
    std::vector<CellPlane> planes(cells.size());
    cell_planes(field.view(), grid, cells, options, planes);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      bool is_inside = field.at_cell(cells[c]) > 1e-3 && field.at_cell(cells[c]) < 1.0 - 1e-3;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        is_inside = is_inside && cells[c][axis] >= 3 && cells[c][axis] < grid.dims[axis] - 3;
      }
      if (is_inside) {
        ++cells_seen;
        CHECK(test::largest_difference(planes[c].plane.normal, plane.normal) < 1e-10);
      }
    }
  }
  CHECK(cells_seen > 5000);
}

TEST_CASE("stretched: planes of cells are exact and have the cells' sizes") {
  const Grid grid = grid_of(growing(9, 1.0, 1.2, 0.0), growing(10, 2.0, 1.0 / 1.2, 0.0),
                            growing(9, 0.5, 1.2, 0.0));
  std::mt19937_64 random(9);
  for (int n = 0; n < 40; ++n) {
    TiltedPlane plane{random_direction(random), 0.0};
    plane.offset = dot(plane.normal, grid.cell_centre({4, 5, 4}));
    const OwnedField field = plane.fractions(grid);
    Options options;
    options.normals = Normals::lvira;
    const Array<Index3> cells = interfacial_cells(field.view(), grid, options);
    std::vector<CellPlane> planes(cells.size());
    cell_planes(field.view(), grid, cells, options, planes);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      // A corner cut off by 1e-5 of a cell tells little.
      const double fraction = field.at_cell(cells[c]);
      if (fraction < 1e-3 || fraction > 1.0 - 1e-3) {
        continue;
      }
      CHECK(test::largest_difference(planes[c].plane.normal, plane.normal) < 1e-10);
      const double offset = plane.offset - dot(plane.normal, grid.cell_centre(cells[c]));
      CHECK(planes[c].plane.offset == doctest::Approx(offset).epsilon(1e-10));
    }
  }
}

TEST_CASE("stretched: spheres and tori converge at second order") {
  const auto rms = [](const Shape& shape, std::int64_t cells) {
    const Grid grid =
        grid_of(waving(cells, -1.6, 1.6), waving(cells, -1.55, 1.65), waving(cells, -1.63, 1.6));
    FractionsFromFunctionOptions sampling;
    sampling.tolerance = 1e-9;
    const FractionsFromFunction made = fractions_from_shape(grid, shape, sampling);
    CHECK(made.report.fraction_volume == doctest::Approx(*shape.volume()).epsilon(1e-8));
    const Reconstruction result =
        reconstruct(FieldView::x_fastest(made.fractions.data(), grid.dims), grid);
    CHECK(result.report.fraction_volume ==
          doctest::Approx(made.report.fraction_volume).epsilon(1e-12));
    CHECK(result.report.closed);
    CHECK(result.report.enclosed_volume == doctest::Approx(*shape.volume()).epsilon(0.05));
    double sum = 0.0;
    for (const Vec3& position : result.mesh.positions) {
      const double distance = shape.distance(position);
      sum += distance * distance;
    }
    return std::sqrt(sum / static_cast<double>(result.mesh.positions.size()));
  };
  for (const char* name : {"sphere", "torus"}) {
    ShapeOptions options;
    options.kind = shape_kind(name);
    options.rotation_degrees = {31.0, 17.0, 5.0};
    options.centre = {0.013, -0.021, 0.017};
    const Shape shape = make_shape(options);
    const double coarse = rms(shape, 32);
    const double fine = rms(shape, 64);
    const double order = std::log2(coarse / fine);
    CAPTURE(std::string(name));
    MESSAGE(std::string(name) << ": rms " << coarse << " and " << fine << ", order " << order);
    CHECK(order > 1.9);
  }
}

TEST_CASE("stretched: a table that is uniform is the uniform axis") {
  const OwnedField field = test::white_noise({13, 11, 12}, 2);
  const Grid uniform{field.dims, {0.3, -2.0, 7.0}, {0.1, 0.7, 1.3}};
  Grid table;
  table.dims = field.dims;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::int64_t n = 0; n <= field.dims[axis]; ++n) {
      table.faces[axis].push_back(uniform.face(axis, n));
    }
  }
  for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty}) {
    Options options;
    options.boundary.fill(side);
    const Mesh a = reconstruct(field.view(), uniform, options).mesh;
    const Mesh b = reconstruct(field.view(), table, options).mesh;
    REQUIRE(a.triangles == b.triangles);
    CHECK(test::largest_difference(a.positions, b.positions) < 1e-12);
  }
}

TEST_CASE("stretched: any cut gives the whole to the last bit") {
  const OwnedField fields[] = {test::white_noise({9, 8, 17}, 3), test::half_noise({8, 9, 16}, 4),
                               test::near_pure_noise({7, 9, 16}, 1e-6, 6)};
  for (const OwnedField& field : fields) {
    const Grid grid =
        grid_of(growing(field.dims[0], 0.1, 1.2, 3.0), growing(field.dims[1], 2.0, 0.8, -1.0),
                waving(field.dims[2], -4.0, 9.0));
    for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full}) {
      for (const Placement placement : {Placement::linear, Placement::plic}) {
        Options options;
        options.boundary.fill(side);
        options.placement = placement;
        options.edge_ids = true;
        options.vertex_normals = true;
        const Reconstruction whole = reconstruct(field.view(), grid, options);
        REQUIRE(whole.mesh.triangles.size() > 100);
        const Reconstruction joined = test::in_blocks(field, grid, {4, 3, 7}, options);
        CHECK(test::same_bits(joined.mesh, whole.mesh));
        CHECK(test::difference(joined.report, whole.report, 1e-12) == "");
        if (side != Side::periodic) {
          const Reconstruction built = test::in_slabs(field.view(), grid, options, 3);
          CHECK(test::same_bits(built.mesh, whole.mesh));
          CHECK(test::difference(built.report, whole.report) == "");
        }
        Options other = options;
        other.threads = 3;
        CHECK(test::same_bits(reconstruct(field.view(), grid, other).mesh, whole.mesh));
      }
    }
  }
}

TEST_CASE("stretched: noise is manifold and its vertices keep their edges") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const OwnedField field =
        seed % 2 == 0 ? test::white_noise({9, 10, 8}, seed) : test::half_noise({9, 10, 8}, seed);
    // Neighbours differ by up to a thousand times.
    std::mt19937_64 random(seed);
    std::array<std::vector<double>, 3> faces;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      faces[axis].push_back(-1.0);
      for (std::int64_t n = 0; n < field.dims[axis]; ++n) {
        faces[axis].push_back(faces[axis].back() +
                              std::pow(10.0, static_cast<double>(random() % 4)));
      }
    }
    const Grid grid = grid_of(faces[0], faces[1], faces[2]);
    for (const Side side : {Side::open, Side::mirror, Side::empty, Side::full}) {
      for (const Normals normals :
           {Normals::youngs, Normals::myc, Normals::height_function, Normals::lvira}) {
        Options options;
        options.boundary.fill(side);
        options.normals = normals;
        options.vertex_normals = true;
        const Reconstruction result = reconstruct(field.view(), grid, options);
        const Measure facts = measure(result.mesh);
        CHECK(facts.manifold);
        CHECK(facts.closed == result.report.closed);
        if (side == Side::empty || side == Side::full) {
          CHECK(result.report.closed);
          CHECK(facts.volume == doctest::Approx(result.report.enclosed_volume).epsilon(1e-9));
        }
        for (const Vec3& normal : result.mesh.normals) {
          CHECK(dot(normal, normal) == doctest::Approx(1.0).epsilon(1e-12));
        }
      }
    }
  }
}

TEST_CASE("stretched: fractions of a function are those of each cell by itself") {
  const Grid grid = grid_of(growing(7, 0.1, 1.2, -0.9), growing(8, 0.5, 1.0 / 1.2, -1.1),
                            growing(7, 0.15, 1.2, -1.0));
  ShapeOptions options;
  options.kind = shape_kind("torus");
  options.rotation_degrees = {20.0, 40.0, 0.0};
  const Shape shape = make_shape(options);
  const FractionsFromFunction made = fractions_from_shape(grid, shape);
  double volume = 0.0;
  std::size_t n = 0;
  for_each_cell(grid, [&](const Index3& cell) {
    Grid alone{{1, 1, 1}, {}, grid.cell_size(cell)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      alone.origin[axis] = grid.face(axis, cell[axis]);
    }
    const double fraction = fractions_from_shape(alone, shape).fractions[0];
    CHECK(made.fractions[n] == doctest::Approx(fraction).epsilon(1e-12));
    volume += fraction * alone.cell_volume();
    ++n;
  });
  CHECK(made.report.fraction_volume == doctest::Approx(volume).epsilon(1e-12));
}

TEST_CASE("stretched: bad tables are named") {
  const OwnedField field({3, 3, 3}, 0.5);
  Grid grid = grid_of({0.0, 1.0, 3.0, 4.0}, {0.0, 1.0, 2.0, 5.0}, {0.0, 1.0, 2.0, 3.0});
  const auto error = [&] { return error_of([&] { (void)reconstruct(field.view(), grid); }); };
  CHECK(error() == "");
  grid.faces[1] = {0.0, 1.0, 2.0};
  CHECK(error() == "faces in y: 3 for 3 cells, which have one more");
  grid.faces[1] = {0.0, 1.0, 1.0, 2.0};
  CHECK(error() == "faces in y: number 2 is not greater than the one before");
  grid.faces[1] = {0.0, 1.0, std::nan(""), 2.0};
  CHECK(error() == "faces in y: number 2 is not finite");
  grid.faces[1] = {1e15, 1e15 + 1.0, 1e15 + 2.0, 1e15 + 3.0};
  CHECK(error().find("faces in y: number 1 is 1 from the one before, too little") == 0);
  grid.faces[1] = {0.0, 1e-120, 1.0, 2.0};
  CHECK(error().find("faces in y: number 1 is 1e-120 from the one before") == 0);
}

TEST_CASE("stretched: what needs uniform axes says so") {
  const Grid grid =
      grid_of(growing(5, 1.0, 1.2, 0.0), growing(5, 1.0, 1.0, 0.0), growing(5, 1.0, 1.0, 0.0));
  CHECK(error_of([&] { (void)smooth_within_fractions(Mesh(), grid); }) ==
        "smooth_within_fractions: the grid is stretched in x; uniform axes are needed");
  CHECK(error_of([&] { (void)fractions_from_mesh(grid, {}, {}); }) ==
        "fractions_from_mesh: the grid is stretched in x; uniform axes are needed");
}
