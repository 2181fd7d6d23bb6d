#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/cell_planes.hpp"
#include "difmesh/error.hpp"
#include "difmesh/reconstruct.hpp"
#include "support/fields.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::CellPlane;
using difmesh::ErrorCode;
using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::NormalSource;
using difmesh::Options;
using difmesh::Vec3;
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

/// MYC in a field of 3x3x3 cubes, written down from Aulisa et al. (2007), section 2: of the centred
/// differences of columns along the three axes the one whose own component is largest, unless
/// Youngs' gradient has a smaller largest component.
struct PublishedMyc {
  Vec3 normal{0.0, 0.0, 0.0};  ///< Σ|component| = 1
  double clearance = 1.0;      ///< how far the decisions are from turning

  explicit PublishedMyc(test::OwnedField& field) {
    const Vec3 youngs = gradient(field);
    const double youngs_largest = largest(youngs);
    std::vector<std::pair<double, Vec3>> candidates;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vec3 candidate = of_columns(field, axis);
      candidates.emplace_back(std::abs(candidate[axis]), candidate);
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const auto& a, const auto& b) { return a.first > b.first; });
    normal = candidates[0].first > youngs_largest ? youngs : candidates[0].second;
    clearance = std::min(candidates[0].first - candidates[1].first,
                         std::abs(candidates[0].first - youngs_largest));
  }

 private:
  static double largest(const Vec3& v) {
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  }
  static Vec3 to_unit_sum(const Vec3& v) {
    return test::scaled(v, 1.0 / (std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2])));
  }
  static double fraction(test::OwnedField& field, const Index3& step) {
    return field.at(1 + step[0], 1 + step[1], 1 + step[2]);
  }
  static Vec3 gradient(test::OwnedField& field) {
    Vec3 sum{0.0, 0.0, 0.0};
    for (std::int64_t n = 0; n < 27; ++n) {
      const Index3 step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      const std::int64_t away = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // In its layer 4 for the cell in the middle, 2 at the edges, 1 at the corners.
        const double weight = std::exp2(static_cast<double>(3 - away));
        sum[axis] -= weight * static_cast<double>(step[axis]) * fraction(field, step);
      }
    }
    return to_unit_sum(sum);
  }
  static Vec3 of_columns(test::OwnedField& field, std::size_t axis) {
    Vec3 m{0.0, 0.0, 0.0};
    double lower_minus_upper = 0.0;
    for (std::int64_t n = 0; n < 27; ++n) {
      const Index3 step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      lower_minus_upper -= static_cast<double>(step[axis]) * fraction(field, step);
      for (const std::size_t other : {(axis + 1) % 3, (axis + 2) % 3}) {
        if (step[3 - axis - other] == 0) {
          m[other] -= 0.5 * static_cast<double>(step[other]) * fraction(field, step);
        }
      }
    }
    m[axis] = lower_minus_upper > 0.0 ? 1.0 : -1.0;
    return to_unit_sum(m);
  }
};

/// The nine columns about a cell along the axis that a normal points along, each read as a word of
/// its cells from the material's end on: a full, b interfacial, c empty.
struct WordsOfColumns {
  bool all_consistent = true;
  Vec3 normal{0.0, 0.0, 0.0};  ///< from the sums of the columns

