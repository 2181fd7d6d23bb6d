#include "difmesh/normals.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/reconstruct.hpp"
#include "support/fields.hpp"

namespace {

using difmesh::CellPlane;
using difmesh::ErrorCode;
using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::NormalSource;
using difmesh::Options;
namespace test = difmesh::test;

const Grid kGrid{.dims = {24, 21, 19}, .origin = {1.0, 2.0, 3.0}, .spacing = {0.5, 1.0, 2.0}};

std::vector<CellPlane> planes_of(const FieldView& field, const difmesh::Array<Index3>& cells,
                                 int threads) {
  Options options;
  options.threads = threads;
  std::vector<CellPlane> planes(cells.size());
  difmesh::cell_planes(field, kGrid, cells, options, planes);
  return planes;
}

}  // namespace

TEST_CASE("interfacial cells are those between the tolerances in the order z y x") {
  test::OwnedField field = test::blob(kGrid.dims);
  field.at(0, 0, 0) = 1e-6;      // the tolerance itself counts as empty
  field.at(1, 0, 0) = 1.1e-6;    // no longer
  field.at(2, 0, 0) = -0.05;     // clamped
  field.at(3, 0, 0) = 1 - 1e-7;  // full
  std::vector<Index3> expected;
  for (std::int64_t k = 0; k < kGrid.dims[2]; ++k) {
    for (std::int64_t j = 0; j < kGrid.dims[1]; ++j) {
      for (std::int64_t i = 0; i < kGrid.dims[0]; ++i) {
        const double fraction = field.at(i, j, k);
        if (fraction > 1e-6 && fraction < 1 - 1e-6) {
          expected.push_back({i, j, k});
        }
      }
    }
  }
  REQUIRE(expected.size() > 400);
  CHECK(expected.front() == Index3{1, 0, 0});
  const auto cells = difmesh::interfacial_cells(field.view(), kGrid);
  CHECK(std::vector<Index3>(cells.begin(), cells.end()) == expected);
  const auto report = difmesh::reconstruct(field.view(), kGrid).report;
  CHECK(report.interfacial_cells == static_cast<std::int64_t>(expected.size()));

  field.at(5, 6, 7) = std::numeric_limits<double>::quiet_NaN();
  try {
    static_cast<void>(difmesh::interfacial_cells(field.view(), kGrid));
    FAIL("NaN was accepted");
  } catch (const difmesh::Error& error) {
    CHECK(error.code() == ErrorCode::invalid_value);
    CHECK(std::string(error.what()).find("(5, 6, 7)") != std::string::npos);
  }
}

TEST_CASE("planes of cells cut off the cells' fractions whatever the number of threads") {
  const test::OwnedField field = test::white_noise(kGrid.dims, 5);
  const auto cells = difmesh::interfacial_cells(field.view(), kGrid);
  REQUIRE(cells.size() > 9000);
  const std::vector<CellPlane> planes = planes_of(field.view(), cells, 1);
  std::size_t with_normal = 0;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const auto& [plane, source] = planes[n];
    if (source == NormalSource::none) {
      continue;
    }
    ++with_normal;
    REQUIRE(std::hypot(plane.normal[0], plane.normal[1], plane.normal[2]) ==
            doctest::Approx(1.0).epsilon(1e-14));
    const std::size_t at = static_cast<std::size_t>(
        (cells[n][2] * kGrid.dims[1] + cells[n][1]) * kGrid.dims[0] + cells[n][0]);
    const double share = difmesh::plane_fraction(plane.normal, kGrid.spacing, plane.offset);
    REQUIRE(std::abs(share - field.values[at]) < 1e-13);
  }
  CHECK(with_normal == cells.size());
  for (const int threads : {2, 3, 0}) {
    const std::vector<CellPlane> again = planes_of(field.view(), cells, threads);
    for (std::size_t n = 0; n < cells.size(); ++n) {
      REQUIRE(again[n].plane.normal == planes[n].plane.normal);
      REQUIRE(again[n].plane.offset == planes[n].plane.offset);
      REQUIRE(again[n].source == planes[n].source);
    }
  }
}

TEST_CASE("cell planes can be cancelled and name a cell outside the grid") {
  const test::OwnedField field = test::white_noise(kGrid.dims, 5);
  const auto cells = difmesh::interfacial_cells(field.view(), kGrid);
  std::vector<CellPlane> planes(cells.size());
  Options options;
  int calls = 0;
  double last = 0.0;
  options.progress = [&](double share) {
    CHECK(share >= last);
    last = share;
    return ++calls < 3;
  };
  try {
    difmesh::cell_planes(field.view(), kGrid, cells, options, planes);
    FAIL("went on");
  } catch (const difmesh::Error& error) {
    CHECK(error.code() == ErrorCode::cancelled);
    CHECK(calls == 3);
  }
  const std::vector<Index3> outside{{0, 0, 0}, {0, 21, 0}};
  std::vector<CellPlane> two(2);
  try {
    difmesh::cell_planes(field.view(), kGrid, outside, {}, two);
    FAIL("accepted");
  } catch (const difmesh::Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(std::string(error.what()).find("number 1 of the list, (0, 21, 0)") != std::string::npos);
  }
}
