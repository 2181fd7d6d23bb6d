// Curved surfaces of cells through the C interface: against spheres and against the core.

#include "difmesh/cell_surfaces.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "difmesh/cell_planes.hpp"
#include "handles.hpp"

namespace {

namespace test = difmesh::test;

using difmesh::CellSurface;
using difmesh::Index3;

constexpr double kRadius = 1.0;
constexpr double kSpacing = 0.1;
const Index3 kDims{26, 27, 28};

// A drop of ten cells per radius, or a bubble.
test::OwnedField sphere(bool is_bubble) {
  dif_grid grid = test::c_grid(
      {.dims = kDims, .origin = {-1.27, -1.34, -1.43}, .spacing = {kSpacing, kSpacing, kSpacing}});
  dif_shape* made = nullptr;
  REQUIRE(dif_shape_create(nullptr, &made) == DIF_OK);  // of radius 1 about 0
  const test::ShapeHandle shape(made);
  test::OwnedField field(kDims);
  REQUIRE(dif_fractions_from_shape(&grid, made, nullptr, nullptr, field.values.data()) == DIF_OK);
  if (is_bubble) {
    for (double& fraction : field.values) {
      fraction = 1.0 - fraction;
    }
  }
  return field;
}

dif_field placed(const test::OwnedField& values) {
  dif_field field = test::c_field(values);
  const double origin[3] = {-1.27, -1.34, -1.43};
  for (int axis = 0; axis < 3; ++axis) {
    field.origin[axis] = origin[axis];
    field.spacing[axis] = kSpacing;
  }
  return field;
}

std::vector<Index3> interfacial(const dif_field& field) {
  std::int64_t count = -1;
  REQUIRE(dif_interfacial_cells(&field, nullptr, 0, nullptr, &count) == DIF_OK);
  std::vector<Index3> cells(static_cast<std::size_t>(count));
  std::int64_t again = -1;
  REQUIRE(dif_interfacial_cells(&field, nullptr, count, cells.data()->data(), &again) == DIF_OK);
  CHECK(again == count);
  return cells;
}

bool is_interfacial(double fraction) {
  return fraction > 1e-6 && fraction < 1.0 - 1e-6;
}

bool same(double one, double other) {
  return one == other || (std::isnan(one) && std::isnan(other));
}

// What dif_cell_surfaces() gives, all of it.
struct Arrays {
  std::vector<std::int32_t> source, axis;
  std::vector<double> foot, normal, mean, gaussian, largest, smallest, residual, length, frame,
      coefficients;
  dif_surface_arrays c = test::prepared(dif_surface_arrays_init);

  explicit Arrays(std::size_t count) : source(count, -9), axis(count, -9) {
    c.source = source.data();
    c.axis = axis.data();
    const auto give = [count](std::vector<double>& array, double*& place, std::size_t each) {
      array.assign(each * count, -9.0);
      place = array.data();
    };
    give(foot, c.foot, 3);
    give(normal, c.normal, 3);
    give(mean, c.mean, 1);
    give(gaussian, c.gaussian, 1);
    give(largest, c.largest, 1);
    give(smallest, c.smallest, 1);
    give(residual, c.residual, 1);
    give(length, c.length, 1);
    give(frame, c.frame, 9);
    give(coefficients, c.coefficients, 25);
  }

  void compare(std::size_t n, const CellSurface& expected) const {
    REQUIRE(source[n] == static_cast<std::int32_t>(expected.source));
    REQUIRE(axis[n] == expected.axis);
    for (std::size_t m = 0; m < 3; ++m) {
      REQUIRE(foot[3 * n + m] == expected.foot[m]);
      REQUIRE(normal[3 * n + m] == expected.normal[m]);
      for (std::size_t p = 0; p < 3; ++p) {
        REQUIRE(frame[9 * n + 3 * m + p] == expected.frame[m][p]);
      }
    }
    REQUIRE(same(mean[n], expected.mean));
    REQUIRE(same(gaussian[n], expected.gaussian));
    REQUIRE(same(largest[n], expected.largest));
    REQUIRE(same(smallest[n], expected.smallest));
    REQUIRE(same(residual[n], expected.residual));
    REQUIRE(length[n] == expected.length);
    for (std::size_t m = 0; m < 25; ++m) {
      REQUIRE(coefficients[25 * n + m] == expected.coefficients[m]);
    }
  }
};

}  // namespace

