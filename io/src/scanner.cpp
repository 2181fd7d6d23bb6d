#include "scanner.hpp"

#include <algorithm>
#include <cmath>

namespace difmesh::detail {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

bool Scanner::next_line() {
  while (const std::optional<std::string_view> line = whole_line()) {
    if (!std::all_of(line->begin(), line->end(), is_space)) {
      line_ = *line;
      return true;
    }
  }
  line_ = {};
  return false;
}

std::optional<std::string_view> Scanner::whole_line() {
  const std::size_t start = lines_.offset();
  for (bool is_first = true;; is_first = false) {
    const std::size_t from = lines_.offset();
    const std::optional<std::string_view> line = lines_.next();
    if (!line) {
      return is_first ? line : text_.substr(start);
    }
    if (is_first) {
      line_number_ = style_.lines_before + lines_.number();
    }
    const std::size_t length =
        style_.comment == '\0' ? line->size() : std::min(line->find(style_.comment), line->size());
    const bool is_continued = style_.continued && length == line->size() && line->ends_with('\\');
    if (!is_continued) {
      return text_.substr(start, from + length - start);
    }
  }
}

std::string_view Scanner::word() {
  // Within a line a backslash and what ends lines can only be the seam of a continued one.
  const auto separates = [this](char c) {
    return is_space(c) || (style_.continued && (c == '\\' || c == '\n'));
  };
  std::size_t first = 0;
  while (first < line_.size() && separates(line_[first])) {
    ++first;
  }
  std::size_t end = first;
  while (end < line_.size() && !separates(line_[end])) {
    ++end;
  }
  const std::string_view word = line_.substr(first, end - first);
  line_.remove_prefix(end);
  return word;
}

double Scanner::number(const char* what) {
  const std::string_view text = word();
  const std::optional<double> value = to_number(text);
  if (!value || !std::isfinite(*value)) {
    fail_word(text, what);
  }
  return *value;
}

double Scanner::any_number(const char* what) {
  const std::string_view text = word();
  const std::optional<double> value = to_number(text);
  if (!value) {
    fail_word(text, what);
  }
  return *value;
}

std::int64_t Scanner::integer(const char* what) {
  const std::string_view text = word();
  const std::optional<std::int64_t> value = to_integer(text);
  if (!value) {
    fail_word(text, what);
  }
  return *value;
}

void Scanner::fail(const std::string& matter) const {
  fail_format(path_, "line " + std::to_string(line_number_) + ": " + matter);
}

void Scanner::fail_word(std::string_view word, const char* what) const {
  fail(word.empty() ? std::string(what) + " is missing"
                    : std::string(what) + " is " + in_quotes(word));
}

}  // namespace difmesh::detail
