// Curved surfaces of cells against closed forms, figures in print, and themselves turned about.

#include "difmesh/cell_surfaces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "difmesh/cell_planes.hpp"
#include "difmesh/shapes.hpp"
#include "support/errors.hpp"
#include "support/fields.hpp"
#include "support/grids.hpp"
#include "support/shape_fields.hpp"

using namespace difmesh;
using namespace difmesh::test;

namespace {

struct CellsOf {
  Array<Index3> cells;
  std::vector<CellSurface> surfaces;
};

CellsOf surfaces_of(const FieldView& field, const Grid& grid, CellSurfaceKind kind,
                    const Options& options = {}) {
  CellsOf result;
  result.cells = interfacial_cells(field, grid, options);
  result.surfaces.resize(result.cells.size());
  cell_surfaces(field, grid, result.cells, kind, options, result.surfaces);
  return result;
}

OwnedField fractions(const Grid& grid, const Shape& shape) {
  return fractions_of(grid, shape, 1e-11);
}

struct Errors : ErrorSums {
  std::size_t without = 0;
};

// Of radius times mean curvature on spheres about random points of the middle cell.
Errors curvature_errors(double radius, int centres) {
  Errors errors;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> within(-0.5, 0.5);
  for (int n = 0; n < centres; ++n) {
    const auto cells = static_cast<std::int64_t>(2.0 * radius) + 17;
    const Grid grid{{cells, cells, cells}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    const double middle = 0.5 * static_cast<double>(cells);
    const Vec3 centre{middle + within(random), middle + within(random), middle + within(random)};
    const OwnedField field = fractions(grid, ball(centre, radius));
    for (const CellSurface& surface :
         surfaces_of(field.view(), grid, CellSurfaceKind::curvature).surfaces) {
      if (surface.source == CellSurfaceSource::none) {
        ++errors.without;
      } else {
        errors.add(surface.mean * radius - 1.0);
      }
    }
  }
  return errors;
}

struct Seen {
  std::size_t with = 0;
  std::size_t without = 0;
};

void check_plane(const OwnedField& field, const Grid& grid, const TiltedPlane& plane,
                 CellSurfaceKind kind, double tolerance, Seen& seen) {
  Options options;
  options.threads = 1;
  const CellsOf all = surfaces_of(field.view(), grid, kind, options);
  for (std::size_t n = 0; n < all.cells.size(); ++n) {
    const CellSurface& surface = all.surfaces[n];
    const double fraction = field.at_cell(all.cells[n]);
    if (fraction < 1e-4 || fraction > 1.0 - 1e-4) {
      continue;  // a sliver tells its plane to fewer digits
    }
    if (surface.source == CellSurfaceSource::none) {
      ++seen.without;
      continue;
    }
    ++seen.with;
    Vec3 at = grid.cell_centre(all.cells[n]);
    double turned = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] += surface.foot[axis];
      turned = std::max(turned, std::abs(surface.normal[axis] - plane.normal[axis]));
    }
    CHECK(std::abs(dot(plane.normal, at) - plane.offset) < tolerance * surface.length);
    CHECK(turned < tolerance);
    CHECK(std::abs(surface.mean) * surface.length < 10.0 * tolerance);
    CHECK(surface.residual < 1e-6);  // before the last step of a fit
  }
}

}  // namespace

TEST_CASE("cell surfaces: curvature of spheres is below what is in print for height functions") {
  // Basilisk's test of curvatures in three dimensions: rms and largest relative error by cells per
  // radius.
  struct Printed {
    double radius;
    int centres;
    double rms;
    double most;
  };
  for (const Printed& printed : {Printed{7.68, 4, 2.7e-2, 0.144}, Printed{12.8, 2, 8.7e-3, 0.115},
                                 Printed{15.4, 2, 4.3e-3, 0.071}, Printed{25.6, 1, 1.0e-3, 0.014},
                                 Printed{44.2, 1, 3.2e-4, 3.3e-3}}) {
    const Errors errors = curvature_errors(printed.radius, printed.centres);
    MESSAGE("R " << printed.radius << ": rms " << errors.rms() << ", largest " << errors.most);
    CHECK(errors.without == 0);
    CHECK(errors.rms() < printed.rms);
    CHECK(errors.most < printed.most);
  }
}

