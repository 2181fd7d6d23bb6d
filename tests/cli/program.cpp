#include "program.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <utility>

#include "difmesh/io/mesh_file.hpp"
#include "difmesh/mesh.hpp"
#include "io/files.hpp"

namespace difmesh::test {
namespace {

constexpr int kSignalled = 1000;
constexpr int kNotStarted = 127;

/// For the child, between fork() and exec(): plain system calls only.
struct Child {
  std::vector<char*> arguments;
  int out = -1;
  int err = -1;
  const char* folder = nullptr;
  std::optional<std::uint64_t> file_size_limit;
  std::optional<std::uint64_t> memory_limit;

  [[noreturn]] void start() const {
    // Whoever runs the tests in the background may have them ignored.
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) {
      ::signal(signal, SIG_DFL);
    }
    limit(RLIMIT_FSIZE, file_size_limit);
    limit(RLIMIT_AS, memory_limit);
    const bool ready = ::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(err, STDERR_FILENO) >= 0 &&
                       (folder == nullptr || ::chdir(folder) == 0);
    if (ready) {
      ::execv(arguments[0], arguments.data());
    }
    ::_exit(kNotStarted);
  }

 private:
  static void limit(decltype(RLIMIT_AS) resource, const std::optional<std::uint64_t>& bytes) {
    if (bytes) {
      const struct rlimit both { *bytes, *bytes };
      ::setrlimit(resource, &both);
    }
  }
};

/// Starts the program. \param words keeps the arguments alive
::pid_t start(Child child, std::vector<std::string>& words) {
  words.insert(words.begin(), DIFMESH_PROGRAM);
  for (std::string& word : words) {
    child.arguments.push_back(word.data());
  }
  child.arguments.push_back(nullptr);
  const ::pid_t process = ::fork();
  REQUIRE(process >= 0);
  if (process == 0) {
    child.start();
  }
  return process;
}

int wait_for(::pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
  REQUIRE(exit_code != kNotStarted);
  return exit_code;
}

int open_new(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  REQUIRE(descriptor >= 0);
  return descriptor;
}

}  // namespace

Outcome run_program(const Launch& launch) {
  const ::test::TempFolder streams;
  const bool keeps_out = launch.out_path.empty();
  Child child;
  child.out = open_new(keeps_out ? streams / "out" : std::filesystem::path(launch.out_path));
  child.err = open_new(streams / "err");
  child.folder = launch.folder.empty() ? nullptr : launch.folder.c_str();
  child.file_size_limit = launch.file_size_limit;
  child.memory_limit = launch.memory_limit;
  std::vector<std::string> words = launch.arguments;
  Outcome outcome;
  outcome.exit_code = wait_for(start(child, words));
  ::close(child.out);
  ::close(child.err);
  outcome.out = keeps_out ? ::test::read_bytes(streams / "out") : "";
  outcome.err = ::test::read_bytes(streams / "err");
  return outcome;
}

Outcome run_program(std::vector<std::string> arguments) {
  Launch launch;
  launch.arguments = std::move(arguments);
  return run_program(launch);
}

Outcome run_on_terminal(std::vector<std::string> arguments,
                        const std::function<void(const std::string&, int)>& watch) {
  const ::test::TempFolder streams;
  int terminal = -1;
  Child child;
  struct winsize size {};
  size.ws_row = 24;
  size.ws_col = 80;
  REQUIRE(::openpty(&terminal, &child.err, nullptr, nullptr, &size) == 0);
  ::fcntl(terminal, F_SETFD, FD_CLOEXEC);
  child.out = open_new(streams / "out");
  const ::pid_t process = start(child, arguments);
  ::close(child.err);
  Outcome outcome;
  char buffer[4096];
  // The last writer's end of the terminal shows as an error.
  for (::ssize_t got = 0; (got = ::read(terminal, buffer, sizeof buffer)) > 0;) {
    outcome.err.append(buffer, static_cast<std::size_t>(got));
    watch(outcome.err, process);
  }
  outcome.exit_code = wait_for(process);
  ::close(terminal);
  ::close(child.out);
  for (std::size_t at = 0; (at = outcome.err.find("\r\n", at)) != std::string::npos;) {
    outcome.err.erase(at, 1);
  }
  outcome.out = ::test::read_bytes(streams / "out");
  return outcome;
}

void check_fails(const Outcome& outcome, int exit_code, std::initializer_list<std::string> words) {
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == exit_code);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.starts_with("difmesh: "));
  CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
  for (const std::string& word : words) {
    CAPTURE(word);
    CHECK(outcome.err.find(word) != std::string::npos);
  }
}

void check_succeeds(const Outcome& outcome) {
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
}

std::string fact(const std::string& text, const std::string& name) {
  const std::string lines = "\n" + text;
  const std::size_t line = lines.find("\n" + name + "  ");
  CAPTURE(text);
  CAPTURE(name);
  REQUIRE(line != std::string::npos);
  const std::size_t value = lines.find_first_not_of(' ', line + 1 + name.size());
  return lines.substr(value, lines.find('\n', value) - value);
}

std::filesystem::path write_triangles(const std::filesystem::path& path, const TriangleMesh& mesh) {
  Mesh written;
  written.positions.assign(mesh.positions.begin(), mesh.positions.end());
  written.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  write_mesh(path, written);
  return path;
}

OwnedField box_field(const Grid& grid, const Vec3& low, const Vec3& high) {
  const auto share = [&](std::size_t axis, std::int64_t index) {
    const double from = grid.origin[axis] + static_cast<double>(index) * grid.spacing[axis];
    const double inside =
        std::min(high[axis], from + grid.spacing[axis]) - std::max(low[axis], from);
    return std::max(inside, 0.0) / grid.spacing[axis];
  };
  OwnedField field(grid.dims);
  ::test::for_cells(grid.dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    field.at(i, j, k) = share(0, i) * share(1, j) * share(2, k);
  });
  return field;
}

OwnedField drop_field(const Index3& dims) {
  constexpr Vec3 kCentre{0.48, 0.51, 0.49};
  constexpr Vec3 kHalfAxes{0.36, 0.3, 0.33};
  OwnedField field(dims);
  ::test::for_cells(dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const Index3 cell{i, j, k};
    double square = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double place = (static_cast<double>(cell[a]) + 0.5) / static_cast<double>(dims[a]);
      square += std::pow((place - kCentre[a]) / kHalfAxes[a], 2);
    }
    const double cells_per_radius = 0.33 * static_cast<double>(dims[0]);
    field.at(i, j, k) = std::clamp(0.5 + cells_per_radius * (1.0 - std::sqrt(square)), 0.0, 1.0);
  });
  return field;
}

}  // namespace difmesh::test
