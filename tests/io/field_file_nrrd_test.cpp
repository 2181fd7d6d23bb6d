// NRRD files, made by hand.

#include <zlib.h>

#include <cmath>
#include <limits>
#include <string>

#include "difmesh/io/field_file.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::FieldFile;
using difmesh::Index3;
using difmesh::ScalarType;
using difmesh::Vec3;
using test::check_error;
using test::TempFolder;

constexpr Index3 kDims{4, 3, 2};

/// A header of a field of doubles, less encoding and geometry, plus `fields`.
std::string header(const std::string& fields, const std::string& type = "double") {
  return "NRRD0004\n# a comment\ntype: " + type + "\ndimension: 3\nsizes: 4 3 2\nendian: little\n" +
         fields;
}

std::string raw_file(const std::string& fields) {
  return header("encoding: raw\n" + fields + "\n") + test::elements<double>(kDims);
}

std::string gzipped(const std::string& data) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 6, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string out(deflateBound(&stream, data.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

FieldFile read(const std::string& bytes) {
  const TempFolder folder;
  return difmesh::read_field(folder.file("f.nrrd", bytes));
}

void check_refused(const std::string& bytes, std::initializer_list<std::string> words,
                   ErrorCode code = ErrorCode::file_format) {
  const TempFolder folder;
  const auto path = folder.file("bad_field.nrrd", bytes);
  check_error([&] { (void)difmesh::read_field(path); }, code, {"bad_field.nrrd"});
  check_error([&] { (void)difmesh::read_field(path); }, code, words);
}

void check_close(const Vec3& found, const Vec3& wanted) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CHECK(found[axis] == doctest::Approx(wanted[axis]).epsilon(1e-15));
  }
}

template <class T>
void check_type(const std::string& name, ScalarType type) {
  for (const bool big_endian : {false, true}) {
    CAPTURE(name);
    CAPTURE(big_endian);
    const FieldFile field =
        read("NRRD0001\ntype: " + name + "\ndimension: 3\nsizes: 4 3 2\nencoding: raw\nendian: " +
             (big_endian ? "big" : "little") + "\n\n" + test::elements<T>(kDims, big_endian));
    CHECK(field.type == type);
    CHECK(test::holds_values(field.view(), kDims));
  }
}

}  // namespace

TEST_CASE("nrrd: every name of every type in both byte orders") {
  check_type<float>("float", ScalarType::float32);
  check_type<double>("double", ScalarType::float64);
  for (const char* name : {"uchar", "unsigned char", "uint8", "uint8_t"}) {
    check_type<std::uint8_t>(name, ScalarType::uint8);
  }
  for (const char* name :
       {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}) {
    check_type<std::uint16_t>(name, ScalarType::uint16);
  }
}

TEST_CASE("nrrd: a field without geometry has none") {
  const FieldFile field = read(raw_file(""));
  CHECK_FALSE(field.origin.has_value());
  CHECK_FALSE(field.spacing.has_value());
  CHECK(field.grid().spacing == Vec3{1, 1, 1});
  CHECK(field.grid().dims == kDims);
}

TEST_CASE("nrrd: the space origin is the centre of the first sample") {
  for (const char* centring : {"", "centerings: cell cell cell\n", "centers: node node node\n"}) {
    const FieldFile field =
        read(raw_file(std::string(centring) +
                      "space dimension: 3\nspace directions: (0.5,0,0) (0,0.25,0) (0,0,2)\n"
                      "space origin: (1, 2, 3)\n"));
    CHECK(field.spacing.value() == Vec3{0.5, 0.25, 2});
    CHECK(field.origin.value() == Vec3{0.75, 1.875, 2});
    CHECK(test::holds_values(field.view(), kDims));
  }
}

TEST_CASE("nrrd: axis mins are low corners of cells and centres of nodes") {
  const FieldFile cells =
      read(raw_file("axis mins: 1 2 3\naxis maxs: 3 5 4\ncenters: cell ??? none\n"));
  CHECK(cells.origin.value() == Vec3{1, 2, 3});
  CHECK(cells.spacing.value() == Vec3{0.5, 1, 0.5});
  const FieldFile nodes =
      read(raw_file("axismins: 1 2 3\naxis maxs: 2.5 4 4\ncenterings: node node node\n"));
  CHECK(nodes.origin.value() == Vec3{0.75, 1.5, 2.5});
  CHECK(nodes.spacing.value() == Vec3{0.5, 1, 1});
  const FieldFile spaced = read(raw_file("axis mins: 1 2 3\nspacings: 0.5 1 2\n"));
  CHECK(spaced.origin.value() == Vec3{1, 2, 3});
  CHECK(spaced.spacing.value() == Vec3{0.5, 1, 2});
}

