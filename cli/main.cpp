// The program `difmesh`: reads the command line, runs a subcommand, turns errors into one line and
// an exit code.

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>

#include "command.hpp"
#include "difmesh/error.hpp"
#include "difmesh/out_of_memory.hpp"
#include "difmesh/printable.hpp"
#include "difmesh/version.hpp"
#include "help_text.hpp"
#include "interrupt.hpp"
#include "text.hpp"

namespace {

using namespace difmesh;

constexpr int kFailed = 1;
constexpr int kUsage = 2;
constexpr int kSignal = 128;  // plus the number of the signal, as shells have it

constexpr const char* kDescription =
    "Turns volume fractions into surfaces.\n"
    "\n"
    "Input is a field of fractions: for each cell of a Cartesian grid the share that is filled,\n"
    "0 (empty) to 1 (full), as flow solvers and scanners write it. Output is the surface between\n"
    "full and empty as a triangle mesh.\n";

constexpr const char* kFooter =
    "Examples:\n"
    "  difmesh info drops.npy                        what is in the field?\n"
    "  difmesh reconstruct drops.nrrd -o drops.ply   its surface\n"
    "  difmesh info drops.ply                        is the surface closed? what is its volume?\n"
    "  difmesh sample torus -o torus.npy --cells 64   fractions of a known shape\n"
    "  difmesh reconstruct --help                    all options of one command\n"
    "\n"
    "Exit codes: 0 done, 1 failed, 2 wrong arguments, 128 + n ended by signal n\n"
    "(129 hung up, 130 Ctrl-C, 131 quit, 143 terminated).\n"
    "Errors are one line on standard error. Output files appear whole or not at all.\n";

int fail(const std::string& message, int exit_code) {
  std::cerr << "difmesh: " << printable(message) << '\n';
  return exit_code;
}

/// A full disk or a closed pipe may show only when the last of the text is written.
int finish_output() {
  if (!std::cout.flush()) {
    return fail("cannot write to standard output", kFailed);
  }
  return 0;
}

int exit_code_of(const Error& error) {
  return error.code() == ErrorCode::invalid_argument ? kUsage : kFailed;
}

int run(int argc, char** argv) {
  CLI::App program(kDescription, "difmesh");
  program.formatter(std::make_shared<cli::HelpText>());
  program.footer(kFooter);
  program.set_version_flag("--version", "difmesh " DIFMESH_VERSION, "Print the version and exit");
  program.set_help_flag("-h,--help", "Print this help and exit");
  program.require_subcommand(0, 1);  // CLI11 would not name a word that is no command
  cli::add_reconstruct_command(program);
  cli::add_info_command(program);
  cli::add_sample_command(program);
#ifdef DIFMESH_WITH_METRICS
  cli::add_compare_command(program);
#endif
#ifdef DIFMESH_WITH_VIEW
  cli::add_view_command(program);
#endif
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    program.exit(help);
    return finish_output();
  } catch (const CLI::ParseError& error) {
    return fail(std::string(error.what()) + "; try 'difmesh --help'", kUsage);
  }
  if (program.get_subcommands().empty()) {
    return fail("no command given; try 'difmesh --help'", kUsage);
  }
  return finish_output();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled || cli::interrupting_signal() != 0) {
      return fail("interrupted", kSignal + cli::interrupting_signal());
    }
    return fail(error.what(), exit_code_of(error));
  } catch (const OutOfMemory& error) {
    return fail(error.what(), kFailed);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailed);
  }
}
