// Files that a file names: where they may lie; and files for which there is no memory.

#include "linked_file.hpp"

#include <sys/resource.h>

#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/out_of_memory.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::Index3;
using test::check_error;
using test::TempFolder;

constexpr Index3 kDims{4, 3, 2};

/// A folder with a header and data in and beside it.
struct Place {
  TempFolder folder;
  std::string data = test::elements<float>(kDims);

  Place() {
    std::filesystem::create_directories(folder / "inner/sub");
    (void)folder.file("outside.raw", data);
    (void)folder.file("inner/inside.raw", data);
    (void)folder.file("inner/sub/below.raw", data);
  }
  [[nodiscard]] std::filesystem::path header(const std::string& data_file) const {
    return folder.file("inner/f.nhdr",
                       "NRRD0004\ntype: float\ndimension: 3\nsizes: 4 3 2\nendian: little\n"
                       "encoding: raw\ndata file: " +
                           data_file + "\n");
  }
  void link(const std::string& target, const std::string& name) const {
    std::filesystem::create_symlink(target, folder / name);
  }
};

void check_read(const std::filesystem::path& path, bool outside) {
  CAPTURE(path.string());
  const difmesh::FieldFile field = difmesh::read_field(path, {.outside_files = outside});
  CHECK(test::holds_values(field.view(), kDims));
}

void check_outside(const std::filesystem::path& path) {
  check_error([&] { (void)difmesh::read_field(path); }, ErrorCode::file_format,
              {"f.nhdr", "allowed"});
}

}  // namespace

TEST_CASE("linked files: in the folder and below they are read") {
  const Place place;
  place.link("sub/below.raw", "inner/link.raw");
  place.link("sub", "inner/folder_link");
  place.link((place.folder / "inner/inside.raw").string(), "inner/absolute_link.raw");
  for (const char* name : {"inside.raw", "sub/below.raw", "./sub/../inside.raw", "link.raw",
                           "folder_link/below.raw", "absolute_link.raw", "sub//below.raw"}) {
    CAPTURE(name);
    check_read(place.header(name), false);
    check_read(place.header(name), true);
  }
  // The folder itself may be reached by links and from anywhere.
  place.link("inner", "way");
  (void)place.header("sub/below.raw");
  check_read(place.folder / "way/f.nhdr", false);
  check_read(place.folder / "inner/sub/../f.nhdr", false);
}

TEST_CASE("linked files: outside the folder they are read only where that is allowed") {
  const Place place;
  place.link("../outside.raw", "inner/link.raw");
  place.link("..", "inner/sub/up");
  place.link((place.folder / "outside.raw").string(), "inner/absolute_link.raw");
  for (const std::string& name :
       {std::string("../outside.raw"), std::string("sub/../../outside.raw"),
        (place.folder / "outside.raw").string(), (place.folder / "inner/inside.raw").string(),
        std::string("link.raw"), std::string("absolute_link.raw"),
        std::string("sub/up/../outside.raw")}) {
    CAPTURE(name);
    const auto path = place.header(name);
    check_outside(path);
    check_read(path, true);
  }
  check_outside(place.header("/etc/passwd"));
  check_outside(place.header(".."));
}

TEST_CASE("linked files: a name with a zero in it names no file") {
  const Place place;
  for (const std::string& name :
       {std::string("inside.raw\0", 11), std::string("inside.raw\0x", 12)}) {
    for (const bool outside : {false, true}) {
      const auto path = place.header(name);
      check_error([&] { (void)difmesh::read_field(path, {.outside_files = outside}); },
                  ErrorCode::file_format, {"f.nhdr", "a zero"});
    }
  }
}

TEST_CASE("linked files: a folder whose name begins with two dots is no way up") {
  const Place place;
  std::filesystem::create_directory(place.folder / "inner/..data");
  (void)place.folder.file("inner/..data/f.raw", place.data);
  check_read(place.header("..data/f.raw"), false);
}

TEST_CASE("linked files: a pointer in the place of data is named as such") {
  const Place place;
  (void)place.folder.file("inner/inside.raw",
                          "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 96\n");
  for (const bool outside : {false, true}) {
    const auto path = place.header("inside.raw");
    check_error([&] { (void)difmesh::read_field(path, {.outside_files = outside}); },
                ErrorCode::file_format, {"inside.raw", "Git LFS"});
  }
}

TEST_CASE("linked files: in the current folder by a bare name") {
  const Place place;
  (void)place.header("sub/below.raw");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(place.folder / "inner");
  check_read("f.nhdr", false);
  std::filesystem::current_path(before);
}

TEST_CASE("linked files: what is missing or no file is said so") {
  const Place place;
  place.link("nowhere.raw", "inner/dangling.raw");
  for (const char* name : {"none.raw", "dangling.raw", "inside.raw/x"}) {
    CAPTURE(name);
    const auto path = place.header(name);
    check_error([&] { (void)difmesh::read_field(path); }, ErrorCode::file_missing, {"inner", name});
  }
  for (const char* name : {"sub", "."}) {
    const auto path = place.header(name);
    check_error([&] { (void)difmesh::read_field(path); }, ErrorCode::file_format,
                {"not a regular file"});
  }
}

#ifndef DIFMESH_SANITIZED  // whose shadow memory needs all addresses
namespace {

/// The message of the OutOfMemory that an action throws in an address space of 3 GiB.
template <class Action>
std::string message_without_memory(const Action& action) {
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_AS, &before) == 0);
  rlimit little = before;
  little.rlim_cur = std::uint64_t{3} << 30;
  REQUIRE(::setrlimit(RLIMIT_AS, &little) == 0);
  std::string message;
  try {
    action();
  } catch (const difmesh::OutOfMemory& error) {
    message = error.what();
  } catch (...) {
    message = "another error";
  }
  REQUIRE(::setrlimit(RLIMIT_AS, &before) == 0);
  return message;
}

/// A file of 4 GiB, of holes only but for its start.
std::filesystem::path large_file(const TempFolder& folder, const std::string& name) {
  const auto path = folder.file(name, name.ends_with(".stl") ? "solid" : "");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 32U);
  return path;
}

}  // namespace

TEST_CASE("memory: where there is none the error names the file and the bytes") {
  const TempFolder folder;
  const auto raw = large_file(folder, "large.raw");
  std::vector<std::string> messages{message_without_memory([&] {
    (void)difmesh::read_field(
        raw, {.dims = {1 << 12, 1 << 12, 1 << 8}, .type = difmesh::ValueType::uint8});
  })};
  for (const char* name : {"large.obj", "large.off"}) {
    const auto path = large_file(folder, name);
    messages.push_back(message_without_memory([&] { (void)difmesh::read_mesh(path); }));
  }
  for (const std::string& message : messages) {
    CAPTURE(message);
    CHECK(message.find("large.") != std::string::npos);
    CHECK(message.find("4294967296 bytes") != std::string::npos);
  }
}
#endif
