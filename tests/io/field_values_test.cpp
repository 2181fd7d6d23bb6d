// Fields of integers, masks and images: what their values stand for.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/reconstruct.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::FieldFile;
using difmesh::Index3;
using difmesh::ReadFieldOptions;
using difmesh::ScalarType;
using difmesh::ValueRange;
using difmesh::ValueType;
using test::check_error;
using test::TempFolder;

template <class T>
std::string bytes_of(const std::vector<T>& values, bool big_endian = false) {
  std::string bytes;
  for (const T value : values) {
    bytes += test::bytes_of(value, big_endian);
  }
  return bytes;
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data) {
  const std::string header =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
  return std::string("\x93NUMPY\1\0", 8) +
         test::bytes_of(static_cast<std::uint16_t>(header.size())) + header + data;
}

template <class T>
std::string nrrd(const std::string& type, const std::vector<T>& values, bool big_endian) {
  return "NRRD0004\ntype: " + type + "\ndimension: 3\nsizes: " + std::to_string(values.size()) +
         " 1 1\nendian: " + (big_endian ? "big" : "little") + "\nencoding: raw\n\n" +
         bytes_of(values, big_endian);
}

std::vector<double> row_of(const FieldFile& field) {
  std::vector<double> row;
  for (std::int64_t i = 0; i < field.dims[0]; ++i) {
    row.push_back(test::element(field.view(), i, 0, 0));
  }
  return row;
}

/// -3 (or 3), 0, 40 and the largest value of a type, in every format and order of bytes.
template <class T>
void check_type(const std::string& numpy_kind, const std::vector<std::string>& nrrd_names,
                ValueType type) {
  const T low = std::is_signed_v<T> ? static_cast<T>(-3) : T{3};
  const T largest = std::numeric_limits<T>::max();
  const std::vector<T> values{low, T{0}, T{40}, largest};
  const TempFolder folder;
  for (const bool big_endian : {false, true}) {
    std::vector<std::filesystem::path> files{folder.file(
        "f.npy",
        npy((big_endian ? ">" : "<") + numpy_kind, "(1, 1, 4)", bytes_of(values, big_endian)))};
    for (const std::string& name : nrrd_names) {
      files.push_back(folder.file("f" + std::to_string(files.size()) + ".nrrd",
                                  nrrd(name, values, big_endian)));
    }
    for (const auto& path : files) {
      CAPTURE(path.string());
      CHECK(difmesh::read_field(path).file_type == type);
      const FieldFile labelled = difmesh::read_field(path, {.labels = {40, low}});
      CHECK(labelled.type == ScalarType::uint8);
      CHECK(row_of(labelled) == std::vector<double>{255, 0, 255, 0});
      CHECK(labelled.warnings.empty());
      const FieldFile scaled = difmesh::read_field(path, {.values = ValueRange{0.0, 80.0}});
      CHECK(row_of(scaled) == std::vector<double>{std::is_signed_v<T> ? 0.0
                                                  : scaled.type == ScalarType::float32
                                                      ? static_cast<double>(3.0F / 80.0F)
                                                      : 3.0 / 80.0,
                                                  0.0, 0.5, 1.0});
      CHECK(scaled.warnings.empty());
    }
    const FieldFile raw = difmesh::read_field(
        folder.file("f.raw", "xy" + bytes_of(values, big_endian)),
        difmesh::RawLayout{.dims = {4, 1, 1}, .type = type, .big_endian = big_endian, .offset = 2},
        {.labels = {40}});
    CHECK(row_of(raw) == std::vector<double>{0, 0, 255, 0});
  }
}

/// The same where nothing says what the values stand for: shares of the largest one.
template <class T>
void check_shares(const std::string& kind, ScalarType type, double tolerance) {
  CAPTURE(kind);
  const T largest = std::numeric_limits<T>::max();
  const std::vector<T> values{std::numeric_limits<T>::min(), T{0}, static_cast<T>(largest / 4),
                              largest};
  const TempFolder folder;
  const FieldFile field =
      difmesh::read_field(folder.file("f.npy", npy("<" + kind, "(1, 1, 4)", bytes_of(values))));
  CHECK(field.type == type);
  const std::vector<double> row = row_of(field);
  CHECK(
      row[0] ==
      doctest::Approx(static_cast<double>(values[0]) / static_cast<double>(largest)).epsilon(1e-7));
  CHECK(row[1] == 0.0);
  CHECK(row[2] == doctest::Approx(0.25).epsilon(tolerance));
  CHECK(row[3] == 1.0);
  CHECK(field.warnings.empty());
}

}  // namespace

