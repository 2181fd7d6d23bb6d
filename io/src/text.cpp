#include "text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "difmesh/error.hpp"
#include "difmesh/printable.hpp"

namespace difmesh::detail {
namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";

constexpr std::size_t kLongestQuote = 80;
constexpr std::size_t kLongestMatter = 1000;

/// The beginning of a text, not cut within a character of UTF-8.
std::string_view beginning(std::string_view text, std::size_t most) {
  const auto is_inside = [text](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  std::size_t length = most;
  while (length > 0 && most - length < 3 && is_inside(length)) {
    --length;
  }
  return text.substr(0, length);
}

/// Printable, the rest of a long text left out.
std::string shortened(std::string_view text, std::size_t most) {
  return text.size() > most ? printable(beginning(text, most)) + "..." : printable(text);
}

/// std::from_chars takes no plus sign.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+' ? word.substr(1)
                                                                               : word;
}

}  // namespace

std::string in_quotes(std::string_view word) {
  // Not "'" + std::string(word): g++ 12 warns of an overlap there that cannot be (-Wrestrict).
  std::string text = "'";
  text += shortened(word, kLongestQuote);
  text += '\'';
  return text;
}

std::string quoted(const std::filesystem::path& path) {
  std::string text = "'";
  text += printable(path.native());
  text += '\'';
  return text;
}

void fail_format(const std::filesystem::path& path, const std::string& matter) {
  throw Error(ErrorCode::file_format, quoted(path) + ": " + shortened(matter, kLongestMatter));
}

std::string count_of(std::uint64_t count, std::string_view thing) {
  return std::to_string(count) + " " + std::string(thing) + (count == 1 ? "" : "s");
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kSpace, end);
  }
  return words;
}

std::string_view plain_text(const std::filesystem::path& path, std::string_view text) {
  using namespace std::string_view_literals;
  if (text.starts_with("\xEF\xBB\xBF")) {
    return text.substr(3);
  }
  // With and without a byte order mark; of UTF-32 the first two bytes are as telling.
  const bool has_mark = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  const std::size_t zeros = static_cast<std::size_t>(
      std::count(text.begin(), text.begin() + std::min<std::ptrdiff_t>(2, std::ssize(text)), '\0'));
  if (has_mark || (zeros > 0 && text.size() > 1)) {
    fail_format(path, "text in UTF-16 or UTF-32, or no text; UTF-8 can be read");
  }
  return text;
}

std::optional<std::string_view> Lines::next() {
  if (at_ >= text_.size()) {
    return std::nullopt;
  }
  const auto look = [this](std::optional<std::size_t>& known, char c) {
    if (!known || *known < at_) {
      known = std::min(text_.find(c, at_), text_.size());
    }
    return *known;
  };
  const std::size_t feed = look(feed_, '\n');
  const std::size_t carriage = look(return_, '\r');
  const std::size_t end = std::min(feed, carriage);
  const std::string_view line = text_.substr(at_, end - at_);
  at_ = std::min(end + (carriage + 1 == feed ? 2 : 1), text_.size());
  ++number_;
  return line;
}

std::string extension_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

std::optional<std::int64_t> to_integer(std::string_view word) {
  word = without_plus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return value;
}

std::optional<double> to_number(std::string_view word) {
  word = without_plus(word);
  const char* const last = word.data() + word.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (end != last || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    // Too small is 0 or as good as 0, too large is an error; only the wider type tells which.
    long double wide = 0.0L;
    if (std::from_chars(word.data(), last, wide).ec != std::errc{} || std::abs(wide) > 1.0L) {
      return std::nullopt;
    }
    return static_cast<double>(wide);
  }
  return value;
}

std::string to_text(double number) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), result.ptr};
}

std::string to_text(const Vec3& vector) {
  std::string text = "(";
  text += to_text(vector[0]) + "," + to_text(vector[1]) + "," + to_text(vector[2]) + ")";
  return text;
}

}  // namespace difmesh::detail
