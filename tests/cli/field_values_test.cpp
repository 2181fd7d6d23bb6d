// What the values of a field stand for, and where its data may lie, on the command line.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "io/files.hpp"
#include "program.hpp"

namespace {

using difmesh::Index3;
using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::Outcome;
using difmesh::test::run_program;
using test::TempFolder;
using Words = std::vector<std::string>;

constexpr Index3 kDims{9, 8, 7};

/// Two boxes of labels 3 and 5 in label 0.
template <class T>
std::string labels() {
  std::string bytes;
  test::for_cells(kDims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const bool inside = i > 0 && i < 8 && j > 0 && j < 7 && k > 0 && k < 6;
    bytes += test::bytes_of(static_cast<T>(!inside ? 0 : i < 4 ? 3 : 5));
  });
  return bytes;
}

std::string nrrd(const std::string& type, const std::string& fields, const std::string& data) {
  return "NRRD0004\ntype: " + type +
         "\ndimension: 3\nsizes: 9 8 7\nendian: little\nencoding: raw\n" + fields + "\n" + data;
}

Outcome reconstruct(const std::filesystem::path& field, Words options) {
  Words arguments{"reconstruct", field.string(),
                  "-o",          (field.parent_path() / "out.obj").string(),
                  "--report",    "-"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_program(arguments);
}

double fraction_volume(const std::filesystem::path& field, const Words& options) {
  const Outcome outcome = reconstruct(field, options);
  check_succeeds(outcome);
  return nlohmann::json::parse(outcome.out)["field"]["fraction_volume"];
}

}  // namespace

TEST_CASE("reconstruct takes labels and values of every integer type") {
  const TempFolder folder;
  const auto check = [&](const std::filesystem::path& field) {
    CAPTURE(field.string());
    CHECK(fraction_volume(field, {"--label", "3"}) == 3 * 6 * 5);
    CHECK(fraction_volume(field, {"--label", "5,3,77"}) == 7 * 6 * 5);
    CHECK(fraction_volume(field, {"--full-value", "5", "--empty-value", "3"}) == 4 * 6 * 5);
    CHECK(fraction_volume(field, {"--full-value", "3"}) == 7 * 6 * 5);
  };
  check(folder.file("u8.nrrd", nrrd("uint8", "", labels<std::uint8_t>())));
  check(folder.file("i16.nrrd", nrrd("short", "", labels<std::int16_t>())));
  check(folder.file("i64.nrrd", nrrd("int64", "", labels<std::int64_t>())));
  check(folder.file("f64.nrrd", nrrd("double", "", labels<double>())));
  const auto raw = folder.file("labels.raw", labels<std::int32_t>());
  CHECK(fraction_volume(raw, {"--raw-dims", "9,8,7", "--raw-type", "int32", "--label", "3"}) == 90);
}

TEST_CASE("reconstruct and info name the highest value of a mask taken for fractions") {
  const TempFolder folder;
  for (const char* type : {"uint8", "int64"}) {
    CAPTURE(type);
    const std::string data = type[0] == 'u' ? labels<std::uint8_t>() : labels<std::int64_t>();
    const auto field = folder.file("mask.nrrd", nrrd(type, "", data));
    const Outcome made = reconstruct(field, {});
    CHECK(made.exit_code == 0);
    const nlohmann::json report = nlohmann::json::parse(made.out);
    CHECK(report["mesh"]["triangles"] == 0);
    CHECK(report["field"]["type"] == type);
    REQUIRE(report["warnings"].size() == 1);
    CHECK(report["warnings"][0].get<std::string>().find("highest value is 5") != std::string::npos);
    const Outcome told = run_program({"info", field.string()});
    for (const std::string& text : {made.err, told.err}) {
      CAPTURE(text);
      CHECK(text.find("difmesh: warning: ") == 0);
      CHECK(text.find("mask.nrrd") != std::string::npos);
      CHECK(text.find("highest value is 5") != std::string::npos);
    }
    CHECK(std::count(told.err.begin(), told.err.end(), '\n') == 1);
    check_succeeds(run_program({"info", field.string(), "--label", "5"}));
    check_succeeds(run_program({"info", field.string(), "--full-value", "5"}));
  }
}

TEST_CASE("reconstruct warns of a mask of a high value that is taken for fractions") {
  const TempFolder folder;
  std::string data = labels<std::uint8_t>();
  std::replace_if(
      data.begin(), data.end(), [](char value) { return value != 0; }, static_cast<char>(200));
  const auto field = folder.file("mask.nrrd", nrrd("uint8", "", data));
  const std::string wanted = "difmesh: warning: '" + field.string() +
                             "': the highest value is 200, and 255 of uint8 counts as full unless "
                             "--full-value or --label are given\n";
  const Outcome made = reconstruct(field, {});
  CHECK(made.exit_code == 0);
  CHECK(made.err == wanted);
  CHECK(run_program({"info", field.string()}).err == wanted);
  const Outcome shown =
      run_program({"view", field.string(), "-o", (field.parent_path() / "page.html").string()});
  CHECK(shown.exit_code == 0);
  CHECK(shown.err == wanted);
  check_succeeds(reconstruct(field, {"--label", "200"}));
  check_succeeds(reconstruct(field, {"--full-value", "200"}));
}