  WordsOfColumns(test::OwnedField& field, const Index3& cell, const Vec3& towards) {
    std::size_t axis = 0;
    for (std::size_t t = 1; t < 3; ++t) {
      axis = std::abs(towards[t]) > std::abs(towards[axis]) ? t : axis;
    }
    const std::int64_t outward = towards[axis] > 0.0 ? 1 : -1;
    double height[3][3] = {};
    for (std::int64_t n = 0; n < 9; ++n) {
      std::string word;
      for (std::int64_t step = -4; step <= 4; ++step) {
        Index3 at = cell;
        at[axis] += outward * step;
        at[(axis + 1) % 3] += n % 3 - 1;
        at[(axis + 2) % 3] += n / 3 - 1;
        const double fraction = field.at(at[0], at[1], at[2]);
        height[n % 3][n / 3] += fraction;
        word += fraction >= 1 - 1e-6 ? 'a' : (fraction <= 1e-6 ? 'c' : 'b');
      }
      all_consistent = all_consistent && word.front() == 'a' && word.back() == 'c' &&
                       std::is_sorted(word.begin(), word.end());
    }
    normal[axis] = static_cast<double>(outward);
    normal[(axis + 1) % 3] = (height[0][1] - height[2][1]) / 2;
    normal[(axis + 2) % 3] = (height[1][0] - height[1][2]) / 2;
    normal = test::scaled(normal, 1.0 / std::hypot(normal[0], normal[1], normal[2]));
  }
};

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

TEST_CASE("myc is as published where candidates nearly tie and where the fractions hardly vary") {
  const Grid grid{.dims = {3, 3, 3}};
  const std::vector<Index3> middle{{1, 1, 1}};
  Options options;
  options.normals = difmesh::Normals::myc;
  std::size_t near_ties = 0;
  std::size_t compared = 0;
  for (const double disturbance : {1.0, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9}) {
    for (const double contrast : {1.0, 1e-3, 1e-6}) {
      for (std::uint64_t seed = 0; seed < 60; ++seed) {
        // Symmetric in two axes but for the disturbance.
        test::OwnedField noise = test::white_noise(grid.dims, seed);
        test::OwnedField other = test::white_noise(grid.dims, seed + 1000);
        test::OwnedField field = noise;
        for (std::int64_t n = 0; n < 27; ++n) {
          const Index3 at{n % 3, n / 3 % 3, n / 9};
          const Index3 swapped =
              seed % 2 == 0 ? Index3{at[1], at[0], at[2]} : Index3{at[0], at[2], at[1]};
          const double pair =
              0.5 * (noise.at(at[0], at[1], at[2]) + noise.at(swapped[0], swapped[1], swapped[2]));
          field.at(at[0], at[1], at[2]) =
              0.4 +
              0.4 * contrast * (pair - 0.5 + disturbance * (other.at(at[0], at[1], at[2]) - 0.5));
        }
        const PublishedMyc expected(field);
        if (expected.clearance < 1e-11 / contrast) {
          continue;
        }
        std::vector<CellPlane> planes(1);
        difmesh::cell_planes(field.view(), grid, middle, options, planes);
        CAPTURE(disturbance);
        CAPTURE(contrast);
        CAPTURE(seed);
        REQUIRE(planes[0].source != NormalSource::none);
        const Vec3 away = test::subtract(planes[0].plane.normal, test::unit(expected.normal));
        REQUIRE(test::length(away) < 1e-14 / contrast + 1e-14);
        ++compared;
        near_ties += expected.clearance < 1e-3 ? 1U : 0U;
      }
    }
  }
  CHECK(compared > 500);
  CHECK(near_ties > 300);
}

