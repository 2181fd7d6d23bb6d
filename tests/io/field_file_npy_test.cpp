// NumPy files, made by hand byte by byte.

#include <string>

#include "difmesh/io/field_file.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::FieldFile;
using difmesh::Index3;
using difmesh::ScalarType;
using test::check_error;
using test::TempFolder;

constexpr Index3 kDims{4, 3, 2};

std::string npy(int version, std::string header, const std::string& data) {
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  bytes += version == 1 ? test::bytes_of(static_cast<std::uint16_t>(header.size()))
                        : test::bytes_of(static_cast<std::uint32_t>(header.size()));
  return bytes + header + data;
}

std::string dict(const std::string& type, bool fortran, const std::string& shape = "(2, 3, 4)") {
  return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
         ", 'shape': " + shape + ", }";
}

/// value_at() as an array of shape (nz,ny,nx): C order has x fastest, Fortran order z fastest.
template <class T>
std::string data(bool fortran, bool big_endian) {
  if (!fortran) {
    return test::elements<T>(kDims, big_endian);
  }
  std::string bytes;
  for (std::int64_t i = 0; i < kDims[0]; ++i) {
    for (std::int64_t j = 0; j < kDims[1]; ++j) {
      for (std::int64_t k = 0; k < kDims[2]; ++k) {
        bytes += test::bytes_of(static_cast<T>(test::value_at(i, j, k)), big_endian);
      }
    }
  }
  return bytes;
}

template <class T>
void check_type(const TempFolder& folder, const std::string& kind, ScalarType type) {
  for (const int version : {1, 2, 3}) {
    for (const bool fortran : {false, true}) {
      for (const bool big_endian : {false, true}) {
        const std::string name = (big_endian ? ">" : sizeof(T) == 1 ? "|" : "<") + kind;
        CAPTURE(name);
        CAPTURE(version);
        CAPTURE(fortran);
        const auto path =
            folder.file("f.npy", npy(version, dict(name, fortran), data<T>(fortran, big_endian)));
        const FieldFile field = difmesh::read_field(path);
        CHECK(field.type == type);
        CHECK(test::holds_values(field.view(), kDims));
        CHECK_FALSE(field.origin.has_value());
        CHECK_FALSE(field.spacing.has_value());
      }
    }
  }
}

void check_refused(const std::string& bytes, ErrorCode code,
                   std::initializer_list<std::string> words) {
  const TempFolder folder;
  const auto path = folder.file("bad_field.npy", bytes);
  check_error([&] { (void)difmesh::read_field(path); }, code, {"bad_field.npy"});
  check_error([&] { (void)difmesh::read_field(path); }, code, words);
}

}  // namespace

TEST_CASE("npy: every type in both byte orders and both index orders and three versions") {
  const TempFolder folder;
  check_type<float>(folder, "f4", ScalarType::float32);
  check_type<double>(folder, "f8", ScalarType::float64);
  check_type<std::uint8_t>(folder, "u1", ScalarType::uint8);
  check_type<std::uint16_t>(folder, "u2", ScalarType::uint16);
}

TEST_CASE("npy: true and false are full and empty") {
  const TempFolder folder;
  const std::string cells{'\0', '\1', '\1', '\0', '\1', '\0'};
  const auto path = folder.file("f.npy", npy(1, dict("|b1", false, "(1, 2, 3)"), cells));
  const FieldFile field = difmesh::read_field(path);
  CHECK(field.type == ScalarType::uint8);
  CHECK(field.dims == Index3{3, 2, 1});
  CHECK(test::element(field.view(), 0, 0, 0) == 0.0);
  CHECK(test::element(field.view(), 1, 0, 0) == 255.0);
  CHECK(test::element(field.view(), 0, 1, 0) == 0.0);
  CHECK(test::element(field.view(), 1, 1, 0) == 255.0);
}

TEST_CASE("npy: a header in another order with double quotes and long integers") {
  const TempFolder folder;
  const auto path = folder.file(
      "F.NPY", npy(1, "{ \"shape\":(2L,3L,4L),\"fortran_order\" :False,\"descr\":\"<f8\"}   ",
                   data<double>(false, false)));
  CHECK(test::holds_values(difmesh::read_field(path).view(), kDims));
}

TEST_CASE("npy: a written file starts as NumPy wants it and its data are aligned") {
  const TempFolder folder;
  const std::vector<double> cells(24, 0.25);
  difmesh::write_field(folder / "f.npy", difmesh::FieldView::x_fastest(cells.data(), {4, 3, 2}));
  const std::string bytes = test::read_bytes(folder / "f.npy");
  CHECK(bytes.substr(0, 8) == std::string("\x93NUMPY\1\0", 8));
  const std::size_t length =
      static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  CHECK((10 + length) % 64 == 0);
  CHECK(bytes.size() == 10 + length + 24 * 8);
  CHECK(bytes[9 + length] == '\n');
  CHECK(bytes.substr(10, 62) == "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3, 4), }");
}

TEST_CASE("npy: wrong rank says so") {
  const std::string row(8, '\0');
  check_refused(npy(1, dict("<f8", false, "(1,)"), row), ErrorCode::file_format, {"rank 1"});
  check_refused(npy(1, dict("<f8", false, "()"), row), ErrorCode::file_format, {"rank 0"});
  check_refused(npy(1, dict("<f8", false, "(1, 1)"), row), ErrorCode::file_format, {"rank 2"});
  check_refused(npy(1, dict("<f8", false, "(2, 2, 2, 2)"), row), ErrorCode::file_format,
                {"rank 4"});
  std::string shape = "(2";
  for (int axis = 1; axis < 40; ++axis) {
    shape += ", 1";
  }
  check_refused(npy(1, dict("<f8", false, shape + ")"), row), ErrorCode::file_format, {"rank 40"});
}