TEST_CASE("cell surfaces: planes are exact up to open sides") {
  std::mt19937_64 random(5);
  const Grid cubes{{9, 10, 8}, {-4.0, 2.0, 1.0}, {1.0, 1.0, 1.0}};
  const Grid flat{{9, 8, 10}, {0.0, 0.0, 0.0}, {1.0, 2.0, 5.0}};
  const Grid stretched = grid_of(growing(9, 1.0, 1.2, -3.0), growing(10, 5.0, 1.0 / 1.2, 7.0),
                                 growing(8, 0.7, 1.2, 0.1));
  Seen seen;
  for (int n = 0; n < 25; ++n) {
    for (const Grid& grid : {cubes, flat, stretched}) {
      TiltedPlane plane{random_direction(random), 0.0};
      plane.offset = dot(plane.normal, grid.cell_centre({4, 4, 4})) + 0.0123;
      const OwnedField field = plane.fractions(grid);
      CAPTURE(n);
      CAPTURE(grid.spacing[2]);
      check_plane(field, grid, plane, CellSurfaceKind::position, 1e-11, seen);
    }
  }
  CHECK(seen.with > 3000);
  CHECK(seen.without == 0);
}

TEST_CASE("cell surfaces: planes along axes, diagonals and at great aspect ratios are exact") {
  Seen seen;
  const double s2 = std::sqrt(0.5);
  const double s3 = std::sqrt(1.0 / 3.0);
  for (const Vec3& spacing : {Vec3{1.0, 1.0, 1.0}, Vec3{1.0, 1.0, 1000.0}}) {
    const Grid grid{{11, 11, 11}, {0.0, 0.0, 0.0}, spacing};
    for (const Vec3& normal : {Vec3{0.0, 0.0, 1.0}, Vec3{-1.0, 0.0, 0.0}, Vec3{s2, s2, 0.0},
                               Vec3{0.0, -s2, s2}, Vec3{s3, -s3, s3}}) {
      TiltedPlane plane{normal, 0.0};
      plane.offset = dot(normal, grid.cell_centre({5, 5, 5})) + 0.3;
      const OwnedField field = plane.fractions(grid);
      CAPTURE(normal[0]);
      CAPTURE(spacing[2]);
      check_plane(field, grid, plane, CellSurfaceKind::position, 1e-9, seen);
    }
    // Along open sides, where cells a thousand times as long as wide lie aslant, the point of the
    // plane next to a cell may be many cells away.
    CHECK(seen.without <= (spacing[2] == 1.0 ? 0 : seen.with / 10));
  }
  CHECK(seen.with > 500);
}

TEST_CASE("cell surfaces: a torus has its curvatures") {
  const Grid grid{{48, 48, 48}, {-1.2, -1.2, -1.2}, {0.05, 0.05, 0.05}};
  ShapeOptions options;
  options.kind = shape_kind("torus");
  options.radius = 0.8;
  options.tube_radius = 0.35;
  const Shape torus = make_shape(options);
  const OwnedField field = fractions(grid, torus);
  Errors mean;
  Errors gaussian;
  const CellsOf all = surfaces_of(field.view(), grid, CellSurfaceKind::curvature);
  for (std::size_t n = 0; n < all.cells.size(); ++n) {
    const CellSurface& surface = all.surfaces[n];
    if (surface.source == CellSurfaceSource::none) {
      continue;
    }
    const Vec3 at = grid.cell_centre(all.cells[n]);
    // About the axis of z: the angle round the tube gives both curvatures.
    const double out = std::hypot(at[0] + surface.foot[0], at[1] + surface.foot[1]);
    const double cosine = (out - 0.8) / 0.35;
    const double round = cosine / (0.8 + 0.35 * cosine);
    mean.add(surface.mean - 0.5 * (1.0 / 0.35 + round));
    gaussian.add(surface.gaussian - round / 0.35);
    CHECK(surface.largest >= surface.smallest);
    CHECK(surface.largest + surface.smallest == doctest::Approx(2.0 * surface.mean));
  }
  REQUIRE(mean.count > 5000);
  MESSAGE("torus: mean " << mean.rms() << " / " << mean.most << ", Gaussian " << gaussian.rms()
                         << " / " << gaussian.most);
  CHECK(mean.rms() < 0.02);
  CHECK(gaussian.rms() < 0.03);
}

