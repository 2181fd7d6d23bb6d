// Work that takes long: the bar on a terminal, and signals.

#include <doctest/doctest.h>

#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "io/files.hpp"
#include "program.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::test::check_succeeds;
using difmesh::test::Outcome;
using difmesh::test::run_on_terminal;
using test::TempFolder;

/// Raw noise of 256^3 cells: every cell an interface, which takes one thread some ten seconds.
std::vector<std::string> endless_work(const TempFolder& folder) {
  std::vector<char> noise(std::size_t{1} << 24);
  std::mt19937_64 random(1);
  for (char& value : noise) {
    value = static_cast<char>(random() & 0xff);
  }
  std::ofstream(folder / "noise.bin", std::ios::binary)
      .write(noise.data(), static_cast<std::streamsize>(noise.size()));
  return {"reconstruct", (folder / "noise.bin").string(),
          "-o",          (folder / "mesh.ply").string(),
          "--report",    (folder / "report.json").string(),
          "--raw-dims",  "256",
          "--raw-type",  "uint8",
          "--threads",   "1"};
}

/// Sends the signal as soon as the bar shows.
Outcome interrupt(const std::vector<std::string>& arguments, int signal) {
  bool sent = false;
  return run_on_terminal(arguments, [&](const std::string& screen, int process) {
    if (!sent && screen.find('%') != std::string::npos) {
      sent = true;
      ::kill(process, signal);
    }
  });
}

}  // namespace

TEST_CASE("Ctrl-C takes the bar away and leaves no file") {
  const TempFolder folder;
  const Outcome outcome = interrupt(endless_work(folder), SIGINT);
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.starts_with("\rreconstructing ["));
  CHECK(outcome.err.ends_with(" \rdifmesh: interrupted\n"));
  CHECK(folder.names() == std::vector<std::string>{"noise.bin"});
}

TEST_CASE("SIGTERM stops likewise") {
  const TempFolder folder;
  const Outcome outcome = interrupt(endless_work(folder), SIGTERM);
  CHECK(outcome.exit_code == 143);
  CHECK(outcome.err.ends_with(" \rdifmesh: interrupted\n"));
  CHECK(folder.names() == std::vector<std::string>{"noise.bin"});
}

TEST_CASE("short work shows no bar on a terminal") {
  const TempFolder folder;
  write_field(folder / "drop.npy", difmesh::test::drop_field({12, 12, 12}).view());
  check_succeeds(run_on_terminal(
      {"reconstruct", (folder / "drop.npy").string(), "-o", (folder / "mesh.ply").string()},
      [](const std::string&, int) {}));
}
