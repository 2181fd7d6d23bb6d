#include "text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "difmesh/error.hpp"

namespace difmesh::detail {
namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";

/// std::from_chars takes no plus sign.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+' ? word.substr(1)
                                                                               : word;
}

}  // namespace

std::string in_quotes(std::string_view word) {
  // Not "'" + std::string(word): g++ 12 warns of an overlap there that cannot be (-Wrestrict).
  std::string text = "'";
  text += word;
  text += '\'';
  return text;
}

std::string quoted(const std::filesystem::path& path) {
  return in_quotes(path.string());
}

void fail_format(const std::filesystem::path& path, const std::string& matter) {
  throw Error(ErrorCode::file_format, quoted(path) + ": " + matter);
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