TEST_CASE("cell surfaces: long cells have the curvature of the body, not of the fit") {
  for (const Vec3& spacing : {Vec3{0.1, 0.5, 0.5}, Vec3{0.5, 0.5, 0.1}, Vec3{0.1, 0.2, 0.5}}) {
    Grid grid;
    grid.spacing = spacing;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      grid.dims[axis] = static_cast<std::int64_t>(10.0 / spacing[axis]) + 8;
      grid.origin[axis] = -0.5 * static_cast<double>(grid.dims[axis]) * spacing[axis] + 0.013;
    }
    const OwnedField field = fractions(grid, ball({0.0, 0.0, 0.0}, 5.0));
    Errors errors;
    for (const CellSurface& surface :
         surfaces_of(field.view(), grid, CellSurfaceKind::curvature).surfaces) {
      if (surface.source != CellSurfaceSource::none) {
        errors.add(5.0 * surface.mean - 1.0);
      }
    }
    MESSAGE("long cells: " << errors.rms() << " / " << errors.most);
    CHECK(errors.count > 2000);
    CHECK(errors.rms() < 0.02);
    CHECK(errors.most < 0.3);
  }
}

TEST_CASE("cell surfaces: a bubble curves the other way") {
  const Grid grid{{24, 24, 24}, {-1.2, -1.2, -1.2}, {0.1, 0.1, 0.1}};
  OwnedField field = fractions(grid, ball({0.013, 0.02, -0.031}, 0.9));
  const CellsOf drop = surfaces_of(field.view(), grid, CellSurfaceKind::curvature);
  for (double& value : field.values) {
    value = 1.0 - value;
  }
  const CellsOf bubble = surfaces_of(field.view(), grid, CellSurfaceKind::curvature);
  REQUIRE(drop.cells.size() == bubble.cells.size());
  std::size_t same = 0;
  for (std::size_t n = 0; n < drop.cells.size(); ++n) {
    REQUIRE(drop.cells[n] == bubble.cells[n]);
    const CellSurface& a = drop.surfaces[n];
    const CellSurface& b = bubble.surfaces[n];
    REQUIRE(a.source == b.source);
    CHECK(a.mean == doctest::Approx(-b.mean).epsilon(1e-6));
    CHECK(a.gaussian == doctest::Approx(b.gaussian).epsilon(1e-6));
    CHECK(dot(a.normal, b.normal) == doctest::Approx(-1.0).epsilon(1e-9));
    ++same;
  }
  CHECK(same > 1000);
}

namespace {

// A turn of the cube: axis t of the result is axis order[t] of the source, from its other end where
// flipped.
struct Turn {
  std::array<std::size_t, 3> order;
  std::array<bool, 3> flipped;

  [[nodiscard]] Index3 source_of(const Index3& cell, const Index3& dims) const {
    Index3 source{0, 0, 0};
    for (std::size_t t = 0; t < 3; ++t) {
      source[order[t]] = flipped[t] ? dims[t] - 1 - cell[t] : cell[t];
    }
    return source;
  }
  [[nodiscard]] Vec3 turned(const Vec3& vector) const {
    Vec3 result;
    for (std::size_t t = 0; t < 3; ++t) {
      result[t] = flipped[t] ? -vector[order[t]] : vector[order[t]];
    }
    return result;
  }
};

// Some of the turns only: each takes a quarter of a second, and ten times that with sanitizers.
#ifdef DIFMESH_SANITIZED
constexpr std::size_t kTurnStep = 17;
#else
constexpr std::size_t kTurnStep = 5;
#endif

std::vector<Turn> all_turns() {
  std::vector<Turn> turns;
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    for (unsigned bits = 0; bits < 8; ++bits) {
      turns.push_back({order, {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0}});
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return turns;
}

bool same_bits(const std::vector<CellSurface>& a, const std::vector<CellSurface>& b) {
  if (a.size() != b.size()) {
    return false;
  }
  for (std::size_t n = 0; n < a.size(); ++n) {
    const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    if (a[n].source != b[n].source || !same(a[n].mean, b[n].mean) ||
        !same(a[n].gaussian, b[n].gaussian) || !same(a[n].foot[0], b[n].foot[0]) ||
        !same(a[n].normal[2], b[n].normal[2]) || a[n].coefficients != b[n].coefficients) {
      return false;
    }
  }
  return true;
}

double difference_of(const CellSurface& a, const CellSurface& b) {
  if (a.source == CellSurfaceSource::none || a.source != b.source) {
    return a.source == b.source ? 0.0 : 1.0;
  }
  double most = std::abs(a.mean - b.mean);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    most = std::max(
        {most, std::abs(a.foot[axis] - b.foot[axis]), std::abs(a.normal[axis] - b.normal[axis])});
  }
  return most;
}

}  // namespace

