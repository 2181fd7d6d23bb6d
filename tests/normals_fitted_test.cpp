// ELVIRA and LVIRA: normals whose planes suit the neighbours' fractions.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "difmesh/cell_planes.hpp"
#include "difmesh/plane.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "support/fields.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::CellPlane;
using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::Normals;
using difmesh::NormalSource;
using difmesh::Options;
using difmesh::Vec3;
using namespace difmesh::test;

#ifdef DIFMESH_SANITIZED
constexpr int kPlanes = 12;
#else
constexpr int kPlanes = 120;
#endif

struct Fitted {
  difmesh::Array<Index3> cells;
  std::vector<CellPlane> planes;
};

Fitted fit(const OwnedField& field, const Grid& grid, const Options& options) {
  Fitted fitted;
  fitted.cells = difmesh::interfacial_cells(field.view(), grid, options);
  fitted.planes.resize(fitted.cells.size());
  difmesh::cell_planes(field.view(), grid, fitted.cells, options, fitted.planes);
  return fitted;
}

/// Fractions of the half-space normal·x < level.
OwnedField half_space(const Grid& grid, const Vec3& normal, double level) {
  OwnedField field(grid.dims);
  for (std::int64_t k = 0; k < grid.dims[2]; ++k) {
    for (std::int64_t j = 0; j < grid.dims[1]; ++j) {
      for (std::int64_t i = 0; i < grid.dims[0]; ++i) {
        const double offset = level - dot(normal, grid.cell_centre({i, j, k}));
        field.at(i, j, k) = difmesh::plane_fraction(normal, grid.spacing, offset);
      }
    }
  }
  return field;
}

/// Sum of squares by which the plane of that normal misses the 27 fractions about a cell, the
/// cell's own exactly kept, in a grid of unit cubes.
double misfit(OwnedField& field, const Index3& cell, const Vec3& normal) {
  const Vec3 spacing{1.0, 1.0, 1.0};
  const double offset = difmesh::plane_offset(normal, spacing, field.at(cell[0], cell[1], cell[2]));
  double sum = 0.0;
  for (std::int64_t n = 0; n < 27; ++n) {
    const Index3 step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    const Vec3 shift{static_cast<double>(step[0]), static_cast<double>(step[1]),
                     static_cast<double>(step[2])};
    const double share = difmesh::plane_fraction(normal, spacing, offset - dot(normal, shift));
    sum += std::pow(share - field.at(cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]), 2);
  }
  return sum;
}

/// Fractions of an ellipsoid in a grid of 16 x 15 x 14 unit cubes.
OwnedField ellipsoid(const Grid& grid) {
  const auto shape = difmesh::make_shape({.kind = difmesh::ShapeKind::ellipsoid,
                                          .centre = {8.1, 7.4, 6.9},
                                          .rotation_degrees = {11.0, 23.0, 37.0},
                                          .semi_axes = {6.0, 5.0, 4.0}});
  OwnedField field(grid.dims);
  const auto fractions = difmesh::fractions_from_shape(grid, shape).fractions;
  std::copy(fractions.begin(), fractions.end(), field.values.begin());
  return field;
}

/// Cells between this one and the nearest side.
std::int64_t margin(const Index3& cell, const Grid& grid) {
  std::int64_t least = cell[0];
  for (std::size_t a = 0; a < 3; ++a) {
    least = std::min({least, cell[a], grid.dims[a] - 1 - cell[a]});
  }
  return least;
}

/// Shallow, steep, along the axes and diagonal; later ones at random.
Vec3 normal_of(int number, Random& random) {
  const std::vector<Vec3> list{{0, 0, 1},  {0, -1, 0},   {1, 1, 0},    {0, 1, -1}, {1, 1, 1},
                               {-1, 1, 1}, {1, 1e-9, 0}, {2, 1, 1e-7}, {1, -2, 3}, {1, 1, 2}};
  return unit(number < static_cast<int>(list.size()) ? list[static_cast<std::size_t>(number)]
                                                     : random.direction());
}

}  // namespace

TEST_CASE("fitted normals: planes of any direction are exact") {
  const Grid grid{.dims = {14, 13, 12}, .origin = {2.0, -1.0, 0.5}, .spacing = {1.0, 1.5, 2.0}};
  const Vec3 middle = grid.cell_centre({7, 6, 6});
  Random random(23);
  std::size_t elvira_cells = 0;
  std::size_t lvira_cells = 0;
  for (int n = 0; n < kPlanes; ++n) {
    const Vec3 normal = normal_of(n, random);
    const OwnedField field =
        half_space(grid, normal, dot(normal, middle) + random.uniform(-3.0, 3.0));
    CAPTURE(n);
    Options options;
    options.normals = Normals::elvira;
    const Fitted elvira = fit(field, grid, options);
    options.normals = Normals::lvira;
    const Fitted lvira = fit(field, grid, options);
    for (std::size_t c = 0; c < elvira.cells.size(); ++c) {
      CHECK(elvira.planes[c].source == NormalSource::least_squares);
      // Two cells from the sides, where columns of five begin to be cut short.
      if (margin(elvira.cells[c], grid) >= 2) {
        REQUIRE(length(subtract(elvira.planes[c].plane.normal, normal)) < 1e-13);
        ++elvira_cells;
      }
      REQUIRE(length(subtract(lvira.planes[c].plane.normal, normal)) < 1e-11);
      ++lvira_cells;
    }
  }
  CHECK(elvira_cells > 80U * kPlanes);
  CHECK(lvira_cells > 160U * kPlanes);
}

