#include "atomic_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>

#include <csignal>
#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "io/files.hpp"

namespace {

using difmesh::ErrorCode;
using difmesh::detail::AtomicFile;
using test::check_error;
using test::TempFolder;

difmesh::Mesh large_mesh() {
  difmesh::Mesh mesh;
  mesh.positions.resize(20000);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] = {static_cast<double>(v), 0.1, 0.2};
  }
  mesh.triangles.resize(20000, {0, 1, 2});
  return mesh;
}

/// A disk that is full after so many bytes, as far as this program is concerned.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

}  // namespace

TEST_CASE("a file appears with commit and not before") {
  const TempFolder folder;
  AtomicFile file(folder / "f.txt");
  file.write("one ");
  file.write_number(0.1);
  file.write(" ");
  file.write_number(std::uint64_t{18446744073709551615U});
  CHECK(folder.names() != std::vector<std::string>{"f.txt"});
  CHECK_FALSE(std::filesystem::exists(folder / "f.txt"));
  file.commit();
  CHECK(folder.names() == std::vector<std::string>{"f.txt"});
  CHECK(test::read_bytes(folder / "f.txt") == "one 0.1 18446744073709551615");
}

TEST_CASE("without commit nothing stays and the old file is as it was") {
  const TempFolder folder;
  (void)folder.file("f.txt", "old");
  {
    AtomicFile file(folder / "f.txt");
    file.write(std::string(1000000, 'x'));
  }
  CHECK(folder.names() == std::vector<std::string>{"f.txt"});
  CHECK(test::read_bytes(folder / "f.txt") == "old");
}

TEST_CASE("a replaced file keeps its mode and a link stays a link") {
  const TempFolder folder;
  const auto target = folder.file("target.txt", "old");
  std::filesystem::permissions(target, std::filesystem::perms{0640});
  std::filesystem::create_symlink("target.txt", folder / "link.txt");
  AtomicFile file(folder / "link.txt");
  file.write("new");
  file.commit();
  CHECK(std::filesystem::is_symlink(folder / "link.txt"));
  CHECK(test::read_bytes(target) == "new");
  CHECK(std::filesystem::status(target).permissions() == std::filesystem::perms{0640});
}

TEST_CASE("links are written through to files that are there or not yet") {
  namespace fs = std::filesystem;
  const TempFolder folder;
  fs::create_directory(folder / "sub");
  fs::create_symlink("sub/new.txt", folder / "dangling.txt");
  fs::create_symlink("dangling.txt", folder / "chain.txt");
  fs::create_symlink(folder / "sub/absolute.txt", folder / "absolute.txt");
  fs::create_symlink("sub", folder / "folder_link");
  fs::create_symlink("../up.txt", folder / "sub/up.txt");
  const auto write = [&](const char* name, const char* text) {
    AtomicFile file(folder / name);
    file.write(text);
    file.commit();
  };
  write("dangling.txt", "one");
  CHECK(test::read_bytes(folder / "sub/new.txt") == "one");
  write("chain.txt", "two");  // now to a file that exists
  CHECK(test::read_bytes(folder / "sub/new.txt") == "two");
  write("absolute.txt", "three");
  CHECK(test::read_bytes(folder / "sub/absolute.txt") == "three");
  write("folder_link/up.txt", "four");
  CHECK(test::read_bytes(folder / "up.txt") == "four");
  for (const char* name : {"dangling.txt", "chain.txt", "absolute.txt", "sub/up.txt"}) {
    CHECK_MESSAGE(fs::is_symlink(folder / name), name);
  }
  CHECK(folder.names() == std::vector<std::string>{"absolute.txt", "chain.txt", "dangling.txt",
                                                   "folder_link", "sub", "up.txt"});
}

TEST_CASE("links that lead to no place for a file are refused and stay") {
  namespace fs = std::filesystem;
  const TempFolder folder;
  const difmesh::Mesh mesh = large_mesh();
  fs::create_directory(folder / "sub");
  fs::create_symlink("b.ply", folder / "a.ply");
  fs::create_symlink("a.ply", folder / "b.ply");
  fs::create_symlink("self.ply", folder / "self.ply");
  fs::create_symlink("none/new.ply", folder / "lost.ply");
  fs::create_symlink("sub", folder / "sub.ply");
  const auto refused = [&](const char* name, const char* why) {
    check_error([&] { difmesh::write_mesh(folder / name, mesh); }, ErrorCode::file_write,
                {name, why});
    CHECK_MESSAGE(fs::is_symlink(folder / name), name);
  };
  refused("a.ply", "Too many levels of symbolic links");
  refused("self.ply", "Too many levels of symbolic links");
  refused("lost.ply", "No such file or directory");
  refused("sub.ply", "Is a directory");
  CHECK(fs::is_empty(folder / "sub"));
  CHECK(folder.names() ==
        std::vector<std::string>{"a.ply", "b.ply", "lost.ply", "self.ply", "sub", "sub.ply"});
}

