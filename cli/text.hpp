#pragma once
/// \file text.hpp
/// Text for people: numbers, cells and lines of facts. ASCII only, and free of the locale.

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/grid.hpp"

namespace difmesh::cli {

/// Shortest decimal form that reads as the same number.
[[nodiscard]] std::string exact(double number);
/// Exact components with blanks between.
[[nodiscard]] std::string exact(const Vec3& vector);
/// With so many significant digits.
[[nodiscard]] std::string rounded(double number, int digits);
[[nodiscard]] std::string rounded(const Vec3& vector, int digits);
/// (i, j, k)
[[nodiscard]] std::string cell_text(const Index3& cell);
/// 64 x 64 x 32
[[nodiscard]] std::string dims_text(const Index3& dims);
/// "1 cell", "2 cells"
[[nodiscard]] std::string count_of(std::int64_t count, std::string_view thing);

/// Prints a line on standard error.
void warn(const std::string& message);
/// Each of them once.
void warn_all(const std::vector<std::string>& messages);

/// Prints "name   value", the values of successive calls below each other; what is not printable in
/// them, of names of files above all, is escaped.
void print_fact(std::ostream& out, std::string_view name, std::string_view value);

}  // namespace difmesh::cli