TEST_CASE("a spacing and an origin on the command line win over what makes no sense in the file") {
  const TempFolder folder;
  const auto zero =
      folder.file("zero.nrrd", nrrd("uint8", "spacings: 1 1 0\n", labels<std::uint8_t>()));
  check_fails(reconstruct(zero, {"--label", "3"}), 1, {"zero.nrrd", "spacing along axis 2"});
  CHECK(fraction_volume(zero, {"--label", "3", "--spacing", "2"}) == 8 * 90);
  const auto oblique = folder.file(
      "oblique.nrrd",
      nrrd("uint8", "space directions: (1,1,0) (-1,1,0) (0,0,1)\nspace origin: (0,0,0)\n",
           labels<std::uint8_t>()));
  check_fails(reconstruct(oblique, {"--spacing", "1"}), 1, {"rotated", "origin"});
  const Outcome made = reconstruct(oblique, {"--label", "3", "--spacing", "1", "--origin", "0"});
  CHECK(made.exit_code == 0);
  CHECK(made.err.find("difmesh: warning: ") == 0);
  CHECK(made.err.find("rotated") != std::string::npos);
}

TEST_CASE("data outside the folder of a header need to be allowed") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "inner");
  (void)folder.file("data.raw", labels<std::uint8_t>());
  const auto header = folder.file("inner/f.nhdr", nrrd("uint8", "data file: ../data.raw\n", ""));
  check_fails(run_program({"info", header.string(), "--label", "3"}), 1,
              {"f.nhdr", "../data.raw", "allowed"});
  check_succeeds(run_program({"info", header.string(), "--label", "3", "--allow-outside"}));
}

#if defined(DIFMESH_WITH_METRICS)
TEST_CASE("buffers outside the folder of a glTF file need to be allowed by every command") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "inner");
  const auto field = folder.file("f.nrrd", nrrd("uint8", "", labels<std::uint8_t>()));
  const std::string glb_path = (folder / "m.glb").string();
  check_succeeds(
      run_program({"reconstruct", field.string(), "--label", "3", "-o", glb_path, "--quiet"}));
  const std::string glb = test::read_bytes(glb_path);
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof length);
  nlohmann::json json = nlohmann::json::parse(glb.substr(20, length));
  json["buffers"][0]["uri"] = "../m.bin";
  (void)folder.file("m.bin", glb.substr(20 + length + 8));
  const std::string mesh = folder.file("inner/m.gltf", json.dump()).string();
  const std::string out = (folder / "out").string();
  for (const Words& words :
       {Words{"info", mesh}, Words{"sample", mesh, "-o", out + ".npy", "--cells", "8"},
        Words{"compare", mesh, "--reference", glb_path},
        Words{"compare", glb_path, "--reference", mesh},
        Words{"reconstruct", field.string(), "--label", "3", "-o", out + ".glb", "--color-by",
              "error", "--reference", mesh}}) {
    CAPTURE(words[0]);
    const Outcome refused = run_program(words);
    CHECK(refused.exit_code == 1);
    CHECK(refused.err.find("outside") != std::string::npos);
    Words allowed = words;
    allowed.emplace_back("--allow-outside");
    CHECK(run_program(allowed).exit_code == 0);
  }
}
#endif

TEST_CASE("options of values are checked") {
  const TempFolder folder;
  const auto field = folder.file("f.nrrd", nrrd("uint8", "", labels<std::uint8_t>()));
  const auto fails = [&](const Words& options, std::initializer_list<std::string> words) {
    Words arguments{"info", field.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    check_fails(run_program(arguments), 2, words);
  };
  fails({"--label", "x"}, {"--label", "'x'"});
  fails({"--label", "1,,2"}, {"--label"});
  fails({"--label", "1.5"}, {"--label"});
  fails({"--full-value", "nan"}, {"--full-value"});
  fails({"--full-value", "0"}, {"differ"});
  fails({"--empty-value", "1"}, {"--full-value"});
  fails({"--label", "1", "--full-value", "2"}, {"--full-value"});
}

TEST_CASE("too little memory is said with the file and the bytes") {
#ifndef DIFMESH_SANITIZED  // whose shadow memory needs all addresses
  const TempFolder folder;
  const auto field = folder.file("large.raw", "");
  std::filesystem::resize_file(field, std::uintmax_t{1} << 32U);  // of holes only
  difmesh::test::Launch launch;
  launch.arguments = {"info", field.string(), "--raw-dims", "4096,4096,256", "--raw-type", "uint8"};
  launch.memory_limit = std::uint64_t{1} << 31U;
  check_fails(run_program(launch), 1, {"large.raw", "out of memory", "4294967296 bytes"});
#endif
}