TEST_CASE("a new file has the mode that the umask leaves") {
  const TempFolder folder;
  const mode_t old = ::umask(027);
  AtomicFile file(folder / "f.txt");
  file.commit();
  ::umask(old);
  CHECK(std::filesystem::status(folder / "f.txt").permissions() == std::filesystem::perms{0640});
}

TEST_CASE("writers tell of a full device and leave nothing") {
  const TempFolder folder;
  const difmesh::Mesh mesh = large_mesh();
  const std::vector<double> cells(100000, 0.3);
  const auto field = difmesh::FieldView::x_fastest(cells.data(), {100, 100, 10});
  const auto refused = [&](const auto& action) {
    check_error(action, ErrorCode::file_write, {"/dev/full", "No space left"});
  };
  for (const char* format : {".ply", ".obj", ".off", ".stl"}) {
    refused([&] { difmesh::write_mesh("/dev/full", mesh, {.format = format}); });
    refused([&] { difmesh::write_mesh("/dev/full", difmesh::Mesh{}, {.format = format}); });
  }
  refused(
      [&] { difmesh::write_field("/dev/full", field, {}, {.format = difmesh::FieldFormat::npy}); });
  refused([&] {
    difmesh::write_field("/dev/full", field, {}, {.format = difmesh::FieldFormat::nrrd});
  });
  CHECK(std::filesystem::is_character_file("/dev/full"));
  // By way of a link with an extension.
  std::filesystem::create_symlink("/dev/full", folder / "full.ply");
  check_error([&] { difmesh::write_mesh(folder / "full.ply", mesh); }, ErrorCode::file_write,
              {"full.ply", "No space left"});
  CHECK(folder.names() == std::vector<std::string>{"full.ply"});
  CHECK(std::filesystem::is_symlink(folder / "full.ply"));
}

TEST_CASE("writers tell of a disk that runs full and leave the folder as it was") {
  const TempFolder folder;
  const difmesh::Mesh mesh = large_mesh();
  (void)folder.file("old.ply", "old");
  const std::vector<double> cells(100000, 0.3);
  const auto field = difmesh::FieldView::x_fastest(cells.data(), {100, 100, 10});
  const FileSizeLimit limit(50000);
  for (const char* name : {"m.ply", "m.obj", "m.off", "m.stl", "old.ply"}) {
    check_error([&] { difmesh::write_mesh(folder / name, mesh); }, ErrorCode::file_write,
                {name, "File too large"});
  }
  check_error([&] { difmesh::write_field(folder / "f.npy", field); }, ErrorCode::file_write,
              {"f.npy", "File too large"});
  check_error([&] { difmesh::write_field(folder / "f.nrrd", field, {}, {.gzip = false}); },
              ErrorCode::file_write, {"f.nrrd", "File too large"});
  CHECK(folder.names() == std::vector<std::string>{"old.ply"});
  CHECK(test::read_bytes(folder / "old.ply") == "old");
}

TEST_CASE("targets that cannot be written are named with the reason") {
  const TempFolder folder;
  const difmesh::Mesh mesh = large_mesh();
  check_error([&] { difmesh::write_mesh(folder / "none/m.ply", mesh); }, ErrorCode::file_write,
              {"none/m.ply", "No such file or directory"});
  std::filesystem::create_directory(folder / "folder.ply");
  check_error([&] { difmesh::write_mesh(folder / "folder.ply", mesh); }, ErrorCode::file_write,
              {"folder.ply", "Is a directory"});
  (void)folder.file("file", "");
  check_error([&] { difmesh::write_mesh(folder / "file/m.ply", mesh); }, ErrorCode::file_write,
              {"file/m.ply", "Not a directory"});
  CHECK(folder.names() == std::vector<std::string>{"file", "folder.ply"});
  // No one, root included, makes files in /sys.
  check_error([&] { difmesh::write_mesh("/sys/m.ply", mesh); }, ErrorCode::file_write,
              {"/sys/m.ply"});
  if (::geteuid() != 0) {
    std::filesystem::create_directory(folder / "closed");
    (void)folder.file("closed.ply", "old");
    std::filesystem::permissions(folder / "closed", std::filesystem::perms{0500});
    std::filesystem::permissions(folder / "closed.ply", std::filesystem::perms{0400});
    for (const char* name : {"closed/m.ply", "closed.ply"}) {
      check_error([&] { difmesh::write_mesh(folder / name, mesh); }, ErrorCode::file_write,
                  {name, "Permission denied"});
    }
    CHECK(test::read_bytes(folder / "closed.ply") == "old");
  }
}

TEST_CASE("a pipe is written directly") {
  const TempFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  // Small enough for the pipe's buffer; opened for reading first, so that nothing waits.
  const int reader = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  AtomicFile file(folder / "pipe");
  file.write("through the pipe");
  file.commit();
  std::string got(100, '\0');
  const ::ssize_t count = ::read(reader, got.data(), got.size());
  ::close(reader);
  CHECK(got.substr(0, count < 0 ? 0 : static_cast<std::size_t>(count)) == "through the pipe");
  CHECK(folder.names() == std::vector<std::string>{"pipe"});
}
