#include "difmesh/io/field_file.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::FieldFile;
using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::ScalarType;
using difmesh::ValueType;
using test::check_error;
using test::TempFolder;

constexpr Index3 kDims{4, 3, 2};

/// Doubles that a careless text or a float32 would change.
std::vector<double> awkward() {
  std::vector<double> cells;
  test::for_cells(kDims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    cells.push_back(std::sqrt(test::value_at(i, j, k)) / 15.0);
  });
  cells[0] = 1e-30;
  cells[1] = -6.5e-11;
  cells[2] = 1.0 + 8e-9;
  cells[3] = std::numeric_limits<double>::denorm_min();
  cells[4] = -0.0;
  cells[5] = std::numeric_limits<double>::infinity();
  return cells;
}

std::string bytes_of_cells(const FieldFile& field) {
  return {reinterpret_cast<const char*>(field.cells.data()), field.cells.size()};
}

/// The number behind "key": in a flat piece of JSON.
double json_number(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\":");
  REQUIRE(at != std::string::npos);
  return std::stod(json.substr(at + key.size() + 3));
}

}  // namespace

TEST_CASE("fields written and read again are equal bit for bit") {
  const TempFolder folder;
  const std::vector<double> cells = awkward();
  const std::string bytes(reinterpret_cast<const char*>(cells.data()), cells.size() * 8);
  const FieldView field = FieldView::x_fastest(cells.data(), kDims);
  for (const char* name : {"f.npy", "f.nrrd", "G.NRRD"}) {
    for (const bool gzip : {false, true}) {
      CAPTURE(name);
      difmesh::write_field(folder / name, field, {}, {.gzip = gzip});
      const FieldFile back = difmesh::read_field(folder / name);
      CHECK(back.type == ScalarType::float64);
      CHECK(back.dims == kDims);
      CHECK(bytes_of_cells(back) == bytes);
    }
  }
}

TEST_CASE("every type and layout is written as it is and read as it was") {
  const TempFolder folder;
  const auto check = [&]<class T>(T) {
    std::vector<T> z_fastest(24);
    test::for_cells(kDims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
      z_fastest[static_cast<std::size_t>((i * 3 + j) * 2 + k)] =
          static_cast<T>(test::value_at(i, j, k));
    });
    const FieldView field = FieldView::z_fastest(z_fastest.data(), kDims);
    for (const char* name : {"f.npy", "f.nrrd"}) {
      difmesh::write_field(folder / name, field);
      const FieldFile back = difmesh::read_field(folder / name);
      CHECK(back.type == difmesh::ScalarTypeOf<T>::value);
      CHECK(test::holds_values(back.view(), kDims));
    }
    // Upside down: from the last cell back.
    const FieldView turned{&z_fastest.back(), field.type, kDims, {-6, -2, -1}};
    difmesh::write_field(folder / "f.npy", turned);
    const FieldFile back = difmesh::read_field(folder / "f.npy");
    CHECK(test::element(back.view(), 3, 2, 1) == test::value_at(0, 0, 0));
    CHECK(test::element(back.view(), 0, 2, 0) == test::value_at(3, 0, 1));
  };
  check(float{});
  check(double{});
  check(std::uint8_t{});
  check(std::uint16_t{});
}

TEST_CASE("fractions become the nearest value of another type") {
  const TempFolder folder;
  const std::vector<double> cells{0.0, 1.0, 0.5, -0.2, 1.3, 1.0 / 3.0, 0.1, 254.4 / 255.0};
  const FieldView field = FieldView::x_fastest(cells.data(), {2, 2, 2});
  const auto written_as = [&](ScalarType type) {
    difmesh::write_field(folder / "f.npy", field, {}, {.type = type});
    FieldFile back = difmesh::read_field(folder / "f.npy");
    CHECK(back.type == type);
    return back;
  };
  const FieldFile bytes = written_as(ScalarType::uint8);
  const FieldFile words = written_as(ScalarType::uint16);
  const FieldFile floats = written_as(ScalarType::float32);
  const std::vector<double> as_bytes{0, 255, 128, 0, 255, 85, 26, 254};
  const std::vector<double> as_words{0, 65535, 32768, 0, 65535, 21845, 6554, 65381};
  std::size_t n = 0;
  test::for_cells({2, 2, 2}, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    CHECK(test::element(bytes.view(), i, j, k) == as_bytes[n]);
    CHECK(test::element(words.view(), i, j, k) == as_words[n]);
    CHECK(test::element(floats.view(), i, j, k) ==
          static_cast<double>(static_cast<float>(cells[n])));
    ++n;
  });
  // 8 bits are a share of 255, 16 bits of 65535: 257 to 1.
  difmesh::write_field(folder / "g.npy", bytes.view(), {}, {.type = ScalarType::uint16});
  const FieldFile widened = difmesh::read_field(folder / "g.npy");
  CHECK(test::element(widened.view(), 1, 0, 1) == 85 * 257);
  difmesh::write_field(folder / "g.npy", bytes.view(), {}, {.type = ScalarType::float64});
  CHECK(test::element(difmesh::read_field(folder / "g.npy").view(), 1, 0, 1) == 85.0 / 255.0);
}