TEST_CASE("interfacial cells are counted and listed as far as there is room") {
  const test::OwnedField values = sphere(false);
  const dif_field field = placed(values);
  const std::vector<Index3> cells = interfacial(field);
  std::size_t n = 0;
  for (std::int64_t k = 0; k < kDims[2]; ++k) {
    for (std::int64_t j = 0; j < kDims[1]; ++j) {
      for (std::int64_t i = 0; i < kDims[0]; ++i) {
        if (is_interfacial(values.at_cell({i, j, k}))) {
          REQUIRE(n < cells.size());
          REQUIRE(cells[n++] == Index3{i, j, k});
        }
      }
    }
  }
  CHECK(n == cells.size());

  std::vector<Index3> few(3, Index3{-9, -9, -9});
  std::int64_t count = -1;
  CHECK(dif_interfacial_cells(&field, nullptr, 2, few[0].data(), &count) ==
        DIF_ERROR_INVALID_ARGUMENT);
  CHECK(count == static_cast<std::int64_t>(cells.size()));
  CHECK(std::string(dif_last_message()).find("capacity is 2") != std::string::npos);
  CHECK(few == std::vector<Index3>{cells[0], cells[1], {-9, -9, -9}});
}

TEST_CASE("surfaces of cells are the core's") {
  const test::OwnedField values = test::blob(kDims);
  const dif_field field = placed(values);
  const difmesh::Grid grid{
      .dims = kDims, .origin = {-1.27, -1.34, -1.43}, .spacing = {kSpacing, kSpacing, kSpacing}};
  std::vector<Index3> cells = interfacial(field);
  cells.push_back({0, 0, 0});
  const auto count = static_cast<std::int64_t>(cells.size());
  for (const std::int32_t kind : {DIF_SURFACES_FOR_POSITION, DIF_SURFACES_FOR_CURVATURE}) {
    std::vector<CellSurface> expected(cells.size());
    difmesh::cell_surfaces(values.view(), grid, cells, static_cast<difmesh::CellSurfaceKind>(kind),
                           {}, expected);
    Arrays arrays(cells.size());
    REQUIRE(dif_cell_surfaces(&field, nullptr, kind, count, cells[0].data(), &arrays.c) == DIF_OK);
    for (std::size_t n = 0; n < cells.size(); ++n) {
      arrays.compare(n, expected[n]);
    }
    CHECK(arrays.source.back() == DIF_SURFACE_NONE);
  }
  const dif_surface_arrays none = test::prepared(dif_surface_arrays_init);
  CHECK(dif_cell_surfaces(&field, nullptr, 1, count, cells[0].data(), &none) == DIF_OK);
  CHECK(dif_cell_surfaces(&field, nullptr, 1, 0, nullptr, &none) == DIF_OK);
}

TEST_CASE("a bad cell anywhere in the list leaves the arrays alone") {
  const test::OwnedField values = test::blob({9, 8, 7});
  const dif_field field = test::c_field(values);
  std::vector<Index3> cells(70000, Index3{0, 0, 0});  // more than are computed at once
  cells.back()[1] = 8;
  const auto count = static_cast<std::int64_t>(cells.size());
  std::vector<double> mean(cells.size(), -9.0);
  dif_surface_arrays arrays = test::prepared(dif_surface_arrays_init);
  arrays.mean = mean.data();
  CHECK(dif_cell_surfaces(&field, nullptr, 1, count, cells[0].data(), &arrays) ==
        DIF_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(dif_last_message()).find("number 69999") != std::string::npos);
  CHECK(mean == std::vector<double>(cells.size(), -9.0));
  cells.back()[1] = 7;
  REQUIRE(dif_cell_surfaces(&field, nullptr, 1, count, cells[0].data(), &arrays) == DIF_OK);
  for (const double curvature : mean) {
    REQUIRE(curvature != -9.0);
  }
}