TEST_CASE("nrrd: a space origin goes with spacings") {
  const FieldFile field =
      read(raw_file("space dimension: 3\nspacings: 1 2 4\nspace origin: (0,0,0)\n"));
  CHECK(field.origin.value() == Vec3{-0.5, -1, -2});
}

TEST_CASE("nrrd: directions in any order and sense are put right by strides") {
  // The axes of the file are y ascending, z descending, x descending.
  const FieldFile field = read(
      raw_file("space: left-posterior-superior\n"
               "space directions: (0,0.5,0) (0,0,-0.25) (-2,0,0)\nspace origin: (10,20,30)\n"));
  CHECK(field.dims == Index3{2, 4, 3});
  CHECK(field.spacing.value() == Vec3{2, 0.5, 0.25});
  // Last samples: x at 10 - 2, z at 30 - 2 * 0.25; half a cell lower are the corners.
  CHECK(field.origin.value() == Vec3{7, 19.75, 29.375});
  bool equal = true;
  test::for_cells(field.dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    equal = equal && test::element(field.view(), i, j, k) == test::value_at(j, 2 - k, 1 - i);
  });
  CHECK(equal);
}

TEST_CASE("nrrd: rounding in directions is no rotation") {
  const FieldFile field = read(
      raw_file("space dimension: 3\nspace directions: (0.5,1e-17,0) (0,0.25,-1e-12) (0,0,2)\n"));
  CHECK(field.spacing.value() == Vec3{0.5, 0.25, 2});
  CHECK_FALSE(field.origin.has_value());
}

TEST_CASE("nrrd: unusable axes are refused") {
  const auto refused = [](const std::string& fields, std::initializer_list<std::string> words) {
    check_refused(raw_file(fields), words);
  };
  refused("space directions: (0.7,0.7,0) (-0.7,0.7,0) (0,0,1)\n", {"rotated", "axis 0"});
  refused("space directions: (1,0,0) (0,1,2e-6) (0,0,1)\n", {"rotated", "axis 1"});
  refused("space directions: (1,0,0) (2,0,0) (0,0,1)\n", {"two space directions", "x"});
  refused("space directions: (0,0,0) (0,1,0) (0,0,1)\n", {"axis 0", "above 0"});
  refused("space directions: (nan,0,0) (0,1,0) (0,0,1)\n", {"not finite"});
  refused("space directions: none (0,1,0) (0,0,1)\n", {"axis 0", "no space direction"});
  refused("space directions: north (0,1,0) (0,0,1)\n", {"vectors"});
  refused("space directions: (1,0,0) (0,1,0)\n", {"needs 3 vectors and has 2"});
  refused("space directions: (1,0) (0,1) (0,1)\n", {"three components"});
  refused("space directions: (1,0,0) (0,1,0) (0,0,1) (0,0,1)\n", {"needs 3 vectors and has 4"});
  refused("space directions: (1,0,0) (0,1,0) (0,0,1)\nspacings: 1 1 1\n", {"exclude"});
  refused("space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (1,2,inf)\n", {"origin", "z"});
  refused("spacings: 1 0 1\n", {"spacing along axis 1 is 0"});
  refused("spacings: 1 1 -2\n", {"spacing along axis 2 is -2"});
  refused("spacings: nan 1 1\n", {"spacing along axis 0 is nan"});
  refused("spacings: 1 inf 1\n", {"spacing along axis 1 is inf"});
  refused("spacings: 1 1\n", {"'spacings'", "3 values"});
  refused("spacings: 1 1 x\n", {"'x'", "no number"});
  refused("axis mins: 0 0 0\naxis maxs: 4 -3 2\n", {"axis 1 is -1"});
  refused("axis mins: 0 0 0\naxis maxs: 4 3 2\nspacings: 1 1 2\n", {"axis 2", "mins and maxs"});
  refused("axis mins: nan 0 0\nspacings: 1 1 1\n", {"origin is not finite in x"});
  refused("space: 3D-right-handed-time\n", {"more than three"});
  refused("space dimension: 4\n", {"space dimension 4"});
  refused("kinds: RGB-color domain domain\n", {"RGB-color"});
}

TEST_CASE("nrrd: a node-centred axis of one sample has no spacing between its ends") {
  check_refused(
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 2 2\nencoding: raw\ncenters: node node node\n"
      "axis mins: 0 0 0\naxis maxs: 0 1 1\n\nabcd",
      {"spacing along axis 0"});
}