TEST_CASE("a NaN that has to become an integer names its cell and leaves no file") {
  const TempFolder folder;
  std::vector<double> cells = awkward();
  cells[4 * 3 + 4 * 2 + 1] = std::numeric_limits<double>::quiet_NaN();
  check_error(
      [&] {
        difmesh::write_field(folder / "f.nrrd", FieldView::x_fastest(cells.data(), kDims), {},
                             {.type = ScalarType::uint8});
      },
      ErrorCode::invalid_value, {"cell (1,2,1)"});
  CHECK(folder.names().empty());
}

TEST_CASE("raw fields are read in both byte orders from any byte") {
  const TempFolder folder;
  for (const bool big_endian : {false, true}) {
    const auto path =
        folder.file("f.dat", "abc" + test::elements<std::uint16_t>(kDims, big_endian));
    const FieldFile field = difmesh::read_field(
        path, {.dims = kDims, .type = ValueType::uint16, .big_endian = big_endian, .offset = 3});
    CHECK(test::holds_values(field.view(), kDims));
  }
  const auto path = folder.file("f.raw", test::elements<float>(kDims));
  CHECK(test::holds_values(
      difmesh::read_field(path, {.dims = kDims, .type = ValueType::float32}).view(), kDims));
}

TEST_CASE("raw fields of another size than their layout are refused") {
  const TempFolder folder;
  const auto path = folder.file("f.raw", test::elements<double>(kDims));
  const auto refused = [&](const difmesh::RawLayout& layout, ErrorCode code,
                           std::initializer_list<std::string> words) {
    check_error([&] { (void)difmesh::read_field(path, layout); }, code, words);
  };
  refused({.dims = {4, 3, 3}}, ErrorCode::file_format, {"f.raw", "288 bytes", "192"});
  refused({.dims = {4, 3, 1}}, ErrorCode::file_format, {"f.raw", "96 bytes", "192"});
  refused({.dims = kDims, .offset = 1}, ErrorCode::file_format, {"f.raw", "byte 1"});
  refused({.dims = kDims, .offset = 1000}, ErrorCode::file_format, {"f.raw", "byte 1000"});
  refused({.dims = {1 << 20, 1 << 10, 1 << 10}}, ErrorCode::file_format, {"8796093022208"});
  refused({.dims = {1LL << 32, 1LL << 32, 4}}, ErrorCode::too_large, {"f.raw", "overflows"});
  refused({.dims = {4, 0, 2}}, ErrorCode::invalid_argument, {"f.raw", "4 x 0 x 2"});
  refused({.dims = kDims, .offset = -1}, ErrorCode::invalid_argument, {"f.raw", "-1"});
  check_error([&] { (void)difmesh::read_field(path); }, ErrorCode::file_format,
              {"f.raw", "layout"});
}

TEST_CASE("fields that cannot be opened are named with the reason") {
  const TempFolder folder;
  for (const char* name : {"none.npy", "none.nrrd", "none.nhdr", "no/folder.npy"}) {
    check_error([&] { (void)difmesh::read_field(folder / name); }, ErrorCode::file_missing,
                {name, "No such file"});
  }
  std::filesystem::create_directory(folder / "folder.npy");
  check_error([&] { (void)difmesh::read_field(folder / "folder.npy"); }, ErrorCode::file_format,
              {"folder.npy", "not a regular file"});
  check_error([&] { (void)difmesh::read_field("/dev/zero", {.dims = kDims}); },
              ErrorCode::file_format, {"/dev/zero", "not a regular file"});
  REQUIRE(::mkfifo((folder / "pipe.npy").c_str(), 0600) == 0);
  check_error([&] { (void)difmesh::read_field(folder / "pipe.npy"); }, ErrorCode::file_format,
              {"pipe.npy", "not a regular file"});
}

TEST_CASE("unknown extensions of fields are answered with the known ones") {
  const TempFolder folder;
  const std::vector<double> cells(24, 0.0);
  const FieldView field = FieldView::x_fastest(cells.data(), kDims);
  for (const char* name : {"f.vti", "f", "npy", "f.npy.txt"}) {
    check_error([&] { (void)difmesh::read_field(folder / name); }, ErrorCode::file_format,
                {name, ".npy", ".nrrd", ".nhdr"});
    check_error([&] { difmesh::write_field(folder / name, field); }, ErrorCode::invalid_argument,
                {name, ".npy", ".nrrd"});
  }
  CHECK(folder.names().empty());
  difmesh::write_field(folder / "f.dat", field, {}, {.format = difmesh::FieldFormat::npy});
  CHECK(test::read_bytes(folder / "f.dat").substr(1, 5) == "NUMPY");
}

