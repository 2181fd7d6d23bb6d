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

/// Words of files as messages show them: 'word', printable, the rest of a long one left out.
[[nodiscard]] std::string in_quotes(std::string_view word);
/// The same for a path, whole.
[[nodiscard]] std::string quoted(const std::filesystem::path& path);
/// \throw Error file_format: 'path': matter, printable, the rest of a long one left out
[[noreturn]] void fail_format(const std::filesystem::path& path, const std::string& matter);

/// "1 byte", "2 bytes"
[[nodiscard]] std::string count_of(std::uint64_t count, std::string_view thing);
[[nodiscard]] std::string lower_case(std::string_view text);
[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);
/// The extension with its dot, in lower case.
[[nodiscard]] std::string extension_of(const std::filesystem::path& path);

/// The text of a file without the byte order mark that some programs put before UTF-8.
/// \throw Error file_format for UTF-16 and UTF-32
[[nodiscard]] std::string_view plain_text(const std::filesystem::path& path, std::string_view text);

/// Cuts text into lines, which end with a line feed, a carriage return, or both in this order.
/// Cost: linear in all, whatever ends the lines.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  /// The next line, without what ends it; nothing after the last one.
  std::optional<std::string_view> next();
  /// Of the text after the line, from its start.
  [[nodiscard]] std::size_t offset() const { return at_; }
  /// Of the line, from 1.
  [[nodiscard]] std::int64_t number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  std::int64_t number_ = 0;
  // The next of each from at_ on; looked for again only when passed, as a text may hold none.
  std::optional<std::size_t> feed_ = {};
  std::optional<std::size_t> return_ = {};
};

/// The whole of `word` as a decimal integer; nothing if it is none or overflows.
[[nodiscard]] std::optional<std::int64_t> to_integer(std::string_view word);
/// The whole of `word` as a number, "nan" and "inf" included; nothing if it is none or overflows.
[[nodiscard]] std::optional<double> to_number(std::string_view word);
/// Shortest decimal form that reads as the same number.
[[nodiscard]] std::string to_text(double number);
/// "(x,y,z)" of such numbers.
[[nodiscard]] std::string to_text(const Vec3& vector);

}  // namespace difmesh::detail