TEST_CASE("nrrd: gzip with one member or several") {
  const std::string data = test::elements<double>(kDims);
  const std::string start = header("encoding: gzip\n\n");
  CHECK(test::holds_values(read(start + gzipped(data)).view(), kDims));
  const std::string parts = gzipped(data.substr(0, 50)) + gzipped(data.substr(50, 1)) +
                            gzipped("") + gzipped(data.substr(51));
  CHECK(test::holds_values(read(start + parts).view(), kDims));
  CHECK(test::holds_values(read(start + gzipped(data) + "trailing").view(), kDims));
  const std::string skipped = header("encoding: gz\nbyte skip: 7\n\n") + gzipped("1234567" + data);
  CHECK(test::holds_values(read(skipped).view(), kDims));
}

TEST_CASE("nrrd: broken gzip streams are told apart") {
  const std::string data = test::elements<double>(kDims);
  const std::string start = header("encoding: gzip\n\n");
  std::string damaged = gzipped(data);
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
  check_refused(start + damaged, {"gzip"});
  std::string wrong_sum = gzipped(data);
  wrong_sum[wrong_sum.size() - 6] = static_cast<char>(wrong_sum[wrong_sum.size() - 6] ^ 1);
  check_refused(start + wrong_sum, {"damaged gzip", "incorrect data check"});
  check_refused(start + gzipped(data.substr(8)), {"truncated", "184 bytes", "192 wanted"});
  check_refused(start + gzipped(data + "x"), {"too long", "192 bytes"});
  check_refused(start + "this is not a gzip stream", {"damaged gzip", "incorrect header check"});
  check_refused(start, {"truncated"});
  const std::string whole = gzipped(data);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    check_refused(start + whole.substr(0, length), {"truncated"});
  }
  check_refused(header("encoding: gzip\nbyte skip: 1000\n\n") + whole, {"truncated", "byte 1000"});
}

TEST_CASE("nrrd: text data") {
  std::string numbers;
  test::for_cells(kDims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    numbers += std::to_string(static_cast<int>(test::value_at(i, j, k))) + (i == 3 ? "\n" : "  ");
  });
  for (const char* name : {"ascii", "text", "txt"}) {
    const FieldFile field =
        read(header("encoding: " + std::string(name) + "\n\n", "ushort") + numbers);
    CHECK(field.type == ScalarType::uint16);
    CHECK(test::holds_values(field.view(), kDims));
  }
  CHECK(test::holds_values(read(header("encoding: ascii\n\n", "float") + numbers).view(), kDims));
  const std::string start = header("encoding: ascii\n\n", "uchar");
  check_refused(start + "1 2 3", {"truncated", "24 numbers"});
  check_refused(start + "1" + std::string(100, ' '), {"24 numbers wanted, 1 found"});
  check_refused(start + "256 " + numbers, {"number 0", "'256'"});
  check_refused(start + "1 -1 " + numbers, {"number 1", "'-1'"});
  check_refused(start + "1 2 x " + numbers, {"number 2", "'x'"});
}

TEST_CASE("nrrd: data in another file beside the header") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "sub");
  const std::string data = test::elements<double>(kDims);
  (void)folder.file("sub/data.raw", data);
  for (const std::string field : {"data file", "datafile"}) {
    const auto path = folder.file("f.nhdr", header("encoding: raw\n" + field + ": sub/data.raw\n"));
    CHECK(test::holds_values(difmesh::read_field(path).view(), kDims));
  }
  (void)folder.file("sub/data.raw.gz", gzipped(data));
  const auto path = folder.file("F.NHDR", header("data file: sub/data.raw.gz\nencoding: gzip\n\n"));
  CHECK(test::holds_values(difmesh::read_field(path).view(), kDims));

  const auto refused = [&](const std::string& fields, ErrorCode code,
                           std::initializer_list<std::string> words) {
    const auto bad = folder.file("bad.nhdr", header("encoding: raw\n" + fields));
    check_error([&] { (void)difmesh::read_field(bad); }, code, words);
  };
  refused("data file: none.raw\n", ErrorCode::file_missing, {"none.raw"});
  refused("data file: sub\n", ErrorCode::file_format, {"sub", "not a regular file"});
  refused("data file:\n", ErrorCode::file_format, {"bad.nhdr", "no name"});
  (void)folder.file("sub/data.raw", data.substr(1));
  refused("data file: sub/data.raw\n", ErrorCode::file_format,
          {"data.raw", "192 bytes", "191 found"});
}

