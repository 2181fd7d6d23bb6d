#pragma once
/// \file command.hpp
/// The subcommands. Each lives in <name>_command.cpp, adds itself to the program, and runs when the
/// command line has been read. To add one: a source file, a line here and a line in main.cpp.
///
/// A command throws CLI::ValidationError for wrong arguments and difmesh::Error for the rest, with
/// messages that name the option or the file; main() prints them and chooses the exit code.

#include <CLI/CLI.hpp>

namespace difmesh::cli {

/// Only where difmesh::metrics is built.
void add_compare_command(CLI::App& program);
void add_info_command(CLI::App& program);
void add_reconstruct_command(CLI::App& program);
void add_sample_command(CLI::App& program);
/// Only where the page was built: with glTF and what npm gives.
void add_view_command(CLI::App& program);

}  // namespace difmesh::cli