TEST_CASE("cell surfaces: turned and mirrored fields have turned surfaces") {
  // About the grid's centre, so that normals tie, and beside it.
  for (const Vec3& centre : {Vec3{0.0, 0.0, 0.0}, Vec3{0.017, -0.031, 0.023}}) {
    const Grid grid{{20, 20, 20}, {-1.0, -1.0, -1.0}, {0.1, 0.1, 0.1}};
    const OwnedField field = fractions(grid, ball(centre, 0.77));
    for (const CellSurfaceKind kind : {CellSurfaceKind::position, CellSurfaceKind::curvature}) {
      const CellsOf all = surfaces_of(field.view(), grid, kind);
      double most = 0.0;
      const std::vector<Turn> turns = all_turns();
      for (std::size_t number = 0; number < turns.size(); number += kTurnStep) {
        const Turn& turn = turns[number];
        OwnedField turned(field.dims);
        std::vector<CellSurface> expected;
        CellsOf result;
        for_each_cell(grid, [&](const Index3& cell) {
          turned.at(cell[0], cell[1], cell[2]) = field.at_cell(turn.source_of(cell, grid.dims));
        });
        result = surfaces_of(turned.view(), grid, kind);
        REQUIRE(result.cells.size() == all.cells.size());
        for (std::size_t n = 0; n < result.cells.size(); n += 7) {
          const Index3 source = turn.source_of(result.cells[n], grid.dims);
          const auto at = std::lower_bound(
              all.cells.begin(), all.cells.end(), source, [](const Index3& a, const Index3& b) {
                return std::array{a[2], a[1], a[0]} < std::array{b[2], b[1], b[0]};
              });
          CellSurface whole = all.surfaces[static_cast<std::size_t>(at - all.cells.begin())];
          whole.foot = turn.turned(whole.foot);
          whole.normal = turn.turned(whole.normal);
          most = std::max(most, difference_of(whole, result.surfaces[n]));
        }
      }
      CHECK(most < 1e-8);
    }
  }
}

TEST_CASE("cell surfaces: beyond mirrors and periodic sides is what stands there") {
  const Grid whole{{24, 24, 24}, {-1.2, -1.2, -1.2}, {0.1, 0.1, 0.1}};
  const OwnedField field = fractions(whole, ball({0.0, 0.0, 0.0}, 0.83));
  const CellsOf all = surfaces_of(field.view(), whole, CellSurfaceKind::curvature);
  const auto whole_at = [&](const Index3& cell) {
    const auto found = std::find(all.cells.begin(), all.cells.end(), cell);
    REQUIRE(found != all.cells.end());
    return all.surfaces[static_cast<std::size_t>(found - all.cells.begin())];
  };
  SUBCASE("an eighth behind three mirrors") {
    const Grid eighth{{12, 12, 12}, {0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}};
    OwnedField part(eighth.dims);
    for_each_cell(eighth, [&](const Index3& cell) {
      part.at(cell[0], cell[1], cell[2]) =
          field.at_cell({cell[0] + 12, cell[1] + 12, cell[2] + 12});
    });
    Options options;
    options.boundary = {Side::mirror, Side::empty,  Side::mirror,
                        Side::open,   Side::mirror, Side::open};
    const CellsOf some = surfaces_of(part.view(), eighth, CellSurfaceKind::curvature, options);
    for (std::size_t n = 0; n < some.cells.size(); n += 3) {
      const Index3& cell = some.cells[n];
      CHECK(difference_of(whole_at({cell[0] + 12, cell[1] + 12, cell[2] + 12}), some.surfaces[n]) <
            1e-11);
    }
  }
  SUBCASE("shifted through periodic sides") {
    OwnedField shifted(whole.dims);
    for_each_cell(whole, [&](const Index3& cell) {
      shifted.at((cell[0] + 12) % 24, (cell[1] + 3) % 24, cell[2]) = field.at_cell(cell);
    });
    Options options;
    options.boundary = {Side::periodic, Side::periodic, Side::periodic,
                        Side::periodic, Side::full,     Side::full};
    const CellsOf some = surfaces_of(shifted.view(), whole, CellSurfaceKind::curvature, options);
    CHECK(some.cells.size() == all.cells.size());
    for (std::size_t n = 0; n < some.cells.size(); n += 5) {
      const Index3& cell = some.cells[n];
      // Full beyond z is far away.
      CHECK(difference_of(whole_at({(cell[0] + 12) % 24, (cell[1] + 21) % 24, cell[2]}),
                          some.surfaces[n]) < 1e-12);
    }
  }
}