TEST_CASE("fitted normals: surfaces of spheres are of second order") {
  for (const Normals normals : {Normals::elvira, Normals::lvira}) {
    std::vector<double> rms;
    for (const double radius : {8.0, 16.0, 32.0}) {
      const auto cells = static_cast<std::int64_t>(2.0 * radius) + 6;
      const double middle = 0.5 * static_cast<double>(cells);
      const Vec3 centre{middle + 0.13, middle - 0.27, middle + 0.41};
      const Grid grid{.dims = {cells, cells, cells}};
      const auto ball = difmesh::make_shape({.centre = centre, .radius = radius});
      const auto fractions = difmesh::fractions_from_shape(grid, ball).fractions;
      Options options;
      options.normals = normals;
      const auto mesh =
          difmesh::reconstruct(FieldView::x_fastest(fractions.data(), grid.dims), grid, options)
              .mesh;
      double sum = 0.0;
      for (const Vec3& p : mesh.positions) {
        sum += std::pow(length(subtract(p, centre)) - radius, 2);
      }
      rms.push_back(std::sqrt(sum / static_cast<double>(mesh.positions.size())) / radius);
    }
    CHECK(std::log2(rms[0] / rms[1]) > 1.95);
    CHECK(std::log2(rms[1] / rms[2]) > 1.95);
    CHECK(rms[2] * 32.0 < 3.3e-3);
  }
}

