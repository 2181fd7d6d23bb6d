// NRRD files as other programs write them.

#include <zlib.h>

#include <algorithm>
#include <string>

#include "difmesh/io/field_file.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::FieldFile;
using difmesh::Index3;
using difmesh::ReadFieldOptions;
using difmesh::Vec3;
using test::check_error;
using test::TempFolder;

constexpr Index3 kDims{4, 3, 2};

std::string header(const std::string& fields, const std::string& sizes = "4 3 2") {
  return "NRRD0005\ntype: float\ndimension: " +
         std::to_string(1 + std::count(sizes.begin(), sizes.end(), ' ')) + "\nsizes: " + sizes +
         "\nendian: little\n" + fields;
}

std::string attached(const std::string& fields, const std::string& sizes = "4 3 2") {
  return header("encoding: raw\n" + fields + "\n", sizes) + test::elements<float>(kDims);
}

std::string deflated(const std::string& data, int window) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 6, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) == Z_OK);
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

std::string gzipped(const std::string& data) {
  return deflated(data, 31);
}

FieldFile read(const std::string& bytes, const ReadFieldOptions& options = {}) {
  const TempFolder folder;
  return difmesh::read_field(folder.file("f.nrrd", bytes), options);
}

void check_refused(const std::string& bytes, std::initializer_list<std::string> words,
                   const ReadFieldOptions& options = {}) {
  const TempFolder folder;
  const auto path = folder.file("bad_field.nrrd", bytes);
  check_error([&] { (void)difmesh::read_field(path, options); }, ErrorCode::file_format,
              {"bad_field.nrrd"});
  check_error([&] { (void)difmesh::read_field(path, options); }, ErrorCode::file_format, words);
}

/// Cuts the samples into so many equal pieces.
std::string piece(std::size_t index, std::size_t count) {
  const std::string data = test::elements<float>(kDims);
  return data.substr(index * data.size() / count, data.size() / count);
}

}  // namespace

TEST_CASE("nrrd found: directions with the rounding of single precision lie along the axes") {
  const FieldFile field =
      read(attached("space: left-posterior-superior\n"
                    "space directions: (0.5,1.2e-08,0) (-4.9e-07,-0.5,0) (0,1e-06,1.25)\n"
                    "space origin: (0,0,0)\n"));
  CHECK(field.spacing.value() == Vec3{0.5, 0.5, 1.25});
  CHECK(field.origin.value() == Vec3{-0.25, -1.25, -0.625});
  CHECK(field.warnings.empty());
}

TEST_CASE("nrrd found: a spacing of the user's is taken before a wrong one is judged") {
  for (const char* fields : {"spacings: 1 1 0\n", "spacings: nan nan nan\n", "spacings: 1 -1 inf\n",
                             "axis mins: 0 0 0\naxis maxs: 4 -3 2\n",
                             "axis mins: 0 0 0\naxis maxs: 4 3 2\nspacings: 1 1 9\n",
                             "space directions: (0,0,0) (0,1,0) (0,0,1)\n",
                             "space directions: (nan,0,0) (0,1,0) (0,0,1)\n",
                             "space directions: (1,0,0) (1,0,0) (0,0,1)\n",
                             "space directions: (1,0,0) (0,1,0) (0,0,1)\nspacings: 1 1 1\n"}) {
    CAPTURE(fields);
    check_refused(attached(fields), {""});
    const FieldFile field = read(attached(fields), {.spacing = Vec3{1, 2, 3}});
    CHECK(field.spacing.value() == Vec3{1, 2, 3});
    CHECK(test::holds_values(field.view(), kDims));
  }
}

TEST_CASE(
    "nrrd found: rotated axes are taken in the order of the file where the user places them") {
  const std::string fields =
      "space directions: (0.7,0.7,0) (-0.7,0.7,0) (0,0,1)\nspace origin: (1,nan,3)\n";
  const ReadFieldOptions both{.origin = Vec3{5, 6, 7}, .spacing = Vec3{1, 2, 3}};
  check_refused(attached(fields), {"rotated", "spacing and an origin given"});
  check_refused(attached(fields), {"rotated"}, {.spacing = Vec3{1, 2, 3}});
  check_refused(attached(fields), {"rotated"}, {.origin = Vec3{1, 2, 3}});
  const FieldFile field = read(attached(fields), both);
  CHECK(field.origin.value() == Vec3{5, 6, 7});
  CHECK(field.spacing.value() == Vec3{1, 2, 3});
  CHECK(test::holds_values(field.view(), kDims));
  REQUIRE(field.warnings.size() == 1);
  CHECK(field.warnings[0].find("rotated") != std::string::npos);
  CHECK(field.warnings[0].find("f.nrrd") != std::string::npos);
  // Axes that make sense keep their order and sense.
  const FieldFile turned =
      read(attached("space directions: (0,0.5,0) (0,0,-0.25) (-2,0,0)\n"), both);
  CHECK(turned.dims == Index3{2, 4, 3});
  CHECK(turned.warnings.empty());
  CHECK(test::element(turned.view(), 1, 3, 0) == test::value_at(3, 2, 0));
}

