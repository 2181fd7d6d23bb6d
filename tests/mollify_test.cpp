#include "difmesh/mollify.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "support/fields.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::Array;
using difmesh::ErrorCode;
using difmesh::FieldView;
using difmesh::Index3;
using difmesh::mollify;
using difmesh::MollifyOptions;
using difmesh::Side;
using namespace difmesh::test;

constexpr difmesh::Boundary kAll(Side side) {
  return {side, side, side, side, side, side};
}

MollifyOptions with(Side side, double radius = 2.0) {
  MollifyOptions options;
  options.boundary = kAll(side);
  options.radius = radius;
  return options;
}

std::size_t element(const Index3& dims, std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<std::size_t>((k * dims[1] + j) * dims[0] + i);
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}
double sum_of(const Array<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The convolution by its definition, with indices that wrap.
double convolved(const OwnedField& field, const Index3& at, double radius) {
  double sum = 0.0;
  double weights = 0.0;
  const auto wrap = [](std::int64_t index, std::int64_t dim) { return (index % dim + dim) % dim; };
  for (std::int64_t k = -8; k <= 8; ++k) {
    for (std::int64_t j = -8; j <= 8; ++j) {
      for (std::int64_t i = -8; i <= 8; ++i) {
        const double r = std::sqrt(static_cast<double>(i * i + j * j + k * k)) / radius;
        if (r < 1.0) {
          const double weight = std::pow(1.0 - r * r, 4);
          weights += weight;
          sum +=
              weight *
              field.values[element(field.dims, wrap(at[0] + i, field.dims[0]),
                                   wrap(at[1] + j, field.dims[1]), wrap(at[2] + k, field.dims[2]))];
        }
      }
    }
  }
  return sum / weights;
}

std::pair<ErrorCode, std::string> failure_of(const FieldView& field,
                                             const MollifyOptions& options) {
  try {
    static_cast<void>(mollify(field, options));
  } catch (const difmesh::Error& error) {
    return {error.code(), error.what()};
  }
  FAIL("no error was thrown");
  return {};
}

}  // namespace

TEST_CASE("mollify: follows the definition of the convolution") {
  const OwnedField field = white_noise({11, 9, 10}, 4);
  for (const double radius : {1.5, 1.8, 2.0, 2.7, 4.0}) {
    const Array<double> result = mollify(field.view(), with(Side::periodic, radius));
    for (const Index3 at : {Index3{0, 0, 0}, Index3{10, 8, 9}, Index3{5, 4, 3}, Index3{1, 8, 0}}) {
      CHECK(result[element(field.dims, at[0], at[1], at[2])] ==
            doctest::Approx(convolved(field, at, radius)).epsilon(1e-14));
    }
  }
  const Array<double> same = mollify(field.view(), with(Side::mirror, 1.0));
  CHECK(std::equal(same.begin(), same.end(), field.values.begin()));
}

TEST_CASE("mollify: a single full cell becomes the kernel, alike along all axes") {
  OwnedField field({9, 9, 9});
  field.at(4, 4, 4) = 1.0;
  const Array<double> result = mollify(field.view(), with(Side::open, 3.0));
  for (std::int64_t a = -4; a <= 4; ++a) {
    for (std::int64_t b = -4; b <= 4; ++b) {
      for (std::int64_t c = -4; c <= 4; ++c) {
        const double here = result[element(field.dims, 4 + a, 4 + b, 4 + c)];
        CHECK(here == result[element(field.dims, 4 - a, 4 - c, 4 + b)]);
        CHECK((here > 0.0) == (a * a + b * b + c * c < 9));
      }
    }
  }
  CHECK(sum_of(result) == doctest::Approx(1.0).epsilon(1e-14));
}