TEST_CASE("fitted normals: no turned plane suits the neighbours better than that of lvira") {
  const Grid grid{.dims = {16, 15, 14}};
  OwnedField field = ellipsoid(grid);
  Options options;
  options.normals = Normals::lvira;
  const Fitted fitted = fit(field, grid, options);
  std::size_t compared = 0;
  std::size_t stopped_early = 0;
  for (std::size_t c = 0; c < fitted.cells.size(); ++c) {
    const Index3& cell = fitted.cells[c];
    if (margin(cell, grid) == 0) {
      continue;
    }
    const double found = misfit(field, cell, fitted.planes[c].plane.normal);
    // The surroundings of the fitted normal in ever narrower circles.
    Vec3 best = fitted.planes[c].plane.normal;
    double least = found;
    for (double turn = 0.05; turn > 1e-4; turn *= 0.5) {
      const Vec3 first = unit(cross(best, std::abs(best[0]) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
      const Vec3 second = cross(best, first);
      const Vec3 from = best;
      for (int n = 0; n < 8; ++n) {
        const double angle = 0.25 * std::numbers::pi * n;
        const Vec3 normal = unit(add(from, add(scaled(first, turn * std::cos(angle)),
                                               scaled(second, turn * std::sin(angle)))));
        const double sum = misfit(field, cell, normal);
        if (sum < least) {
          least = sum;
          best = normal;
        }
      }
    }
    ++compared;
    stopped_early += found > least * 1.003 + 1e-12 ? 1U : 0U;
  }
  CHECK(compared > 200);
  // The search may end at a cell whose neighbours no plane suits.
  CHECK(stopped_early <= compared / 100);
}

TEST_CASE("fitted normals: the misfit is never above that of myc") {
  const Grid grid{.dims = {16, 15, 14}};
  OwnedField field = ellipsoid(grid);
  const auto misfits = [&](Normals normals) {
    Options options;
    options.normals = normals;
    const Fitted fitted = fit(field, grid, options);
    std::vector<double> sums;
    for (std::size_t c = 0; c < fitted.cells.size(); ++c) {
      const Index3& cell = fitted.cells[c];
      sums.push_back(margin(cell, grid) > 0 ? misfit(field, cell, fitted.planes[c].plane.normal)
                                            : 0.0);
    }
    return sums;
  };
  const std::vector<double> myc = misfits(Normals::myc);
  const std::vector<double> elvira = misfits(Normals::elvira);
  const std::vector<double> lvira = misfits(Normals::lvira);
  REQUIRE(myc.size() > 200);
  double total_myc = 0.0;
  double total_elvira = 0.0;
  double total_lvira = 0.0;
  for (std::size_t c = 0; c < myc.size(); ++c) {
    REQUIRE(elvira[c] <= myc[c] + 1e-12);
    REQUIRE(lvira[c] <= myc[c] * (1.0 + 1e-4) + 1e-12);
    total_myc += myc[c];
    total_elvira += elvira[c];
    total_lvira += lvira[c];
  }
  CHECK(total_elvira < 0.98 * total_myc);
  CHECK(total_lvira < 0.98 * total_elvira);
}

TEST_CASE(
    "fitted normals: films lone cells and noise keep their fractions on any number of threads") {
  const Grid grid{.dims = {17, 16, 15}};
  OwnedField film(grid.dims);
  for (std::int64_t k = 0; k < 15; ++k) {
    for (std::int64_t j = 0; j < 16; ++j) {
      for (std::int64_t i = 0; i < 17; ++i) {
        const double away =
            std::abs(static_cast<double>(k) - 7.2 - 0.3 * static_cast<double>(i - 8));
        film.at(i, j, k) = std::clamp(0.7 - away, 0.0, 1.0);
      }
    }
  }
  OwnedField lone(grid.dims);
  lone.at(8, 8, 8) = 0.4;
  for (const OwnedField& field :
       {film, lone, white_noise(grid.dims, 2), half_noise(grid.dims, 6)}) {
    for (const Normals normals : {Normals::elvira, Normals::lvira}) {
      Options options;
      options.normals = normals;
      options.boundary = {difmesh::Side::periodic, difmesh::Side::periodic, difmesh::Side::mirror,
                          difmesh::Side::open,     difmesh::Side::empty,    difmesh::Side::full};
      options.threads = 1;
      const Fitted one = fit(field, grid, options);
      for (std::size_t c = 0; c < one.cells.size(); ++c) {
        const auto& [plane, source] = one.planes[c];
        const Index3& cell = one.cells[c];
        const std::size_t at =
            static_cast<std::size_t>((cell[2] * grid.dims[1] + cell[1]) * grid.dims[0] + cell[0]);
        if (source == NormalSource::none) {
          REQUIRE(plane.normal == Vec3{0.0, 0.0, 0.0});
        } else {
          REQUIRE(length(plane.normal) == doctest::Approx(1.0).epsilon(1e-14));
          REQUIRE(std::abs(difmesh::plane_fraction(plane.normal, grid.spacing, plane.offset) -
                           field.values[at]) < 1e-13);
        }
      }
      for (const int threads : {2, 3}) {
        options.threads = threads;
        const Fitted other = fit(field, grid, options);
        for (std::size_t c = 0; c < one.cells.size(); ++c) {
          REQUIRE(other.planes[c].plane.normal == one.planes[c].plane.normal);
          REQUIRE(other.planes[c].plane.offset == one.planes[c].plane.offset);
        }
      }
    }
  }
}

TEST_CASE("fitted normals: mirrors continue planes that stand at right angles to them") {
  const Grid grid{.dims = {10, 9, 8}};
  const Vec3 normal = unit({0.0, 0.4, 1.0});
  const OwnedField field = half_space(grid, normal, 5.3);
  for (const Normals normals : {Normals::elvira, Normals::lvira}) {
    Options options;
    options.normals = normals;
    options.boundary[0] = options.boundary[1] = difmesh::Side::mirror;
    const Fitted fitted = fit(field, grid, options);
    std::size_t at_mirrors = 0;
    for (std::size_t c = 0; c < fitted.cells.size(); ++c) {
      const Index3& cell = fitted.cells[c];
      if (cell[1] >= 2 && cell[1] < 7 && cell[2] >= 2 && cell[2] < 6) {
        REQUIRE(length(subtract(fitted.planes[c].plane.normal, normal)) < 1e-11);
        at_mirrors += cell[0] == 0 || cell[0] == 9 ? 1U : 0U;
      }
    }
    CHECK(at_mirrors > 4);
  }
}

TEST_CASE("fitted normals: cells without a surface have the normal of myc") {
  OwnedField field = blob({20, 19, 18});
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  // Pure cells next to others, which give them a gradient.
  std::vector<Index3> cells;
  for (std::int64_t n = 0; n < grid.cell_count(); ++n) {
    const Index3 cell{n % 20, n / 20 % 19, n / 20 / 19};
    const double fraction = field.at(cell[0], cell[1], cell[2]);
    if (fraction == 0.0 || fraction == 1.0) {
      cells.push_back(cell);
    }
  }
  const auto planes_by = [&](Normals normals) {
    Options options;
    options.normals = normals;
    std::vector<CellPlane> planes(cells.size());
    difmesh::cell_planes(field.view(), grid, cells, options, planes);
    return planes;
  };
  const std::vector<CellPlane> myc = planes_by(Normals::myc);
  for (const Normals normals : {Normals::elvira, Normals::lvira}) {
    const std::vector<CellPlane> fitted = planes_by(normals);
    int with_normal[2] = {};
    for (std::size_t n = 0; n < cells.size(); ++n) {
      REQUIRE(fitted[n].source == myc[n].source);
      REQUIRE(fitted[n].plane.normal == myc[n].plane.normal);
      if (myc[n].source != NormalSource::none) {
        ++with_normal[static_cast<int>(field.at(cells[n][0], cells[n][1], cells[n][2]))];
      }
    }
    CHECK(with_normal[0] > 100);
    CHECK(with_normal[1] > 100);
  }
}
