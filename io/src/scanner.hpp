#pragma once
/// \file scanner.hpp
/// Reads the text of a mesh file, line by line and word by word.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "text.hpp"

namespace difmesh::detail {

/// Goes over the lines that hold a word. Errors name the file and the line. A backslash that ends a
/// comment continues nothing: comments hold paths such as C:\models\.
class Scanner {
 public:
  struct Style {
    char comment = '\0';            ///< starts a comment; '\0' for none
    bool continued = false;         ///< a backslash at the end of a line joins the next one to it
    std::int64_t lines_before = 0;  ///< that were read by other means
  };
  Scanner(const std::filesystem::path& path, std::string_view text, const Style& style)
      : path_(path), text_(text), lines_(text), style_(style) {}

  /// To the next line with a word; false at the end of the text.
  bool next_line();
  /// The next word of the line, empty after the last one.
  std::string_view word();
  /// What is left of the line.
  [[nodiscard]] std::string_view rest() const { return line_; }
  /// Passes over that many bytes of it, or over all.
  void drop(std::size_t bytes) { line_.remove_prefix(bytes); }
  void drop_rest() { line_ = {}; }
  /// Where the text after the line starts.
  [[nodiscard]] std::size_t offset() const { return lines_.offset(); }
  /// The next word as a finite number, as one that need not be finite, or as an integer; `what` is
  /// named if there is none.
  double number(const char* what);
  double any_number(const char* what);
  std::int64_t integer(const char* what);
  [[nodiscard]] std::int64_t line_number() const { return line_number_; }
  /// \throw Error file_format: 'path', line n: matter
  [[noreturn]] void fail(const std::string& matter) const;

 private:
  /// The next line of the text without its comment, joined to the next ones where it is continued.
  std::optional<std::string_view> whole_line();
  [[noreturn]] void fail_word(std::string_view word, const char* what) const;

  const std::filesystem::path& path_;
  std::string_view text_;
  Lines lines_;
  std::string_view line_ = {};  ///< what is left of it
  Style style_;
  std::int64_t line_number_ = 0;
};

}  // namespace difmesh::detail