TEST_CASE("values of files: every integer type by labels and by a full value") {
  check_type<std::uint8_t>("u1", {"uchar", "uint8_t"}, ValueType::uint8);
  check_type<std::uint16_t>("u2", {"ushort"}, ValueType::uint16);
  check_type<std::int8_t>("i1", {"signed char", "int8", "int8_t"}, ValueType::int8);
  check_type<std::int16_t>(
      "i2", {"short", "short int", "signed short", "signed short int", "int16", "int16_t"},
      ValueType::int16);
  check_type<std::int32_t>("i4", {"int", "signed int", "int32", "int32_t"}, ValueType::int32);
  check_type<std::uint32_t>("u4", {"uint", "unsigned int", "uint32", "uint32_t"},
                            ValueType::uint32);
  check_type<std::int64_t>("i8",
                           {"longlong", "long long", "long long int", "signed long long",
                            "signed long long int", "int64", "int64_t"},
                           ValueType::int64);
  check_type<std::uint64_t>(
      "u8", {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"},
      ValueType::uint64);
}

TEST_CASE("values of files: integers of other types are shares of the largest") {
  check_shares<std::int8_t>("i1", ScalarType::float32, 0.03);
  check_shares<std::int16_t>("i2", ScalarType::float32, 1e-4);
  check_shares<std::int32_t>("i4", ScalarType::float64, 1e-9);
  check_shares<std::uint32_t>("u4", ScalarType::float64, 1e-9);
  check_shares<std::int64_t>("i8", ScalarType::float64, 1e-15);
  check_shares<std::uint64_t>("u8", ScalarType::float64, 1e-15);
}

TEST_CASE("values of files: integers too small to be shares bring a warning") {
  const TempFolder folder;
  const std::vector<std::int64_t> mask{0, 1, 1, 0, 2};
  const FieldFile field =
      difmesh::read_field(folder.file("mask.npy", npy("<i8", "(1, 1, 5)", bytes_of(mask))));
  REQUIRE(field.warnings.size() == 1);
  for (const char* words : {"mask.npy", "highest value is 2", "int64", "labels"}) {
    CAPTURE(words);
    CHECK(field.warnings[0].find(words) != std::string::npos);
  }
}

TEST_CASE("values of files: floats by a full value and by labels") {
  const TempFolder folder;
  const std::vector<float> values{-10.0F, 20.0F, 35.0F, 100.0F};
  const auto path = folder.file("f.npy", npy("<f4", "(1, 1, 4)", bytes_of(values)));
  CHECK(row_of(difmesh::read_field(path)) == std::vector<double>{-10, 20, 35, 100});
  CHECK(row_of(difmesh::read_field(path, {.values = ValueRange{20.0, 50.0}})) ==
        std::vector<double>{0.0, 0.0, 0.5, 1.0});
  CHECK(row_of(difmesh::read_field(path, {.labels = {100, 35}})) ==
        std::vector<double>{0, 0, 255, 255});
}

TEST_CASE("values of files: true is 1 however it is asked for") {
  const TempFolder folder;
  const std::string cells{'\0', '\1', '\2', '\0'};
  const auto path = folder.file("f.npy", npy("|b1", "(1, 1, 4)", cells));
  const std::vector<double> wanted{0, 255, 255, 0};
  CHECK(row_of(difmesh::read_field(path)) == wanted);
  CHECK(row_of(difmesh::read_field(path, {.labels = {1}})) == wanted);
  CHECK(row_of(difmesh::read_field(path, {.values = ValueRange{0.0, 1.0}})) ==
        std::vector<double>{0, 1, 1, 0});
}

TEST_CASE("values of files: a label mask gives the surface of the same mask of bool") {
  const Index3 dims{28, 20, 24};
  std::string cells;
  test::for_cells(dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const double r = std::hypot(static_cast<double>(i) - 13.5, static_cast<double>(j) - 9.5,
                                static_cast<double>(k) - 11.5);
    cells += r < 7.0 ? '\1' : '\0';
  });
  const TempFolder folder;
  const auto surface = [&](const std::string& type, const ReadFieldOptions& options) {
    const FieldFile field =
        difmesh::read_field(folder.file("mask.npy", npy(type, "(24, 20, 28)", cells)), options);
    return difmesh::reconstruct(field.view(), field.grid());
  };
  const difmesh::Reconstruction wanted = surface("|b1", {});
  CHECK(wanted.report.enclosed_volume ==
        doctest::Approx(4.0 / 3.0 * 3.14159265 * 343).epsilon(0.03));
  CHECK(surface("|u1", {}).mesh.triangles.empty());
  CHECK(surface("|u1", {.labels = {1}}).mesh.positions == wanted.mesh.positions);
  CHECK(surface("|i1", {.labels = {1}}).mesh.positions == wanted.mesh.positions);
  CHECK(surface("|u1", {.values = ValueRange{}}).mesh.positions == wanted.mesh.positions);
}

