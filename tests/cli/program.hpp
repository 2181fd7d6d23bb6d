#pragma once
/// \file program.hpp
/// Runs the built program `difmesh` as its users do, and makes its input.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "difmesh/grid.hpp"
#include "support/fields.hpp"
#include "support/triangle_meshes.hpp"

namespace difmesh::test {

struct Outcome {
  int exit_code = 0;  ///< or 1000 + the number of the signal that killed it
  std::string out;
  std::string err;
};

struct Launch {
  std::vector<std::string> arguments;
  std::string out_path;          ///< where standard output goes; into the outcome if empty
  std::filesystem::path folder;  ///< to start in; that of the test if empty
  std::optional<std::uint64_t> file_size_limit;  ///< bytes
  std::optional<std::uint64_t> memory_limit;     ///< bytes of address space
};

[[nodiscard]] Outcome run_program(const Launch& launch);
[[nodiscard]] Outcome run_program(std::vector<std::string> arguments);

/// Standard error is a terminal of 80 columns, and comes as `err`. `watch` gets what has been
/// written to it so far and the process, whenever there is more. Carriage returns before newlines,
/// which terminals add, are taken out.
[[nodiscard]] Outcome run_on_terminal(
    std::vector<std::string> arguments,
    const std::function<void(const std::string& screen, int process)>& watch);

/// That the run failed with this exit code, said so in one line on standard error that starts
/// `difmesh: ` and holds all the words, and printed nothing else.
void check_fails(const Outcome& outcome, int exit_code, std::initializer_list<std::string> words);
/// That the run ended well and said nothing on standard error.
void check_succeeds(const Outcome& outcome);

/// The value printed after a name at the start of a line; fails the test where there is none.
[[nodiscard]] std::string fact(const std::string& text, const std::string& name);

/// Writes a mesh as the library does. Returns its path.
std::filesystem::path write_triangles(const std::filesystem::path& path, const TriangleMesh& mesh);

/// Exact fractions of the box from `low` to `high`: products of lengths.
[[nodiscard]] OwnedField box_field(const Grid& grid, const Vec3& low, const Vec3& high);

/// A smooth drop without symmetries that keeps a tenth of the grid away from its sides, diffuse
/// over one or two cells.
[[nodiscard]] OwnedField drop_field(const Index3& dims);

}  // namespace difmesh::test
