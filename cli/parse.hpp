#pragma once
/// \file parse.hpp
/// Words of the command line to values. Every function throws CLI::ValidationError that names the
/// option and shows the word.

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/grid.hpp"
#include "difmesh/options.hpp"
#include "names.hpp"

namespace difmesh::cli {

[[nodiscard]] std::vector<std::string_view> split_at_commas(std::string_view text);

/// A finite number, within a range.
[[nodiscard]] double parse_number(const std::string& option, std::string_view word);
[[nodiscard]] double parse_number(const std::string& option, std::string_view word, Range range);
[[nodiscard]] std::int64_t parse_integer(const std::string& option, std::string_view word,
                                         std::int64_t low, std::int64_t high);
/// What --allow-outside does, for all commands that have it.
inline constexpr const char* kAllowOutsideHelp =
    "Let files name data outside their own folder: .nhdr and .gltf";

/// Adds --threads N to a command, whose `result` the help says does not depend on it. `threads`
/// must live as long as the command; 0 stands for as many as the machine has.
void add_threads_option(CLI::App& command, const std::string& result, int& threads);

/// Three numbers with commas between, or one that stands for all three.
[[nodiscard]] Vec3 parse_vector(const std::string& option, std::string_view text);
/// The same, each > 0.
[[nodiscard]] Vec3 parse_spacing(const std::string& option, std::string_view text);
/// Two numbers with a comma between, the smaller first.
[[nodiscard]] std::array<double, 2> parse_range(const std::string& option, const std::string& text);
/// Three counts of cells, each >= 1.
[[nodiscard]] Index3 parse_dims(const std::string& option, std::string_view text);
/// One name for all sides, or six: xlo,xhi,ylo,yhi,zlo,zhi. Periodic sides come in pairs.
[[nodiscard]] Boundary parse_boundary(const std::string& option, std::string_view text);

/// The value with that name.
template <class Value, std::size_t n>
[[nodiscard]] Value parse_name(const std::string& option, std::string_view word,
                               const std::array<Named<Value>, n>& table) {
  std::string names;
  for (const Named<Value>& entry : table) {
    if (entry.name == word) {
      return entry.value;
    }
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw CLI::ValidationError(option, "'" + std::string(word) + "' is none of " + names);
}

}  // namespace difmesh::cli