TEST_CASE("cell surfaces: threads and element types change no bit") {
  const Grid grid{{24, 22, 20}, {-1.2, -1.1, -1.0}, {0.1, 0.1, 0.1}};
  OwnedField field = fractions(grid, ball({0.0, 0.05, 0.0}, 0.9));
  std::vector<float> narrow(field.values.begin(), field.values.end());
  std::copy(narrow.begin(), narrow.end(), field.values.begin());  // values that both hold
  Options options;
  options.threads = 1;
  const CellsOf one = surfaces_of(field.view(), grid, CellSurfaceKind::position, options);
  options.threads = 3;
  const CellsOf three = surfaces_of(field.view(), grid, CellSurfaceKind::position, options);
  CHECK(same_bits(one.surfaces, three.surfaces));
  const CellsOf floats = surfaces_of(FieldView::x_fastest(narrow.data(), grid.dims), grid,
                                     CellSurfaceKind::position, options);
  CHECK(same_bits(one.surfaces, floats.surfaces));
}

TEST_CASE("cell surfaces: a table that is uniform, and units, change nothing but the unit") {
  const Grid grid{{20, 20, 20}, {-1.0, -1.0, -1.0}, {0.1, 0.1, 0.1}};
  const OwnedField field = fractions(grid, ball({0.01, 0.02, 0.0}, 0.8));
  const CellsOf all = surfaces_of(field.view(), grid, CellSurfaceKind::curvature);
  Grid large = grid;
  large.spacing = {0.1 * 1024.0, 0.1 * 1024.0, 0.1 * 1024.0};
  const CellsOf scaled = surfaces_of(field.view(), large, CellSurfaceKind::curvature);
  REQUIRE(scaled.surfaces.size() == all.surfaces.size());
  for (std::size_t n = 0; n < all.surfaces.size(); ++n) {
    CHECK(scaled.surfaces[n].mean * 1024.0 == doctest::Approx(all.surfaces[n].mean).epsilon(1e-12));
  }
  // Nearly uniform, so that the general code runs: within what the table's last digits do.
  Grid stretched = grid;
  for (std::int64_t n = 0; n <= 20; ++n) {
    stretched.faces[1].push_back(-1.0 + 0.1 * static_cast<double>(n) + (n == 7 ? 1e-11 : 0.0));
  }
  const CellsOf table = surfaces_of(field.view(), stretched, CellSurfaceKind::curvature);
  REQUIRE(table.surfaces.size() == all.surfaces.size());
  double most = 0.0;
  for (std::size_t n = 0; n < all.surfaces.size(); ++n) {
    most = std::max(most, difference_of(table.surfaces[n], all.surfaces[n]));
  }
  CHECK(most < 1e-6);
}