TEST_CASE("planes of cells have the same bits whether x runs through memory or not") {
  // Kernels serve fields whose x is contiguous; the others go cell by cell.
  const Grid grid{.dims = {37, 21, 19}, .origin = {1.0, 2.0, 3.0}, .spacing = {0.5, 1.0, 2.0}};
  for (const test::OwnedField& field :
       {test::blob(grid.dims), test::white_noise(grid.dims, 8), test::half_noise(grid.dims, 9)}) {
    std::vector<double> apart(2 * field.values.size(), 0.3);
    for (std::size_t n = 0; n < field.values.size(); ++n) {
      apart[2 * n] = field.values[n];
    }
    const FieldView view(apart.data(), difmesh::ScalarType::float64, grid.dims,
                         {2, 2 * grid.dims[0], 2 * grid.dims[0] * grid.dims[1]});
    std::vector<Index3> all;
    for (std::int64_t n = 0; n < grid.cell_count(); ++n) {
      all.push_back(
          {n % grid.dims[0], n / grid.dims[0] % grid.dims[1], n / grid.dims[0] / grid.dims[1]});
    }
    for (const difmesh::Normals normals :
         {difmesh::Normals::youngs, difmesh::Normals::myc, difmesh::Normals::height_function}) {
      Options options;
      options.normals = normals;
      options.boundary[0] = options.boundary[1] = difmesh::Side::mirror;
      std::vector<CellPlane> together(all.size());
      std::vector<CellPlane> alone(all.size());
      difmesh::cell_planes(field.view(), grid, all, options, together);
      difmesh::cell_planes(view, grid, all, options, alone);
      std::size_t sources[5] = {};
      for (std::size_t n = 0; n < all.size(); ++n) {
        REQUIRE(together[n].source == alone[n].source);
        REQUIRE(std::memcmp(&together[n].plane, &alone[n].plane, sizeof(difmesh::Plane)) == 0);
        ++sources[static_cast<std::size_t>(alone[n].source)];
      }
      CHECK(sources[static_cast<std::size_t>(NormalSource::youngs)] > 0);
      CHECK((sources[static_cast<std::size_t>(NormalSource::centred_columns)] > 0) ==
            (normals != difmesh::Normals::youngs));
    }
  }
}

TEST_CASE(
    "heights make the normal where all nine columns run from full to empty, and nowhere else") {
  test::OwnedField field = test::blob({44, 40, 37});
  std::mt19937_64 random(11);
  for (double& value : field.values) {
    constexpr double kOdd[] = {0.0, 1e-6, 1.1e-6, 0.01, 1 - 1.1e-6, 1 - 1e-6, 1.0};
    if (random() % 150 == 0) {
      value = kOdd[random() % 7];
    }
  }
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  std::vector<Index3> cells;
  for (const Index3& cell : difmesh::interfacial_cells(field.view(), grid)) {
    if (*std::min_element(cell.begin(), cell.end()) >= 4 && cell[0] < field.dims[0] - 4 &&
        cell[1] < field.dims[1] - 4 && cell[2] < field.dims[2] - 4) {
      cells.push_back(cell);
    }
  }
  // In batches of eight along x, in batches of four, and one by one.
  std::vector<double> apart(2 * field.values.size());
  for (std::size_t n = 0; n < field.values.size(); ++n) {
    apart[2 * n] = field.values[n];
  }
  FieldView strided = FieldView::x_fastest(apart.data(), field.dims);
  strided.strides = {2, 2 * field.dims[0], 2 * field.dims[0] * field.dims[1]};
  std::vector<CellPlane> without(cells.size());
  std::vector<CellPlane> together(cells.size());
  std::vector<CellPlane> alone(cells.size());
  Options options;
  difmesh::cell_planes(field.view(), grid, cells, options, together);
  difmesh::cell_planes(strided, grid, cells, options, alone);
  options.normals = difmesh::Normals::myc;
  difmesh::cell_planes(field.view(), grid, cells, options, without);
  int consistent = 0;
  int inconsistent = 0;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const Vec3& towards = without[n].plane.normal;
    Vec3 sizes{std::abs(towards[0]), std::abs(towards[1]), std::abs(towards[2])};
    std::sort(sizes.begin(), sizes.end());
    if (without[n].source == NormalSource::none || sizes[2] - sizes[1] < 1e-6) {
      continue;
    }
    const WordsOfColumns words(field, cells[n], towards);
    ++(words.all_consistent ? consistent : inconsistent);
    for (const CellPlane& plane : {together[n], alone[n]}) {
      REQUIRE((plane.source == NormalSource::height_function) == words.all_consistent);
      const Vec3& expected = words.all_consistent ? words.normal : towards;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        REQUIRE(std::abs(plane.plane.normal[axis] - expected[axis]) < 1e-13);
      }
    }
  }
  CHECK(consistent > 500);
  CHECK(inconsistent > 400);
}
