#pragma once
/// \file text.hpp
/// Words, numbers and messages, free of the locale.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// Words and paths as messages show them: 'word'.
[[nodiscard]] std::string in_quotes(std::string_view word);
[[nodiscard]] std::string quoted(const std::filesystem::path& path);
/// \throw Error file_format: 'path': matter
[[noreturn]] void fail_format(const std::filesystem::path& path, const std::string& matter);

[[nodiscard]] std::string lower_case(std::string_view text);
[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);
/// The extension with its dot, in lower case.
[[nodiscard]] std::string extension_of(const std::filesystem::path& path);

/// The whole of `word` as a decimal integer; nothing if it is none or overflows.
[[nodiscard]] std::optional<std::int64_t> to_integer(std::string_view word);
/// The whole of `word` as a number, "nan" and "inf" included; nothing if it is none or overflows.
[[nodiscard]] std::optional<double> to_number(std::string_view word);
/// Shortest decimal form that reads as the same number.
[[nodiscard]] std::string to_text(double number);
/// "(x,y,z)" of such numbers.
[[nodiscard]] std::string to_text(const Vec3& vector);

}  // namespace difmesh::detail