TEST_CASE("cell surfaces: graphs are the surface that foot and curvature tell") {
  const Grid grid{{20, 20, 20}, {-1.0, -1.0, -1.0}, {0.1, 0.1, 0.1}};
  const OwnedField field = fractions(grid, ball({0.01, 0.02, 0.0}, 0.8));
  for (const CellSurface& surface :
       surfaces_of(field.view(), grid, CellSurfaceKind::curvature).surfaces) {
    if (surface.source == CellSurfaceSource::none) {
      continue;
    }
    const auto q = [&](double xi, double eta) {
      double sum = 0.0;
      for (std::size_t p = 0; p < 5; ++p) {
        for (std::size_t r = 0; r < 5; ++r) {
          sum += surface.coefficients[5 * p + r] * std::pow(xi, static_cast<double>(p)) *
                 std::pow(eta, static_cast<double>(r));
        }
      }
      return sum;
    };
    const double xi = dot(surface.frame[0], surface.foot) / surface.length;
    const double eta = dot(surface.frame[1], surface.foot) / surface.length;
    const double zeta = dot(surface.frame[2], surface.foot) / surface.length;
    CHECK(zeta == doctest::Approx(q(xi, eta)).epsilon(1e-4));
    // Curvature of a graph from differences.
    const double h = 1e-3;
    const double px = (q(xi + h, eta) - q(xi - h, eta)) / (2.0 * h);
    const double py = (q(xi, eta + h) - q(xi, eta - h)) / (2.0 * h);
    const double pxx = (q(xi + h, eta) - 2.0 * q(xi, eta) + q(xi - h, eta)) / (h * h);
    const double pyy = (q(xi, eta + h) - 2.0 * q(xi, eta) + q(xi, eta - h)) / (h * h);
    const double pxy =
        (q(xi + h, eta + h) - q(xi + h, eta - h) - q(xi - h, eta + h) + q(xi - h, eta - h)) /
        (4.0 * h * h);
    const double w = 1.0 + px * px + py * py;
    const double mean = -((1.0 + py * py) * pxx - 2.0 * px * py * pxy + (1.0 + px * px) * pyy) /
                        (2.0 * w * std::sqrt(w));
    CHECK(surface.mean * surface.length == doctest::Approx(mean).epsilon(1e-4));
  }
}

TEST_CASE("cell surfaces: any field gives finite numbers or none") {
  const auto check_finite = [](const CellsOf& all) {
    for (const CellSurface& surface : all.surfaces) {
      if (surface.source == CellSurfaceSource::none) {
        CHECK(std::isnan(surface.mean));
        CHECK(surface.normal == Vec3{0.0, 0.0, 0.0});
      } else {
        CHECK(std::isfinite(surface.mean));
        CHECK(std::isfinite(surface.gaussian));
        CHECK(std::isfinite(surface.foot[0] + surface.foot[1] + surface.foot[2]));
        CHECK(length(surface.normal) == doctest::Approx(1.0));
        CHECK(surface.residual <= 0.03);
      }
    }
  };
  for (const CellSurfaceKind kind : {CellSurfaceKind::position, CellSurfaceKind::curvature}) {
    for (const Index3& dims :
         {Index3{8, 9, 7}, Index3{1, 9, 8}, Index3{1, 1, 6}, Index3{1, 1, 1}, Index3{2, 2, 2}}) {
      const Grid grid{dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1000.0}};
      for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full}) {
        Options options;
        options.boundary.fill(side);
        check_finite(surfaces_of(white_noise(dims, 3).view(), grid, kind, options));
        check_finite(surfaces_of(half_noise(dims, 4).view(), grid, kind, options));
        check_finite(surfaces_of(OwnedField(dims, 0.5).view(), grid, kind, options));
      }
    }
  }
  OwnedField holed = white_noise({8, 8, 8}, 7);
  const Grid grid{holed.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const Array<Index3> cells = interfacial_cells(holed.view(), grid);
  holed.at(4, 4, 4) = std::numeric_limits<double>::quiet_NaN();
  CellsOf all{cells, std::vector<CellSurface>(cells.size())};
  cell_surfaces(holed.view(), grid, all.cells, CellSurfaceKind::curvature, {}, all.surfaces);
  check_finite(all);
}

TEST_CASE("cell surfaces: bad calls are named") {
  const OwnedField field = white_noise({4, 4, 4}, 1);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  std::vector<CellSurface> room(1);
  const std::vector<Index3> outside{{0, 4, 0}};
  const auto call = [&](const std::vector<Index3>& cells, CellSurfaceKind kind) {
    return error_of([&] { cell_surfaces(field.view(), grid, cells, kind, {}, room); });
  };
  CHECK(call(outside, CellSurfaceKind::position) ==
        "cell_surfaces: cell number 0 of the list, (0, 4, 0), is outside the grid");
  CHECK(call({{0, 0, 0}, {0, 0, 1}}, CellSurfaceKind::position) ==
        "cell_surfaces: 2 cells but room for 1 surfaces");
  CHECK(call({{0, 0, 0}}, static_cast<CellSurfaceKind>(2)) == "cell_surfaces: unknown kind");
}
