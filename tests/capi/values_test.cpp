// Values of scanners and segmentations through the C interface.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "handles.hpp"

namespace {

namespace c = difmesh::test;

template <class T>
void check_type(std::int32_t type) {
  CAPTURE(type);
  // Two cells along x, y and z, z fastest.
  const std::vector<T> values{T{0}, T{1}, T{2}, T{3}, T{4}, T{5}, T{6}, T{100}};
  dif_field field = c::c_field(values.data(), type, {2, 2, 2});
  field.strides[0] = 4;
  field.strides[1] = 2;
  field.strides[2] = 1;
  std::vector<double> fractions(8, -1.0);
  REQUIRE(dif_fractions_from_values(&field, 0.0, 8.0, fractions.data()) == DIF_OK);
  CHECK(fractions == std::vector<double>{0.0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 1.0});
  std::vector<std::uint8_t> mask(8, 7);
  const std::int64_t labels[3] = {100, 2, 77};
  REQUIRE(dif_fractions_from_labels(&field, 3, labels, mask.data()) == DIF_OK);
  CHECK(mask == std::vector<std::uint8_t>{0, 0, 255, 0, 0, 0, 0, 255});
  double low = -1.0;
  double high = -1.0;
  REQUIRE(dif_value_extremes(&field, &low, &high) == DIF_OK);
  CHECK(low == 0.0);
  CHECK(high == 100.0);
}

}  // namespace

TEST_CASE("values of all types become fractions") {
  check_type<float>(DIF_FLOAT32);
  check_type<double>(DIF_FLOAT64);
  check_type<std::uint8_t>(DIF_UINT8);
  check_type<std::uint16_t>(DIF_UINT16);
  check_type<std::int8_t>(DIF_INT8);
  check_type<std::int16_t>(DIF_INT16);
  check_type<std::int32_t>(DIF_INT32);
  check_type<std::uint32_t>(DIF_UINT32);
  check_type<std::int64_t>(DIF_INT64);
  check_type<std::uint64_t>(DIF_UINT64);
}

TEST_CASE("extremes of nothing but NaN are NaN") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const dif_field field = c::c_field(&nan, DIF_FLOAT64, {1, 1, 1});
  double low = 0.0;
  double high = 0.0;
  REQUIRE(dif_value_extremes(&field, &low, &high) == DIF_OK);
  CHECK(std::isnan(low));
  CHECK(std::isnan(high));
}

TEST_CASE("a field of values is no field of fractions and is told what makes one") {
  const std::vector<std::int16_t> values(27, 1);
  const dif_field field = c::c_field(values.data(), DIF_INT16, {3, 3, 3});
  dif_mesh* mesh = nullptr;
  CHECK(dif_reconstruct(&field, nullptr, &mesh) == DIF_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(dif_last_message()).find("dif_fractions_from_labels") != std::string::npos);
}

TEST_CASE("a mesh says where its field looks like a mask") {
  std::vector<std::uint16_t> cells(125, 0);
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const bool inside = n % 5 % 4 != 0 && n / 5 % 5 % 4 != 0 && n / 25 % 4 != 0;
    cells[n] = inside ? 50000 : 0;
  }
  const dif_field field = c::c_field(cells.data(), DIF_UINT16, {5, 5, 5});
  dif_options options = c::prepared(dif_options_init);
  const auto warning_of = [&](const dif_mesh* mesh) {
    const char* text = nullptr;
    REQUIRE(dif_mesh_warning(mesh, 0, &text) == DIF_OK);
    return std::string(text != nullptr ? text : "");
  };
  const auto made_warning = [&] {
    dif_mesh* mesh = nullptr;
    REQUIRE(dif_reconstruct(&field, &options, &mesh) == DIF_OK);
    const c::MeshHandle owned(mesh);
    return warning_of(mesh);
  };
  const std::string wanted =
      "the highest value is 50000, and 65535 of uint16 counts as full unless a full value or "
      "labels are given";
  CHECK(made_warning() == wanted);
  options.purity_tolerance = 0.1;
  CHECK(made_warning() == wanted);
  std::replace(cells.begin(), cells.end(), std::uint16_t{50000}, std::uint16_t{2});
  CHECK(made_warning().find("highest value is 2,") != std::string::npos);
  cells[124] = 65535;
  CHECK(made_warning().empty());
  std::replace(cells.begin(), cells.end(), std::uint16_t{2}, std::uint16_t{65535});
  CHECK(made_warning().empty());

  dif_block block = c::prepared(dif_block_init);
  std::fill(cells.begin(), cells.end(), std::uint16_t{50000});
  std::copy_n(field.dims, 3, block.dims);
  const dif_grid grid = c::c_grid({.dims = {5, 5, 5}});
  dif_mesh* part = nullptr;
  REQUIRE(dif_reconstruct_block(&field, &block, &grid, nullptr, &part) == DIF_OK);
  const c::MeshHandle owned(part);
  CHECK(warning_of(part).empty());  // other blocks may have full cells
}