TEST_CASE("npy: other types are refused with those that can be read") {
  for (const std::string type :
       {"<f16", "<i3", "<c8", "|S3", "<U1", "<M8", "f8", "|f8", "|i2", ""}) {
    check_refused(npy(1, dict(type, false), std::string(400, '\0')), ErrorCode::file_format,
                  {"'" + type + "'", "f2, f4, f8, u1 to u8"});
  }
  check_refused(
      npy(1, "{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (1,1,1)}", "12345678"),
      ErrorCode::file_format, {"structured"});
  check_refused(npy(1, dict("|O", false), "12345678"), ErrorCode::file_format, {"objects"});
}

TEST_CASE("npy: no cells and cells beyond counting") {
  check_refused(npy(1, dict("<f8", false, "(2, 0, 4)"), ""), ErrorCode::file_format, {"4 x 0 x 2"});
  check_refused(npy(1, dict("<f8", false, "(4294967296, 4294967296, 4)"), ""), ErrorCode::too_large,
                {"overflows"});
  check_refused(npy(1, dict("<f8", false, "(99999999999999999999, 1, 1)"), ""),
                ErrorCode::file_format, {"dimension"});
  check_refused(npy(1, dict("<f8", false, "(-2, 3, 4)"), ""), ErrorCode::file_format,
                {"dimension"});
}

TEST_CASE("npy: a header that promises 2^40 cells fails before memory is taken") {
  check_refused(npy(1, dict("<f8", false, "(1024, 1048576, 1024)"), "12345678"),
                ErrorCode::file_format, {"truncated", "8796093022208 bytes", "8 found"});
}

TEST_CASE("npy: too few and too many data are told by number") {
  std::string bytes = data<double>(false, false);
  bytes.pop_back();
  check_refused(npy(1, dict("<f8", false), bytes), ErrorCode::file_format,
                {"truncated", "192 bytes", "191 found"});
  check_refused(npy(1, dict("<f8", false), bytes + "ab"), ErrorCode::file_format,
                {"too long", "192 bytes", "193 found"});
}

TEST_CASE("npy: malformed headers name the matter") {
  const std::string d(192, '\0');
  const auto refused = [&](const std::string& header, std::initializer_list<std::string> words) {
    check_refused(npy(1, header, d), ErrorCode::file_format, words);
  };
  refused("", {"'{' wanted", "at the end"});
  refused("{", {"a string wanted"});
  refused("{}", {"'descr', 'fortran_order' and 'shape'"});
  refused("{'descr': '<f8', 'fortran_order': False}", {"needs each of"});
  refused("{'descr': '<f8', 'descr': '<f8', 'fortran_order': False, 'shape': (2,3,4)}",
          {"'descr' twice"});
  refused(dict("<f8", false) + " x", {"more after"});
  refused("{'descr': '<f8', 'fortran_order': 0, 'shape': (2,3,4)}", {"True or False"});
  refused("{'descr': '<f8', 'fortran_order': False, 'shape': [2,3,4]}", {"'(' wanted"});
  refused("{'descr': '<f8', 'fortran_order': False, 'shape': (2,3,4}", {"')' wanted"});
  refused("{'descr': '<f8', 'fortran_order': False, 'shape': ((2,3,4))}", {"a dimension wanted"});
  refused("{'descr': '<f8' 'fortran_order': False, 'shape': (2,3,4)}", {"'}' wanted"});
  refused("{'descr': '<f8, 'fortran_order': False}", {"wanted"});
  refused("{'descr': '<f8', 'fortran_order': False, 'shape': (2,3,4), 'more': 1}",
          {"unknown key 'more'"});
  refused(std::string(20000, '('), {"'{' wanted"});
  refused(std::string(20000, '{'), {"a string wanted"});
}

TEST_CASE("npy: broken starts of files") {
  check_refused("", ErrorCode::file_format, {"does not start with"});
  check_refused("PK\3\4 this is an .npz archive", ErrorCode::file_format, {"does not start with"});
  check_refused("\x93NUMPY", ErrorCode::file_format, {"truncated"});
  check_refused(npy(4, dict("<f8", false), ""), ErrorCode::file_format, {"version 4.0"});
  check_refused(std::string("\x93NUMPY\2\0\xff\xff\xff\x7f{}", 14), ErrorCode::file_format,
                {"header of 2147483647 bytes"});
  check_refused(std::string("\x93NUMPY\1\0\x60\0{}", 12), ErrorCode::file_format,
                {"truncated", "106 bytes wanted", "12 found"});
}

TEST_CASE("npy: no beginning of a good file is good") {
  const TempFolder folder;
  const std::string bytes = npy(2, dict("<u2", true), data<std::uint16_t>(true, false));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    CAPTURE(length);
    const auto path = folder.file("f.npy", bytes.substr(0, length));
    CHECK_THROWS_AS((void)difmesh::read_field(path), difmesh::Error);
  }
}

TEST_CASE("npy: a changed byte gives a field of the file's size or an error") {
  const TempFolder folder;
  const std::string bytes = npy(1, dict("<u2", false), data<std::uint16_t>(false, false));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const char change : {'\1', '\x10', '\x7f'}) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ change);
      const auto path = folder.file("f.npy", changed);
      try {
        const FieldFile field = difmesh::read_field(path);
        CHECK(field.cells.size() == 48);
      } catch (const difmesh::Error& error) {
        CHECK(std::string(error.what()).find("f.npy") != std::string::npos);
      }
    }
  }
}