TEST_CASE("mollify: rows that are skipped as uniform are those that are, in grids of any shape") {
  // Few cells that are not empty in grids that are longer in y and longer in z.
  for (const Index3& dims : {Index3{6, 5, 17}, Index3{6, 17, 5}}) {
    OwnedField field(dims);
    OwnedField swapped({dims[0], dims[2], dims[1]});
    for (const Index3& cell : {Index3{1, 0, 3}, Index3{4, 3, 4}, Index3{2, 4, 1}}) {
      const bool tall = dims[2] > dims[1];
      const std::int64_t j = tall ? cell[1] : 3 * cell[1] + 2;
      const std::int64_t k = tall ? 3 * cell[2] + 2 : cell[2];
      field.at(cell[0], j, k) = 0.7;
      swapped.at(cell[0], k, j) = 0.7;
    }
    const Array<double> one = mollify(field.view());
    const Array<double> other = mollify(swapped.view());
    double sum = 0.0;
    for (std::int64_t n = 0; n < dims[0] * dims[1] * dims[2]; ++n) {
      const std::int64_t i = n % dims[0];
      const std::int64_t j = n / dims[0] % dims[1];
      const std::int64_t k = n / dims[0] / dims[1];
      const double here = one[static_cast<std::size_t>(n)];
      const double there = other[static_cast<std::size_t>((j * dims[2] + k) * dims[0] + i)];
      CHECK(std::abs(here - there) < 1e-15);
      sum += here;
    }
    CHECK(sum > 2.0);
  }
}

TEST_CASE("mollify: constants are kept to the bit") {
  const OwnedField field({7, 5, 6}, 0.3);
  for (const Side side : {Side::open, Side::mirror, Side::periodic}) {
    const Array<double> result = mollify(field.view(), with(side, 5.0));
    CHECK(std::all_of(result.begin(), result.end(), [](double value) { return value == 0.3; }));
  }
  const Array<double> none = mollify(OwnedField({7, 5, 6}, 0.0).view(), with(Side::empty));
  CHECK(std::all_of(none.begin(), none.end(), [](double value) { return value == 0.0; }));
  const Array<double> all = mollify(OwnedField({7, 5, 6}, 1.0).view(), with(Side::full));
  CHECK(std::all_of(all.begin(), all.end(), [](double value) { return value == 1.0; }));
}

TEST_CASE("mollify: the sum is kept where nothing lies beyond the sides or comes again") {
  const OwnedField field = white_noise({13, 8, 11}, 7);
  const double sum = sum_of(field.values);
  for (const double radius : {2.0, 3.5, 8.0}) {
    for (const Side side : {Side::open, Side::mirror, Side::periodic}) {
      CHECK(sum_of(mollify(field.view(), with(side, radius))) ==
            doctest::Approx(sum).epsilon(1e-13));
    }
    CHECK(sum_of(mollify(field.view(), with(Side::empty, radius))) < sum - 1.0);
    CHECK(sum_of(mollify(field.view(), with(Side::full, radius))) > sum + 1.0);
  }
}

TEST_CASE("mollify: linear fields are kept away from the sides") {
  OwnedField field({12, 13, 14});
  for (std::int64_t k = 0; k < 14; ++k) {
    for (std::int64_t j = 0; j < 13; ++j) {
      for (std::int64_t i = 0; i < 12; ++i) {
        field.at(i, j, k) = 0.02 * static_cast<double>(i) - 0.03 * static_cast<double>(j) +
                            0.01 * static_cast<double>(k) + 0.4;
      }
    }
  }
  const Array<double> result = mollify(field.view(), with(Side::open, 3.0));
  for (std::int64_t k = 2; k < 12; ++k) {
    for (std::int64_t j = 2; j < 11; ++j) {
      for (std::int64_t i = 2; i < 10; ++i) {
        CHECK(std::abs(result[element(field.dims, i, j, k)] - field.at(i, j, k)) < 1e-15);
      }
    }
  }
}

TEST_CASE("mollify: sides act one by one") {
  const OwnedField field({6, 6, 6}, 1.0);
  MollifyOptions options = with(Side::mirror);
  options.boundary[0] = Side::empty;
  options.boundary[3] = Side::full;
  const Array<double> result = mollify(field.view(), options);
  for (std::int64_t n = 0; n < 6; ++n) {
    CHECK(result[element(field.dims, 0, n, 3)] < 1.0);
    CHECK(result[element(field.dims, 1, n, 3)] == 1.0);
    CHECK(result[element(field.dims, 5, n, 3)] == 1.0);
  }
  // Where an empty and a full side meet, the outside is empty.
  CHECK(result[element(field.dims, 0, 5, 3)] == result[element(field.dims, 0, 2, 3)]);
}

TEST_CASE("mollify: values between 0 and 1 stay there and others are taken as they are") {
  const OwnedField noise = half_noise({16, 15, 14}, 3);
  const Array<double> result = mollify(noise.view());
  const auto [low, high] = std::minmax_element(result.begin(), result.end());
  CHECK(*low >= 0.0);
  CHECK(*high <= 1.0);
  OwnedField field({5, 5, 5}, 3.0);
  field.at(2, 2, 2) = -2.0;
  CHECK(sum_of(mollify(field.view())) == doctest::Approx(sum_of(field.values)).epsilon(1e-14));
}