TEST_CASE("curvature of cells is that of the sphere, negative for bubbles") {
  for (const bool is_bubble : {false, true}) {
    const test::OwnedField values = sphere(is_bubble);
    const dif_field field = placed(values);
    const double expected = (is_bubble ? -1.0 : 1.0) / kRadius;
    std::vector<double> mean(values.values.size(), -9.0);
    REQUIRE(dif_cell_curvature(&field, nullptr, mean.data(), nullptr) == DIF_OK);
    std::size_t seen = 0;
    for (std::size_t n = 0; n < mean.size(); ++n) {
      if (is_interfacial(values.values[n])) {
        ++seen;
        REQUIRE(std::abs(mean[n] - expected) < 0.02 / kRadius);
      } else {
        REQUIRE(mean[n] == 0.0);
      }
    }
    CHECK(seen > 1000);

    const std::vector<Index3> cells = interfacial(field);
    Arrays arrays(cells.size());
    REQUIRE(dif_cell_surfaces(&field, nullptr, DIF_SURFACES_FOR_CURVATURE,
                              static_cast<std::int64_t>(cells.size()), cells[0].data(),
                              &arrays.c) == DIF_OK);
    for (std::size_t n = 0; n < cells.size(); ++n) {
      REQUIRE(std::abs(arrays.gaussian[n] - 1.0) < 0.04);
      const auto at =
          static_cast<std::size_t>((cells[n][2] * kDims[1] + cells[n][1]) * kDims[0] + cells[n][0]);
      REQUIRE(mean[at] == arrays.mean[n]);
    }
  }
}

TEST_CASE("curvature goes into arrays with ghost layers and z fastest, with progress") {
  const test::OwnedField values = sphere(false);
  const dif_field field = placed(values);
  std::vector<double> dense(values.values.size());
  REQUIRE(dif_cell_curvature(&field, nullptr, dense.data(), nullptr) == DIF_OK);
  const Index3 outer{kDims[0] + 2, kDims[1] + 2, kDims[2] + 2};
  const std::int64_t strides[3] = {outer[1] * outer[2], outer[2], 1};
  const std::int64_t first = strides[0] + strides[1] + strides[2];
  std::vector<double> mean(static_cast<std::size_t>(outer[0] * outer[1] * outer[2]), -9.0);
  dif_options options = test::prepared(dif_options_init);
  double last = 0.0;
  options.progress_user = &last;
  options.progress = [](void* user, double share) -> std::int32_t {
    double& before = *static_cast<double*>(user);
    const bool is_right = share >= before && share <= 1.0;
    before = share;
    return is_right ? 0 : 1;
  };
  REQUIRE(dif_cell_curvature(&field, &options, mean.data() + first, strides) == DIF_OK);
  CHECK(last == 1.0);
  std::size_t n = 0;
  std::vector<double> expected(mean.size(), -9.0);
  for (std::int64_t k = 0; k < kDims[2]; ++k) {
    for (std::int64_t j = 0; j < kDims[1]; ++j) {
      for (std::int64_t i = 0; i < kDims[0]; ++i) {
        expected[static_cast<std::size_t>(first + i * strides[0] + j * strides[1] + k)] =
            dense[n++];
      }
    }
  }
  CHECK(mean == expected);
}

TEST_CASE("cells without a surface get NaN, empty fields 0, and errors leave the array alone") {
  test::OwnedField values({7, 7, 7});
  dif_field field = test::c_field(values);
  std::vector<double> mean(343, -9.0);
  REQUIRE(dif_cell_curvature(&field, nullptr, mean.data(), nullptr) == DIF_OK);
  CHECK(mean == std::vector<double>(343, 0.0));
  std::int64_t count = -1;
  CHECK(dif_interfacial_cells(&field, nullptr, 0, nullptr, &count) == DIF_OK);
  CHECK(count == 0);

  values.at(3, 3, 3) = 0.5;  // a speck
  REQUIRE(dif_cell_curvature(&field, nullptr, mean.data(), nullptr) == DIF_OK);
  for (std::size_t n = 0; n < mean.size(); ++n) {
    REQUIRE((n == 171 ? std::isnan(mean[n]) : mean[n] == 0.0));
  }

  mean.assign(343, -9.0);
  values.at(6, 5, 4) = 7.0;
  CHECK(dif_cell_curvature(&field, nullptr, mean.data(), nullptr) == DIF_ERROR_INVALID_VALUE);
  CHECK(mean == std::vector<double>(343, -9.0));
}