TEST_CASE("nrrd: lines and bytes before the data") {
  const TempFolder folder;
  const std::string data = test::elements<double>(kDims);
  (void)folder.file("data.raw", "one\ntwo two\nthree" + data);
  const auto with = [&](const std::string& fields) {
    return folder.file("f.nhdr", header("encoding: raw\ndata file: data.raw\n" + fields));
  };
  CHECK(
      test::holds_values(difmesh::read_field(with("line skip: 2\nbyte skip: 5\n")).view(), kDims));
  CHECK(test::holds_values(difmesh::read_field(with("byte skip: 17\n")).view(), kDims));
  CHECK(test::holds_values(difmesh::read_field(with("byteskip: -1\n")).view(), kDims));
  CHECK(
      test::holds_values(difmesh::read_field(with("lineskip: 1\nbyte skip: -1\n")).view(), kDims));
  const auto refused = [&](const std::string& fields, std::initializer_list<std::string> words) {
    check_error([&] { (void)difmesh::read_field(with(fields)); }, ErrorCode::file_format, words);
  };
  refused("line skip: 99\n", {"data.raw", "lines to skip"});
  refused("byte skip: 18\n", {"data.raw", "192 bytes", "191 found"});
  refused("byte skip: 9223372036854775807\n", {"data.raw", "0 found"});
  refused("byte skip: -2\n", {"byte skip", "-2"});
  refused("line skip: -1\n", {"line skip", "-1"});
  (void)folder.file("data.raw", data.substr(1));
  refused("byte skip: -1\n", {"data.raw", "192 bytes", "191 found"});
}

TEST_CASE("nrrd: line ends of other systems and keys and ignored fields") {
  std::string text = header(
      "encoding: raw\ncontent: a field: with a colon\nlabels: \"x\" \"y\" \"z\"\nUnits: \"m\" "
      "\"m\" \"m\"\n"
      "old min: 0\nmeasurement frame: (1,0,0) (0,1,0) (0,0,1)\na key:=any: := value\n");
  std::string with_returns;
  for (const char c : text) {
    with_returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
  }
  CHECK(test::holds_values(read(with_returns + "\r\n" + test::elements<double>(kDims)).view(),
                           kDims));
}

TEST_CASE("nrrd: malformed headers name the line and the matter") {
  check_refused("", {"does not start with NRRD"});
  check_refused("NRRD0006\n", {"line 1", "NRRD0006"});
  check_refused("NRRD00a1\n", {"line 1"});
  check_refused("NRRD0004\nnonsense\n\n", {"line 2", "neither"});
  check_refused("NRRD0004\ntypo: double\n\n", {"line 2", "unknown field 'typo'"});
  check_refused("NRRD0004\ntype: double\ntype: double\n\n", {"line 3", "twice"});
  check_refused("NRRD0004\ntype: complex\n\n", {"'complex'", "float, double and integers"});
  check_refused("NRRD0004\ntype: block\n\n", {"'block'"});
  check_refused("NRRD0004\nblock size: 4\n\n", {"blocks"});
  for (const char* dimension : {"2", "17", "x"}) {
    check_refused("NRRD0004\ndimension: " + std::string(dimension) + "\n\n",
                  {"dimension " + std::string(dimension)});
  }
  const std::string three = "NRRD0004\ntype: uchar\ndimension: 3\nencoding: raw\n";
  check_refused("NRRD0004\nencoding: bzip2\n\n", {"'bzip2'", "raw, gzip and ascii"});
  check_refused("NRRD0004\nencoding: hex\n\n", {"'hex'"});
  check_refused("NRRD0004\nendian: middle\n\n", {"'middle'"});
  check_refused(three + "sizes: 4 3\n\n", {"line 5", "'sizes'", "3 values and has 2"});
  check_refused(three + "sizes: 4 3 2.5\n\n", {"line 5", "'2.5'"});
  check_refused("NRRD0004\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n\n", {"no field 'type'"});
  check_refused("NRRD0004\ntype: double\nsizes: 4 3 2\nencoding: raw\n\n",
                {"no field 'dimension'"});
  check_refused("NRRD0004\ntype: double\ndimension: 3\nencoding: raw\n\n", {"no field 'sizes'"});
  check_refused("NRRD0004\ntype: double\ndimension: 3\nsizes: 4 3 2\n\n", {"no field 'encoding'"});
  check_refused("NRRD0004\ntype: double\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n\n",
                {"no field 'endian'"});
  check_refused(header("encoding: raw\n"), {"no blank line"});
}