TEST_CASE("nrrd found: an origin that is not finite yields to the user's") {
  const std::string fields = "spacings: 1 2 4\nspace origin: (nan,0,0)\n";
  check_refused(attached(fields), {"origin"});
  CHECK(read(attached(fields), {.origin = Vec3{1, 2, 3}}).origin.value() == Vec3{1, 2, 3});
  // Half of the user's spacing lies between corner and centre where the file's cannot be used.
  const FieldFile spaced =
      read(attached("spacings: 0 2 4\nspace origin: (10,20,30)\n"), {.spacing = Vec3{1, 1, 1}});
  CHECK(spaced.origin.value() == Vec3{9.5, 19, 28});
}

TEST_CASE("nrrd found: gzip whose last bytes are the data") {
  const std::string data = test::elements<float>(kDims);
  const std::string start = header("encoding: gzip\nbyte skip: -1\n\n");
  for (const std::size_t before : {0U, 1U, 95U, 96U, 97U, 1000U, 40000000U}) {
    CAPTURE(before);
    CHECK(test::holds_values(read(start + gzipped(std::string(before, 'x') + data)).view(), kDims));
  }
  CHECK(test::holds_values(
      read(start + gzipped("something " + data.substr(0, 7)) + gzipped(data.substr(7))).view(),
      kDims));
  check_refused(start + gzipped(data.substr(1)), {"truncated", "95 bytes", "96 wanted"});
  check_refused(start + gzipped(data).substr(0, 30), {"truncated"});
  std::string wrong_sum = gzipped(data);
  wrong_sum[wrong_sum.size() - 6] = static_cast<char>(wrong_sum[wrong_sum.size() - 6] ^ 1);
  check_refused(start + wrong_sum, {"incorrect data check"});
}

TEST_CASE(
    "nrrd found: bytes to skip are bounded by what a file can sensibly have before its data") {
  // 1.1 GB of zeros, in members of 2^20 bytes.
  const std::string member = gzipped(std::string(1 << 20, '\0'));
  std::string zeros;
  for (int n = 0; n < 1100; ++n) {
    zeros += member;
  }
  check_refused(header("encoding: gzip\nbyte skip: 1100000000\n\n") + zeros,
                {"'byte skip' of 1100000000", "1073741824"});
  check_refused(header("encoding: gzip\nbyte skip: 100000000000\n\n") + gzipped("few"),
                {"too few even for gzip"});
}

TEST_CASE("nrrd found: names of gzip and data of zlib") {
  const std::string data = test::elements<float>(kDims);
  for (const char* name : {"gzip", "gz", "gzi", "GZip"}) {
    const std::string start = header("encoding: " + std::string(name) + "\n\n");
    CHECK(test::holds_values(read(start + gzipped(data)).view(), kDims));
    CHECK(test::holds_values(read(start + deflated(data, 15)).view(), kDims));
  }
}

TEST_CASE("nrrd found: a byte order mark before the header") {
  CHECK(test::holds_values(read("\xef\xbb\xbf" + attached("")).view(), kDims));
}

TEST_CASE("nrrd found: data in a list of files") {
  const TempFolder folder;
  for (std::size_t n = 0; n < 6; ++n) {
    (void)folder.file("row" + std::to_string(n) + ".raw", "skip" + piece(n, 6));
  }
  for (std::size_t n = 0; n < 2; ++n) {
    (void)folder.file("slice " + std::to_string(n) + ".gz", gzipped(piece(n, 2)));
  }
  (void)folder.file("whole.raw", piece(0, 1));
  const auto check = [&](const std::string& fields, const std::string& line_end = "\n") {
    CAPTURE(fields);
    std::string text;
    for (const char c : header(fields)) {
      text += c == '\n' ? line_end : std::string(1, c);
    }
    CHECK(test::holds_values(difmesh::read_field(folder.file("f.nhdr", text)).view(), kDims));
  };
  const std::string slices = "encoding: gzip\ndata file: LIST\nslice 0.gz\nslice 1.gz";
  check(slices);
  check(slices + "\n", "\r\n");
  check(slices + "\n\n");
  check("encoding: gzip\ndata file: LIST 2\nslice 0.gz\nslice 1.gz\n");
  check("encoding: gzip\ndata file: LIST 3\nslice 0.gz\nslice 1.gz\n");
  check("encoding: raw\ndata file: LIST\nwhole.raw\n");
  check(
      "encoding: raw\nbyte skip: 4\ndata file: LIST 1\nrow0.raw\nrow1.raw\nrow2.raw\nrow3.raw\n"
      "row4.raw\nrow5.raw\n");
  check("encoding: raw\nbyte skip: -1\ndata file: row%d.raw 0 5 1 1\n");
  const auto refused = [&](const std::string& fields, ErrorCode code,
                           std::initializer_list<std::string> words) {
    const auto path = folder.file("bad.nhdr", header(fields));
    check_error([&] { (void)difmesh::read_field(path); }, code, words);
  };
  refused("encoding: raw\ndata file: LIST\n", ErrorCode::file_format, {"bad.nhdr", "0 data files"});
  refused("encoding: gzip\ndata file: LIST\nslice 0.gz\nslice 1.gz\nslice 0.gz\n",
          ErrorCode::file_format, {"bad.nhdr", "3 data files of dimension 2"});
  refused("encoding: gzip\ndata file: LIST 1\nslice 0.gz\nslice 1.gz\n", ErrorCode::file_format,
          {"2 data files of dimension 1"});
  refused("encoding: gzip\ndata file: LIST 4\nslice 0.gz\nslice 1.gz\n", ErrorCode::file_format,
          {"dimension 4"});
  refused("encoding: gzip\ndata file: LIST\nslice 0.gz\nslice 2.gz\n", ErrorCode::file_missing,
          {"slice 2.gz"});
  refused("encoding: raw\ndata file: LIST\nrow0.raw\nwhole.raw\n", ErrorCode::file_format,
          {"row0.raw", "48 bytes", "20 found"});
  refused("encoding: raw\ndata file: LIST\n../a.raw\nwhole.raw\n", ErrorCode::file_format,
          {"bad.nhdr", "../a.raw", "allowed"});
}

