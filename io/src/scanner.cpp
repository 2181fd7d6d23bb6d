#include "scanner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "text.hpp"

namespace difmesh::detail {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

bool Scanner::next_line() {
  while (!text_.empty()) {
    line_number_ = next_number_;
    std::size_t end = 0;
    for (;;) {
      end = std::min(text_.find('\n', end), text_.size());
      if (end == text_.size()) {
        break;
      }
      ++next_number_;
      const std::size_t last = end > 0 && text_[end - 1] == '\r' ? end - 1 : end;
      if (!style_.continued || last == 0 || text_[last - 1] != '\\') {
        break;
      }
      ++end;
    }
    line_ = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    if (style_.comment != '\0') {
      line_ = line_.substr(0, line_.find(style_.comment));
    }
    if (!std::all_of(line_.begin(), line_.end(), is_space)) {
      return true;
    }
  }
  line_ = {};
  return false;
}

std::string_view Scanner::word() {
  // Within a line a backslash or a line feed can only be the seam of a continued one.
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
                    : std::string(what) + " is '" + std::string(word.substr(0, 40)) + "'");
}

}  // namespace difmesh::detail
