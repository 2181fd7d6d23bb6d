// Values of scanners and segmentations as fractions.

#include "difmesh/values.hpp"

#include <doctest/doctest.h>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "difmesh/error.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::ValueType;
using difmesh::ValueView;

template <class T>
ValueView view_of(const std::vector<T>& values, ValueType type) {
  const auto count = static_cast<std::int64_t>(values.size());
  return {values.data(), type, {count, 1, 1}, {1, count, count}};
}

template <class T>
std::vector<double> fractions(const std::vector<T>& values, ValueType type,
                              const difmesh::ValueRange& range) {
  std::vector<double> result(values.size(), -7.0);
  fractions_from_values(view_of(values, type), range, result.data());
  return result;
}

template <class T>
std::vector<int> inside(const std::vector<T>& values, ValueType type,
                        const std::vector<std::int64_t>& labels) {
  std::vector<std::uint8_t> result(values.size(), 7);
  fractions_from_labels(view_of(values, type), labels, result.data());
  return {result.begin(), result.end()};
}

template <class Action>
ErrorCode error_of(const Action& action) {
  try {
    action();
  } catch (const difmesh::Error& error) {
    return error.code();
  }
  return ErrorCode{};
}

/// Each type holds 0 and 7, and the fractions of 7 are known.
template <class T>
void check_type(ValueType type) {
  CAPTURE(name_of(type));
  CHECK(size_of(type) == static_cast<std::int64_t>(sizeof(T)));
  const std::vector<T> values{T{0}, T{7}, T{14}, T{28}};
  CHECK(fractions(values, type, {0.0, 28.0}) == std::vector<double>{0.0, 0.25, 0.5, 1.0});
  CHECK(fractions(values, type, {14.0, 7.0}) == std::vector<double>{1.0, 1.0, 0.0, 0.0});
  CHECK(fractions(values, type, {7.0, 14.0, false}) == std::vector<double>{-1.0, 0.0, 1.0, 3.0});
  CHECK(inside(values, type, {7}) == std::vector<int>{0, 255, 0, 0});
  CHECK(inside(values, type, {28, -5, 0, 99}) == std::vector<int>{255, 0, 0, 255});
  const auto extremes = extremes_of(view_of(values, type));
  REQUIRE(extremes.has_value());
  CHECK(extremes->lowest == 0.0);
  CHECK(extremes->highest == 28.0);
}

}  // namespace

TEST_CASE("values: fractions and labels of every type") {
  check_type<float>(ValueType::float32);
  check_type<double>(ValueType::float64);
  check_type<std::uint8_t>(ValueType::uint8);
  check_type<std::uint16_t>(ValueType::uint16);
  check_type<std::int8_t>(ValueType::int8);
  check_type<std::int16_t>(ValueType::int16);
  check_type<std::int32_t>(ValueType::int32);
  check_type<std::uint32_t>(ValueType::uint32);
  check_type<std::int64_t>(ValueType::int64);
  check_type<std::uint64_t>(ValueType::uint64);
}

TEST_CASE("values: labels are told apart exactly and only by types that can hold them") {
  constexpr std::int64_t large = (std::int64_t{1} << 53) + 1;  // no double
  CHECK(inside(std::vector<std::int64_t>{large - 1, large, -1}, ValueType::int64, {large}) ==
        std::vector<int>{0, 255, 0});
  CHECK(inside(std::vector<std::uint8_t>{1, 0}, ValueType::uint8, {257}) == std::vector<int>{0, 0});
  CHECK(inside(std::vector<std::uint8_t>{255}, ValueType::uint8, {-1}) == std::vector<int>{0});
  CHECK(inside(std::vector<std::uint64_t>{std::numeric_limits<std::uint64_t>::max()},
               ValueType::uint64, {-1, 5}) == std::vector<int>{0});
  CHECK(inside(std::vector<double>{9007199254740992.0}, ValueType::float64, {large}) ==
        std::vector<int>{0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(inside(std::vector<double>{2.0, 2.5, nan}, ValueType::float64, {2}) ==
        std::vector<int>{255, 0, 0});
  CHECK(inside(std::vector<double>{2.0, nan, 3.0}, ValueType::float64, {2, 3}) ==
        std::vector<int>{255, 0, 255});
}

TEST_CASE("values: NaN stays and takes no part in extremes") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values{nan, 3.0F, -1.0F, nan};
  const std::vector<double> result = fractions(values, ValueType::float32, {0.0, 4.0});
  CHECK(std::isnan(result[0]));
  CHECK(result[1] == 0.75);
  CHECK(result[2] == 0.0);
  const auto extremes = extremes_of(view_of(values, ValueType::float32));
  REQUIRE(extremes.has_value());
  CHECK(extremes->lowest == -1.0);
  CHECK(extremes->highest == 3.0);
  CHECK_FALSE(extremes_of(view_of(std::vector<float>{nan, nan}, ValueType::float32)).has_value());
}

TEST_CASE("values: neither the caller's rounding counts nor do NaN leave traces") {
  const std::vector<double> values{1.0, std::numeric_limits<double>::quiet_NaN(), 2.0};
  const std::vector<double> wanted{1.0 / 3.0, 0.0, 2.0 / 3.0};
  std::fesetround(FE_UPWARD);
  std::feclearexcept(FE_ALL_EXCEPT);
  const std::vector<double> found = fractions(values, ValueType::float64, {0.0, 3.0});
  const std::vector<int> mask = inside(values, ValueType::float64, {1, 2});
  const auto extremes = extremes_of(view_of(values, ValueType::float64));
  const bool raised = std::fetestexcept(FE_INVALID) != 0;
  std::fesetround(FE_TONEAREST);
  CHECK_FALSE(raised);
  CHECK(found[0] == wanted[0]);
  CHECK(found[2] == wanted[2]);
  CHECK(mask == std::vector<int>{255, 0, 255});
  CHECK(extremes->highest == 2.0);
}

TEST_CASE("values: any strides come out x fastest") {
  // Indexed [i][j][k] with the last axis turned round: value = 1 + 100 i + 10 j + k.
  std::vector<std::int16_t> cells;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 3; k >= 0; --k) {
        cells.push_back(static_cast<std::int16_t>(100 * i + 10 * j + k));
      }
    }
  }
  const ValueView view(cells.data() + 3, ValueType::int16, {2, 3, 4}, {12, 4, -1});
  std::vector<float> result(24);
  fractions_from_values(view, {0.0, 1.0, false}, result.data());
  std::size_t n = 0;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 2; ++i) {
        REQUIRE(result[n++] == static_cast<float>(100 * i + 10 * j + k));
      }
    }
  }
}