TEST_CASE("arguments of write_field are checked before a file is made") {
  const TempFolder folder;
  const std::vector<double> cells(24, 0.0);
  const FieldView field = FieldView::x_fastest(cells.data(), kDims);
  const auto path = folder / "f.nrrd";
  const auto refused = [&](const FieldView& view, const std::optional<Grid>& grid,
                           const difmesh::WriteFieldOptions& options, ErrorCode code,
                           const std::string& word) {
    check_error([&] { difmesh::write_field(path, view, grid, options); }, code, {word});
    CHECK(folder.names().empty());
  };
  const auto invalid = ErrorCode::invalid_argument;
  refused(field, Grid{{4, 3, 3}, {0, 0, 0}, {1, 1, 1}}, {}, invalid, "4 x 3 x 3");
  refused(field, Grid{kDims, {0, 0, 0}, {1, 0, 1}}, {}, ErrorCode::invalid_grid, "");
  refused(field, {}, {.gzip_level = 0}, invalid, "gzip_level 0");
  refused(field, {}, {.gzip_level = 10}, invalid, "gzip_level 10");
  refused(FieldView{}, {}, {}, invalid, "no data");
  refused({cells.data(), ScalarType::float64, {4, 0, 2}, {1, 4, 12}}, {}, {}, invalid, "4 x 0 x 2");
}

TEST_CASE("real fields have the figures that were taken from them") {
  for (const std::string name :
       {"gerris_drops64_t0.45", "interfoam_dambreak_64x40x80_t0.3", "isofoam_vortex64_t1.5"}) {
    const std::filesystem::path folder = DIFMESH_SHARED_DATA;
    if (!std::filesystem::exists(folder / (name + ".npy"))) {
      MESSAGE("skipped: no " << (folder / name).string());
      continue;
    }
    CAPTURE(name);
    const std::string json = test::read_bytes(folder / (name + ".json"));
    const FieldFile field = difmesh::read_field(folder / (name + ".npy"));
    std::int64_t strict = 0;
    std::int64_t below = 0;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double sum = 0.0;
    // At the high side of x, where an exchange of axes would show in the dam break.
    std::int64_t x_high = 0;
    std::int64_t z_low = 0;
    test::for_cells(field.dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
      const double value = test::element(field.view(), i, j, k);
      strict += value > 0.0 && value < 1.0 ? 1 : 0;
      below += value < 0.0 ? 1 : 0;
      low = std::min(low, value);
      high = std::max(high, value);
      sum += value;
      x_high += i == field.dims[0] - 1 && value > 0.5 ? 1 : 0;
      z_low += k == 0 && value > 0.5 ? 1 : 0;
    });
    CHECK(field.dims[0] * field.dims[1] * field.dims[2] == json_number(json, "n_cells"));
    CHECK(strict == json_number(json, "n_frac_strict"));
    CHECK(below == json_number(json, "n_below0"));
    CHECK(low == json_number(json, "min"));
    CHECK(high == json_number(json, "max"));
    CHECK(x_high == json_number(json, "xhi"));
    CHECK(z_low == json_number(json, "zlo"));
    const double cell = name[1] == 'n' ? 0.015625 * 0.025 * 0.0125 : std::pow(0.015625, 3);
    CHECK(sum * cell == doctest::Approx(json_number(json, "volume")).epsilon(1e-12));
  }
}

TEST_CASE("the example field is the real one with its grid") {
  const FieldFile example = difmesh::read_field(std::string(DIFMESH_SOURCE_DIR) +
                                                "/examples/data/gerris_drops64_t0.45.nrrd");
  CHECK(example.type == ScalarType::float64);
  CHECK(example.origin.value() == difmesh::Vec3{-0.5, -0.5, -0.5});
  CHECK(example.spacing.value() == difmesh::Vec3{0.015625, 0.015625, 0.015625});
  double sum = 0.0;
  std::int64_t strict = 0;
  test::for_cells({64, 64, 64}, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const double value = test::element(example.view(), i, j, k);
    sum += value;
    strict += value > 0.0 && value < 1.0 ? 1 : 0;
  });
  CHECK(sum * std::pow(0.015625, 3) == doctest::Approx(0.02284479571901324).epsilon(1e-13));
  CHECK(strict == 3534);
  const std::filesystem::path original =
      std::string(DIFMESH_SHARED_DATA) + "/gerris_drops64_t0.45.npy";
  if (std::filesystem::exists(original)) {
    CHECK(bytes_of_cells(example) == bytes_of_cells(difmesh::read_field(original)));
  }
}
