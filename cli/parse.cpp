#include "parse.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "text.hpp"

namespace difmesh::cli {
namespace {

std::string quoted(std::string_view word) {
  return "'" + std::string(word) + "'";
}

/// std::from_chars takes no plus sign.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

/// The three words of X,Y,Z; a lone one three times.
std::array<std::string_view, 3> three_words(const std::string& option, std::string_view text) {
  const std::vector<std::string_view> words = split_at_commas(text);
  if (words.size() == 1) {
    return {words[0], words[0], words[0]};
  }
  if (words.size() != 3) {
    throw CLI::ValidationError(option, quoted(text) + " has " + std::to_string(words.size()) +
                                           " values; one for all axes or X,Y,Z wanted");
  }
  return {words[0], words[1], words[2]};
}

}  // namespace

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t comma = text.find(','); comma != text.npos; comma = text.find(',')) {
    words.push_back(text.substr(0, comma));
    text.remove_prefix(comma + 1);
  }
  words.push_back(text);
  return words;
}

double parse_number(const std::string& option, std::string_view word) {
  const std::string_view digits = without_plus(word);
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc::result_out_of_range) {
    throw CLI::ValidationError(option, quoted(word) + " is beyond double precision");
  }
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(number)) {
    throw CLI::ValidationError(option, quoted(word) + " is no finite number");
  }
  return number;
}

double parse_number(const std::string& option, std::string_view word, Range range) {
  const double number = parse_number(option, word);
  if (number < range.low || number > range.high) {
    throw CLI::ValidationError(
        option, quoted(word) + " is not in [" + exact(range.low) + ", " + exact(range.high) + "]");
  }
  return number;
}

std::int64_t parse_integer(const std::string& option, std::string_view word, std::int64_t low,
                           std::int64_t high) {
  const std::string_view digits = without_plus(word);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (end != digits.data() + digits.size() || error != std::errc{} || number < low ||
      number > high) {
    throw CLI::ValidationError(option, quoted(word) + " is no integer from " + std::to_string(low) +
                                           " to " + std::to_string(high));
  }
  return number;
}

void add_threads_option(CLI::App& command, const std::string& result, int& threads) {
  constexpr std::int64_t kMost = 4096;
  command
      .add_option_function<std::string>(
          "--threads",
          [&threads](const std::string& text) {
            threads = static_cast<int>(parse_integer("--threads", text, 0, kMost));
          },
          "Number of threads; 0, the default: as many as the machine has.\n" + result +
              " not depend on it")
      ->option_text("N");
}

Vec3 parse_vector(const std::string& option, std::string_view text) {
  const std::array<std::string_view, 3> words = three_words(option, text);
  return {parse_number(option, words[0]), parse_number(option, words[1]),
          parse_number(option, words[2])};
}

Vec3 parse_spacing(const std::string& option, std::string_view text) {
  const Vec3 spacing = parse_vector(option, text);
  for (const double length : spacing) {
    if (length <= 0.0) {
      throw CLI::ValidationError(option, quoted(text) + ": a spacing must be greater than 0");
    }
  }
  return spacing;
}

Index3 parse_dims(const std::string& option, std::string_view text) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  const std::array<std::string_view, 3> words = three_words(option, text);
  return {parse_integer(option, words[0], 1, kMost), parse_integer(option, words[1], 1, kMost),
          parse_integer(option, words[2], 1, kMost)};
}

Boundary parse_boundary(const std::string& option, std::string_view text) {
  const std::vector<std::string_view> words = split_at_commas(text);
  Boundary boundary{};
  if (words.size() == 1) {
    boundary.fill(parse_name(option, words[0], kSides));
    return boundary;
  }
  if (words.size() != boundary.size()) {
    throw CLI::ValidationError(option, quoted(text) + " names " + std::to_string(words.size()) +
                                           " sides; one name for all or six wanted: "
                                           "xlo,xhi,ylo,yhi,zlo,zhi");
  }
  for (std::size_t side = 0; side < boundary.size(); ++side) {
    boundary[side] = parse_name(option, words[side], kSides);
  }
  for (std::size_t low = 0; low < boundary.size(); low += 2) {
    if ((boundary[low] == Side::periodic) != (boundary[low + 1] == Side::periodic)) {
      throw CLI::ValidationError(option, quoted(text) +
                                             ": both sides of an axis must be periodic, "
                                             "or none of them");
    }
  }
  return boundary;
}

std::array<double, 2> parse_range(const std::string& option, const std::string& text) {
  const std::vector<std::string_view> words = split_at_commas(text);
  if (words.size() != 2) {
    throw CLI::ValidationError(option, "'" + text + "' is not two numbers with a comma between");
  }
  const std::array<double, 2> range{parse_number(option, words[0]), parse_number(option, words[1])};
  if (range[0] > range[1]) {
    throw CLI::ValidationError(option, "'" + text + "' has its larger number first");
  }
  return range;
}

}  // namespace difmesh::cli