TEST_CASE("values: bad arguments are refused") {
  const std::vector<float> values{1.0F};
  double result = 0.0;
  std::uint8_t mask = 0;
  const ValueView view = view_of(values, ValueType::float32);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const difmesh::ValueRange range :
       {difmesh::ValueRange{1.0, 1.0}, difmesh::ValueRange{0.0, infinity},
        difmesh::ValueRange{-1e308, 1e308}, difmesh::ValueRange{std::nan(""), 1.0}}) {
    CHECK(error_of([&] { fractions_from_values(view, range, &result); }) ==
          ErrorCode::invalid_argument);
  }
  CHECK(error_of([&] { fractions_from_labels(view, {}, &mask); }) == ErrorCode::invalid_argument);
  CHECK(error_of([&] { (void)extremes_of(ValueView{}); }) == ErrorCode::invalid_argument);
  const ValueView none(values.data(), ValueType::float32, {1, 0, 1}, {1, 1, 1});
  CHECK(error_of([&] { (void)extremes_of(none); }) == ErrorCode::invalid_grid);
}

namespace {

/// Does `values` look like a mask whose highest value is `highest`?
template <class T>
void check_doubt(const std::vector<T>& values, ValueType type, const std::string& highest,
                 const std::string& full) {
  CAPTURE(name_of(type));
  CHECK(doubt_of_scale(view_of(values, type)) ==
        "the highest value is " + highest + ", and " + full + " of " + name_of(type) +
            " counts as full unless a full value or labels are given");
}

}  // namespace

TEST_CASE("values: masks and segmentations are told from shares of the largest value") {
  using std::int64_t;
  using std::uint64_t;
  check_doubt<std::uint8_t>({0, 200, 0, 200}, ValueType::uint8, "200", "255");
  check_doubt<std::uint8_t>({0, 127, 1}, ValueType::uint8, "127", "255");
  check_doubt<std::uint8_t>({254}, ValueType::uint8, "254", "255");
  check_doubt<std::uint16_t>({0, 40000}, ValueType::uint16, "40000", "65535");
  check_doubt<std::int8_t>({-3, 100}, ValueType::int8, "100", "127");
  check_doubt<std::int64_t>({0, (int64_t{1} << 62) + 1}, ValueType::int64, "4611686018427387905",
                            "9223372036854775807");
  check_doubt<uint64_t>({0, 1}, ValueType::uint64, "1", "18446744073709551615");
  // Segmentations of up to 16 values, in any order; what reaches no half may have any number.
  std::vector<std::uint8_t> labels;
  for (int n = 0; n < 4000; ++n) {
    labels.push_back(static_cast<std::uint8_t>(n * 7 % 16 * 16));
  }
  check_doubt(labels, ValueType::uint8, "240", "255");
  std::vector<std::uint8_t> low(labels);
  for (std::size_t n = 0; n < low.size(); ++n) {
    low[n] = static_cast<std::uint8_t>(n % 128);
  }
  check_doubt(low, ValueType::uint8, "127", "255");

  const auto none = [](const auto& values, ValueType type) {
    return doubt_of_scale(view_of(values, type)).empty();
  };
  labels.push_back(1);  // the seventeenth
  CHECK(none(labels, ValueType::uint8));
  low.insert(low.begin() + 700, 255);
  CHECK(none(low, ValueType::uint8));
  CHECK(none(std::vector<std::uint8_t>{0, 255}, ValueType::uint8));
  CHECK(none(std::vector<std::uint8_t>(500, 0), ValueType::uint8));
  CHECK(none(std::vector<std::int16_t>{0, -5, -5}, ValueType::int16));
  CHECK(none(std::vector<float>{0.0F, 200.0F}, ValueType::float32));
  CHECK(error_of([] { (void)doubt_of_scale(ValueView{}); }) == ErrorCode::invalid_argument);
}

TEST_CASE("values: every cell counts where masks are told, whatever the strides") {
  std::vector<std::uint16_t> cells(std::size_t{2} * 200 * 3, 65535);
  ValueView view(cells.data(), ValueType::uint16, {200, 3, 1}, {2, 400, 1200});
  for (std::size_t n = 0; n < cells.size(); n += 2) {
    cells[n] = 50000;  // the others are no cells of the view
  }
  CHECK(doubt_of_scale(view, "x").find("50000") != std::string::npos);
  cells[2 * 399] = 65535;
  CHECK(doubt_of_scale(view).empty());
  std::vector<std::uint16_t> packed(640, 7);
  for (const std::size_t at :
       {std::size_t{0}, std::size_t{63}, std::size_t{64}, std::size_t{639}}) {
    packed[at] = 65535;
    CHECK(doubt_of_scale(view_of(packed, ValueType::uint16)).empty());
    packed[at] = 7;
  }
}