TEST_CASE("mollify: no bit depends on threads, element type or layout") {
  OwnedField field = white_noise({40, 33, 21}, 8);
  std::vector<std::uint8_t> bytes;
  for (double& value : field.values) {
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0 * value)));
    value = bytes.back() / 255.0;
  }
  MollifyOptions options = with(Side::periodic);
  options.threads = 1;
  const Array<double> one = mollify(field.view(), options);
  for (const int threads : {2, 3, 0}) {
    options.threads = threads;
    CHECK(same_bytes(one, mollify(field.view(), options)));
  }
  CHECK(same_bytes(one, mollify(FieldView::x_fastest(bytes.data(), field.dims), options)));
  std::vector<double> turned(field.values.size());
  for (std::int64_t k = 0; k < 21; ++k) {
    for (std::int64_t j = 0; j < 33; ++j) {
      for (std::int64_t i = 0; i < 40; ++i) {
        turned[static_cast<std::size_t>((i * 33 + j) * 21 + k)] = field.at(i, j, k);
      }
    }
  }
  CHECK(same_bytes(one, mollify(FieldView::z_fastest(turned.data(), field.dims), options)));
}

TEST_CASE("mollify: takes the staircases out of linear contours") {
  const double radius = 24.0;
  const difmesh::Grid grid{.dims = {56, 56, 56}};
  const auto ball = difmesh::make_shape({.centre = {28.1, 27.8, 28.3}, .radius = radius});
  const auto fractions = difmesh::fractions_from_shape(grid, ball).fractions;
  const FieldView sharp = FieldView::x_fastest(fractions.data(), grid.dims);
  const Array<double> smooth = mollify(sharp);
  struct Offsets {
    double mean = 0.0;
    double deviation = 0.0;
  };
  const auto offsets = [&](const FieldView& field) {
    difmesh::Options options;
    options.placement = difmesh::Placement::linear;
    const auto mesh = difmesh::reconstruct(field, grid, options).mesh;
    double sum = 0.0;
    double squares = 0.0;
    for (const difmesh::Vec3& p : mesh.positions) {
      const double away = length(subtract(p, {28.1, 27.8, 28.3})) - radius;
      sum += away;
      squares += away * away;
    }
    const double count = static_cast<double>(mesh.positions.size());
    return Offsets{sum / count, std::sqrt(squares / count - sum * sum / (count * count))};
  };
  const Offsets before = offsets(sharp);
  const Offsets after = offsets(FieldView::x_fastest(smooth.data(), grid.dims));
  CAPTURE(before.deviation);
  CAPTURE(after.deviation);
  CHECK(after.deviation < 0.6 * before.deviation);
  // Half the kernel's variance times twice the mean curvature.
  CHECK((before.mean - after.mean) * radius == doctest::Approx(0.316).epsilon(0.1));
}

TEST_CASE("mollify: bad input is named") {
  OwnedField field({5, 4, 3}, 0.5);
  MollifyOptions options;
  for (const double radius : {0.99, 8.01, std::numeric_limits<double>::quiet_NaN()}) {
    options.radius = radius;
    CHECK(failure_of(field.view(), options).second.find("radius must be 1 to 8 cells") !=
          std::string::npos);
  }
  options = {};
  options.boundary[4] = Side::periodic;
  CHECK(failure_of(field.view(), options).first == ErrorCode::invalid_argument);
  CHECK(failure_of({}, {}).first == ErrorCode::invalid_grid);
  CHECK(failure_of(FieldView(nullptr, difmesh::ScalarType::float64, {2, 2, 2}, {1, 2, 4}), {})
            .first == ErrorCode::invalid_argument);
  field.at(4, 3, 1) = -std::numeric_limits<double>::infinity();
  field.at(0, 0, 2) = std::numeric_limits<double>::quiet_NaN();
  const auto [code, message] = failure_of(field.view(), {});
  CHECK(code == ErrorCode::invalid_value);
  CHECK(message.find("(4, 3, 1) is -inf") != std::string::npos);
  options = {};
  options.progress = [](double) { return false; };
  CHECK(failure_of(OwnedField({5, 4, 3}, 0.5).view(), options).first == ErrorCode::cancelled);
}