TEST_CASE("nrrd: no cells and cells beyond counting and cells beyond the file") {
  const auto with_sizes = [](const std::string& sizes, const std::string& encoding) {
    return "NRRD0004\ntype: double\ndimension: 3\nsizes: " + sizes +
           "\nendian: little\nencoding: " + encoding + "\n\n" + gzipped(std::string(1000, 'x'));
  };
  check_refused(with_sizes("4 0 2", "raw"), {"4 x 0 x 2"});
  check_refused(with_sizes("4 -3 2", "raw"), {"4 x -3 x 2"});
  check_refused(with_sizes("4294967296 4294967296 4", "raw"), {"overflows"}, ErrorCode::too_large);
  for (const char* encoding : {"raw", "gzip", "ascii"}) {
    check_refused(
        with_sizes("1024 1048576 1024", encoding),
        {"truncated", encoding[0] == 'a' ? "1099511627776 numbers" : "8796093022208 bytes"});
  }
}

TEST_CASE("nrrd: truncated raw data name both numbers") {
  std::string bytes = raw_file("");
  bytes.resize(bytes.size() - 3);
  check_refused(bytes, {"truncated", "192 bytes", "189 found"});
}

TEST_CASE("nrrd: spacing and origin come back to the last bit") {
  const TempFolder folder;
  const std::vector<double> cells(24, 0.5);
  const auto field = difmesh::FieldView::x_fastest(cells.data(), kDims);
  for (const difmesh::Grid& grid :
       {difmesh::Grid{kDims, {-0.5, -0.5, -0.5}, {0.015625, 0.015625, 0.015625}},
        difmesh::Grid{kDims, {0.1, -0.2, 1e-17}, {0.1, 1.0 / 3.0, 0.7}},
        difmesh::Grid{kDims, {1e6 + 0.1, -1e-3, 3.3e9}, {1e-3, 2e2, 4.0 / 7.0}}}) {
    difmesh::write_field(folder / "f.nrrd", field, grid);
    const FieldFile back = difmesh::read_field(folder / "f.nrrd");
    CHECK(back.grid().origin == grid.origin);
    CHECK(back.grid().spacing == grid.spacing);
  }
}

TEST_CASE("nrrd: a moved origin wins over the kept low corner") {
  const FieldFile moved =
      read(raw_file("space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                    "space origin: (10.5,20.5,30.5)\ndifmesh_low_corner:=0 0 0\n"));
  check_close(moved.origin.value(), {10, 20, 30});
  const FieldFile nonsense =
      read(raw_file("space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                    "space origin: (10.5,20.5,30.5)\ndifmesh_low_corner:=0 x\n"));
  check_close(nonsense.origin.value(), {10, 20, 30});
}

TEST_CASE("nrrd: a written header says what other programs look for") {
  const TempFolder folder;
  const std::vector<float> cells(24, 0.5F);
  difmesh::write_field(folder / "f.nrrd", difmesh::FieldView::x_fastest(cells.data(), kDims),
                       difmesh::Grid{kDims, {1, 2, 3}, {0.5, 0.25, 2}}, {.gzip = false});
  const std::string bytes = test::read_bytes(folder / "f.nrrd");
  for (const char* line :
       {"NRRD0004\n", "\ntype: float\n", "\ndimension: 3\n", "\nspace dimension: 3\n",
        "\nsizes: 4 3 2\n", "\nspace directions: (0.5,0,0) (0,0.25,0) (0,0,2)\n",
        "\nspace origin: (1.25,2.125,4)\n", "\ncenterings: cell cell cell\n", "\nendian: little\n",
        "\nencoding: raw\n"}) {
    CAPTURE(line);
    CHECK(bytes.find(line) != std::string::npos);
  }
  CHECK(bytes.size() == bytes.find("\n\n") + 2 + 24 * 4);
}

TEST_CASE("nrrd: a changed byte gives a field of the right size or an error") {
  const TempFolder folder;
  const std::string bytes =
      header(
          "encoding: gzip\nspace dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
          "space origin: (0,0,0)\n\n") +
      gzipped(test::elements<double>(kDims));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const char change : {'\1', '\x10', '\x7f'}) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ change);
      const auto path = folder.file("f.nrrd", changed);
      try {
        const FieldFile field = difmesh::read_field(path);
        CHECK(field.cells.size() <= 1032 * bytes.size());
      } catch (const difmesh::Error& error) {
        CHECK(std::string(error.what()).find("'") != std::string::npos);
      }
    }
  }
}