TEST_CASE("values of files: numbers of half precision") {
  // Zero, the least, the greatest below 1, 1, -2, the greatest, infinity, NaN; IEEE 754-2008, table
  // 3.5.
  const std::vector<std::uint16_t> halves{0x0000, 0x0001, 0x3bff, 0x3c00,
                                          0xc000, 0x7bff, 0x7c00, 0x7e00};
  const TempFolder folder;
  for (const bool big_endian : {false, true}) {
    const FieldFile field = difmesh::read_field(folder.file(
        "f.npy", npy(big_endian ? ">f2" : "<f2", "(1, 1, 8)", bytes_of(halves, big_endian))));
    CHECK(field.type == ScalarType::float32);
    const std::vector<double> row = row_of(field);
    CHECK(row[0] == 0.0);
    CHECK(row[1] == std::ldexp(1.0, -24));
    CHECK(row[2] == 1.0 - std::ldexp(1.0, -11));
    CHECK(row[3] == 1.0);
    CHECK(row[4] == -2.0);
    CHECK(row[5] == 65504.0);
    CHECK(std::isinf(row[6]));
    CHECK(std::isnan(row[7]));
  }
}

TEST_CASE("values of files: axes of one element beyond three") {
  const TempFolder folder;
  const Index3 dims{4, 3, 2};
  const std::string data = test::elements<std::uint16_t>(dims);
  for (const char* shape : {"(1, 2, 3, 4)", "(2, 3, 4, 1)", "(2, 1, 3, 4)", "(1, 2, 3, 1, 4, 1)"}) {
    CAPTURE(shape);
    CHECK(test::holds_values(
        difmesh::read_field(folder.file("f.npy", npy("<u2", shape, data))).view(), dims));
  }
  const auto one_layer = folder.file("g.npy", npy("<u2", "(1, 1, 6, 4)", data));
  CHECK(difmesh::read_field(one_layer).dims == Index3{4, 6, 1});
  CHECK(difmesh::read_field(folder.file("h.npy", npy("|u1", "(1, 1, 1, 1)", "x"))).dims ==
        Index3{1, 1, 1});
  for (const char* shape : {"(1, 6, 4, 1)", "(24,)", "(6, 4)", "(2, 3, 2, 2)", "()"}) {
    CAPTURE(shape);
    const auto path = folder.file("bad.npy", npy("<u2", shape, data));
    check_error([&] { (void)difmesh::read_field(path); }, ErrorCode::file_format,
                {"bad.npy", "rank"});
  }
}

TEST_CASE("values of files: options that make no sense are refused") {
  const TempFolder folder;
  const auto path = folder.file("f.npy", npy("|u1", "(1, 1, 1)", "x"));
  const auto refused = [&](const ReadFieldOptions& options,
                           std::initializer_list<std::string> words) {
    check_error([&] { (void)difmesh::read_field(path, options); }, ErrorCode::invalid_argument,
                words);
  };
  refused({.values = ValueRange{3.0, 3.0}}, {"f.npy", "differ"});
  refused({.values = ValueRange{0.0, std::nan("")}}, {"finite"});
  refused({.values = ValueRange{}, .labels = {1}}, {"labels exclude"});
  refused({.spacing = difmesh::Vec3{1, 0, 1}}, {"spacing", "above 0"});
  refused({.origin = difmesh::Vec3{1, std::nan(""), 1}}, {"origin", "finite"});
}