TEST_CASE("nrrd found: data in numbered files") {
  const TempFolder folder;
  (void)folder.file("s08.raw", piece(0, 2));
  (void)folder.file("s10.raw", piece(1, 2));
  (void)folder.file("t5", piece(1, 2));
  (void)folder.file("t  7.x", piece(0, 2));
  (void)folder.file("50%d.raw", piece(0, 1));
  const auto with = [&](const std::string& files) {
    return folder.file("f.nhdr", header("encoding: raw\ndata file: " + files + "\n"));
  };
  CHECK(test::holds_values(difmesh::read_field(with("s%02d.raw 8 10 2")).view(), kDims));
  CHECK(test::holds_values(difmesh::read_field(with("s%02d.raw 8 11 2 2")).view(), kDims));
  CHECK(test::holds_values(difmesh::read_field(with("s%02u.raw 8 10 2 3")).view(), kDims));
  CHECK(test::holds_values(difmesh::read_field(with("50%d.raw")).view(), kDims));
  (void)folder.file("t7", piece(0, 2));
  CHECK(test::holds_values(difmesh::read_field(with("t%d 7 5 -2")).view(), kDims));
  const auto refused = [&](const std::string& files, std::initializer_list<std::string> words) {
    check_error([&] { (void)difmesh::read_field(with(files)); }, ErrorCode::file_format, words);
  };
  for (const char* files : {"a%s.raw 1 2 1", "a%d%d.raw 1 2 1", "a%.raw 1 2 1", "a%05 1 2 1",
                            "a%n 1 2 1", "a%99999d 1 2 1", "a%-5d 1 2 1", "a%d 1 2 0", "a%d -1 0 1",
                            "a%d 1 9223372036854775807 1", "a%d 1 2 -9223372036854775807"}) {
    CAPTURE(files);
    refused(files, {"f.nhdr", "line 7", "slice%03d.raw"});
  }
  refused("a%d 2 1 1", {"no number from 2 to 1"});
  refused("a%d 1 100000 1", {"100000 data files"});
  refused("a%d 1 3 1", {"3 data files of dimension 2"});
}

TEST_CASE("nrrd found: one channel beside three axes in space") {
  const std::string space =
      "space: left-posterior-superior\nspace origin: (0.25,0.5,1)\nspace directions: ";
  for (const std::string& text :
       {attached(space + "none (0.5,0,0) (0,1,0) (0,0,2)\nkinds: scalar domain domain domain\n",
                 "1 4 3 2"),
        attached(space + "(0.5,0,0) (0,1,0) (0,0,2) none\nkinds: domain domain domain list\n",
                 "4 3 2 1"),
        attached(space + "none (0.5,0,0) (0,1,0) (0,0,2)\nspace units: \"mm\" \"mm\" \"mm\"\n",
                 "1 4 3 2"),
        attached(space + "(0.5,0,0) (0,1,0) none (0,0,2) none\n", "4 3 1 2 1"),
        attached("spacings: nan 0.5 1 2\naxis mins: nan 0 0 0\nkinds: vector space space space\n"
                 "centers: none cell cell cell\n",
                 "1 4 3 2"),
        attached("spacings: 0.5 1 2 nan\naxis mins: 0 0 0 nan\n", "4 3 2 1")}) {
    CAPTURE(text.substr(0, 200));
    const FieldFile field = read(text);
    CHECK(test::holds_values(field.view(), kDims));
    CHECK(field.spacing.value() == Vec3{0.5, 1, 2});
    CHECK(field.origin.value() == Vec3{0, 0, 0});
  }
  check_refused(attached("", "2 2 3 2"), {"dimension 4"});
  check_refused(attached("", "1 4 6 1"), {"dimension 4", "clear"});
  check_refused(attached("kinds: vector domain domain domain\n", "2 2 3 2"), {"'vector'"});
  check_refused(attached("kinds: domain domain domain\n", "1 4 3 2"), {"'kinds'", "4 values"});
  check_refused(attached(space + "(1,0,0) (0,1,0) (0,0,1)\n", "1 4 3 2"), {"4 vectors and has 3"});
}
