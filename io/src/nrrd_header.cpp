#include "nrrd_header.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "nrrd_axes.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kLongestHeader = 1 << 20;

struct NamedType {
  std::string_view name;
  ValueType type;
};
constexpr std::array kTypes{NamedType{"float", ValueType::float32},
                            NamedType{"double", ValueType::float64},
                            NamedType{"signed char", ValueType::int8},
                            NamedType{"int8", ValueType::int8},
                            NamedType{"int8_t", ValueType::int8},
                            NamedType{"uchar", ValueType::uint8},
                            NamedType{"unsigned char", ValueType::uint8},
                            NamedType{"uint8", ValueType::uint8},
                            NamedType{"uint8_t", ValueType::uint8},
                            NamedType{"short", ValueType::int16},
                            NamedType{"short int", ValueType::int16},
                            NamedType{"signed short", ValueType::int16},
                            NamedType{"signed short int", ValueType::int16},
                            NamedType{"int16", ValueType::int16},
                            NamedType{"int16_t", ValueType::int16},
                            NamedType{"ushort", ValueType::uint16},
                            NamedType{"unsigned short", ValueType::uint16},
                            NamedType{"unsigned short int", ValueType::uint16},
                            NamedType{"uint16", ValueType::uint16},
                            NamedType{"uint16_t", ValueType::uint16},
                            NamedType{"int", ValueType::int32},
                            NamedType{"signed int", ValueType::int32},
                            NamedType{"int32", ValueType::int32},
                            NamedType{"int32_t", ValueType::int32},
                            NamedType{"uint", ValueType::uint32},
                            NamedType{"unsigned int", ValueType::uint32},
                            NamedType{"uint32", ValueType::uint32},
                            NamedType{"uint32_t", ValueType::uint32},
                            NamedType{"longlong", ValueType::int64},
                            NamedType{"long long", ValueType::int64},
                            NamedType{"long long int", ValueType::int64},
                            NamedType{"signed long long", ValueType::int64},
                            NamedType{"signed long long int", ValueType::int64},
                            NamedType{"int64", ValueType::int64},
                            NamedType{"int64_t", ValueType::int64},
                            NamedType{"ulonglong", ValueType::uint64},
                            NamedType{"unsigned long long", ValueType::uint64},
                            NamedType{"unsigned long long int", ValueType::uint64},
                            NamedType{"uint64", ValueType::uint64},
                            NamedType{"uint64_t", ValueType::uint64}};

/// Fields without a say in where the samples are or what they are worth.
constexpr std::array kIgnored{
    std::string_view{"content"},     std::string_view{"number"},
    std::string_view{"min"},         std::string_view{"max"},
    std::string_view{"oldmin"},      std::string_view{"oldmax"},
    std::string_view{"thicknesses"}, std::string_view{"labels"},
    std::string_view{"units"},       std::string_view{"sampleunits"},
    std::string_view{"spaceunits"},  std::string_view{"measurementframe"},
};

constexpr std::array kAxisFields{std::string_view{"sizes"},    std::string_view{"spacings"},
                                 std::string_view{"axismins"}, std::string_view{"axismaxs"},
                                 std::string_view{"centers"},  std::string_view{"kinds"}};

constexpr std::int64_t kMostAxes = 16;
constexpr std::int64_t kMostFiles = 65536;
constexpr std::int64_t kMostNumber = std::int64_t{1} << 40;

/// A file's name with a number in it: slice%03d.raw.
struct NumberedName {
  std::string before;
  std::string after;
  std::size_t width = 0;
  char fill = ' ';

  [[nodiscard]] std::string with(std::int64_t number) const {
    const std::string digits = std::to_string(number);
    const std::size_t gap = width > digits.size() ? width - digits.size() : 0;
    return before + std::string(gap, fill) + digits + after;
  }
};

/// Nothing where the pattern has not exactly one % and what belongs to a number behind it.
std::optional<NumberedName> numbered_name(std::string_view pattern) {
  NumberedName name;
  const std::size_t percent = pattern.find('%');
  name.before = pattern.substr(0, percent);
  pattern.remove_prefix(percent + 1);
  if (pattern.starts_with('0')) {
    name.fill = '0';
  }
  const std::size_t letter = pattern.find_first_not_of("0123456789");
  if (letter > 4 || (pattern[letter] != 'd' && pattern[letter] != 'u') ||
      pattern.find('%') != std::string_view::npos) {
    return std::nullopt;
  }
  name.width = static_cast<std::size_t>(to_integer(pattern.substr(0, letter)).value_or(0));
  name.after = pattern.substr(letter + 1);
  return name.width <= 64 ? std::optional(name) : std::nullopt;
}

template <std::size_t N>
bool one_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& path, std::string_view text)
      : path_(path), text_(text), at_(text.size() - plain_text(path, text).size()) {}

  NrrdHeader parse() {
    magic();
    while (next_line() && !line_.empty()) {
      if (line_[0] != '#') {
        parse_line();
      }
    }
    const bool ended = line_number_ > 1 && line_.empty();
    require("type");
    require("dimension");
    require("sizes");
    require("encoding");
    if (header_.data_files.empty() && !ended) {
      fail_format(path_, "truncated: no blank line ends the NRRD header");
    }
    set_axes(path_, axes_, header_);
    header_.data_offset = static_cast<std::int64_t>(at_);
    return header_;
  }

 private:
  [[noreturn]] void fail(const std::string& matter) const {
    fail_format(path_, "NRRD header, line " + std::to_string(line_number_) + ": " + matter);
  }

  /// False at the end of the text.
  bool next_line() {
    if (at_ >= text_.size()) {
      return false;
    }
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    if (line_.ends_with('\r')) {
      line_.remove_suffix(1);
    }
    at_ = std::min(end + 1, text_.size());
    ++line_number_;
    return true;
  }

  void magic() {
    if (!next_line() || !line_.starts_with("NRRD")) {
      fail_format(path_, "no NRRD file: it does not start with NRRD");
    }
    const std::optional<std::int64_t> version = to_integer(line_.substr(4));
    if (line_.size() != 8 || !version || *version < 1 || *version > 5) {
      fail(in_quotes(line_.substr(0, 20)) + "; NRRD0001 to NRRD0005 can be read");
    }
  }

  void parse_line() {
    const std::size_t colon = line_.find(':');
    if (colon == std::string_view::npos) {
      fail("neither a field, a key nor a comment");
    }
    const std::string_view rest = line_.substr(colon + 1);
    if (rest.starts_with('=')) {
      key(line_.substr(0, colon), rest.substr(1));
      return;
    }
    name_ = std::string(line_.substr(0, colon));
    value_ = trimmed(rest);
    // Teem takes "data file" and "datafile" alike; spaces in names tell nothing apart.
    std::string field = lower_case(name_);
    std::erase(field, ' ');
    if (!seen_.insert(field).second) {
      fail("field '" + name_ + "' comes twice");
    }
    if (!sample_field(field) && !axis_field(field) && !space_field(field) && !data_field(field) &&
        !one_of<kIgnored.size()>(field, kIgnored)) {
      fail("unknown field '" + name_ + "'");
    }
  }

  void key(std::string_view name, std::string_view value) {
    if (name == kLowCornerKey) {
      const std::vector<std::string_view> words = words_of(value);
      Vec3 corner{};
      for (std::size_t i = 0; i < 3 && words.size() == 3; ++i) {
        const std::optional<double> number = to_number(words[i]);
        if (!number) {
          return;
        }
        corner[i] = *number;
        header_.low_corner = i == 2 ? std::optional<Vec3>(corner) : std::nullopt;
      }
    }
  }

  bool sample_field(const std::string& field) {
    if (field == "type") {
      header_.type = value_type();
    } else if (field == "dimension") {
      const std::optional<std::int64_t> dimension = to_integer(value_);
      if (!dimension || *dimension < 3 || *dimension > kMostAxes) {
        fail("dimension " + std::string(value_) + "; a field has dimension 3");
      }
      axes_.dimension = *dimension;
    } else if (field == "encoding") {
      header_.encoding = encoding();
    } else if (field == "endian") {
      const std::string order = lower_case(value_);
      if (order != "little" && order != "big") {
        fail("endian '" + std::string(value_) + "' is neither little nor big");
      }
      header_.big_endian = order == "big";
    } else if (field == "blocksize") {
      fail("blocks cannot be read");
    } else {
      return false;
    }
    return true;
  }

  [[nodiscard]] ValueType value_type() const {
    const std::string name = lower_case(value_);
    const auto known = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const NamedType& type) { return type.name == name; });
    if (known == kTypes.end()) {
      fail("type '" + std::string(value_) +
           "'; float, double and integers of 8 to 64 bits can be read");
    }
    return known->type;
  }

  [[nodiscard]] NrrdEncoding encoding() const {
    const std::string name = lower_case(value_);
    if (name == "raw") {
      return NrrdEncoding::raw;
    }
    if (name == "gzip" || name == "gz" || name == "gzi") {
      return NrrdEncoding::gzip;
    }
    if (name == "ascii" || name == "text" || name == "txt") {
      return NrrdEncoding::ascii;
    }
    fail("encoding '" + std::string(value_) + "'; raw, gzip and ascii can be read");
  }

  bool axis_field(const std::string& field) {
    const std::string one_name = field == "centerings" ? "centers" : field;
    if (!one_of<kAxisFields.size()>(one_name, kAxisFields)) {
      return false;
    }
    axes_.fields[one_name] = {name_, line_number_, words_of(value_)};
    return true;
  }

  bool space_field(const std::string& field) {
    if (field == "space") {
      const std::string name = lower_case(value_);
      if (name.ends_with("time") || name.ends_with('t')) {
        fail("space '" + std::string(value_) + "' has more than three dimensions");
      }
    } else if (field == "spacedimension") {
      if (value_ != "3") {
        fail("space dimension " + std::string(value_) + "; a field lies in space of dimension 3");
      }
    } else if (field == "spacedirections") {
      axes_.directions_line = line_number_;
      for (value_ = trimmed(value_); !value_.empty(); value_ = trimmed(value_)) {
        const bool none = lower_case(value_.substr(0, 4)) == "none";
        axes_.directions.push_back(none ? std::nullopt : std::optional<Vec3>(vector()));
        value_.remove_prefix(none ? 4 : 0);
      }
    } else if (field == "spaceorigin") {
      header_.space_origin = vector();
      expect_end();
    } else {
      return false;
    }
    return true;
  }

  bool data_field(const std::string& field) {
    if (field == "lineskip") {
      header_.line_skip = skip(0);
    } else if (field == "byteskip") {
      header_.byte_skip = skip(-1);
    } else if (field == "datafile") {
      data_files();
    } else {
      return false;
    }
    return true;
  }

  [[nodiscard]] std::int64_t skip(std::int64_t smallest) const {
    const std::optional<std::int64_t> number = to_integer(value_);
    if (!number || *number < smallest) {
      fail(in_quotes(name_) + " of " + in_quotes(value_));
    }
    return *number;
  }

  /// One name; LIST [DIMENSION] and names in the lines that follow; or a name with %d in it, the
  /// first and the last number, the step and [DIMENSION].
  void data_files() {
    const std::vector<std::string_view> words = words_of(value_);
    if (words.empty()) {
      fail("the data file has no name");
    }
    if (words[0] == "LIST" && words.size() <= 2) {
      axes_.file_dimension = words.size() == 2 ? whole(words[1]) : 0;
      while (next_line() && !line_.empty()) {
        header_.data_files.emplace_back(line_);
      }
      at_ = text_.size();
    } else if (is_pattern(words)) {
      numbered_files(words);
    } else {
      header_.data_files.emplace_back(value_);
    }
    if (header_.data_files.empty() || header_.data_files.size() > kMostFiles) {
      fail(std::to_string(header_.data_files.size()) + " data files");
    }
  }

  [[nodiscard]] static bool is_pattern(const std::vector<std::string_view>& words) {
    bool numbers = words.size() == 4 || words.size() == 5;
    for (std::size_t n = 1; numbers && n < words.size(); ++n) {
      numbers = to_integer(words[n]).has_value();
    }
    return numbers && words[0].find('%') != std::string_view::npos;
  }

  void numbered_files(const std::vector<std::string_view>& words) {
    const std::optional<NumberedName> name = numbered_name(words[0]);
    const std::int64_t first = whole(words[1]);
    const std::int64_t last = whole(words[2]);
    const std::int64_t step = whole(words[3]);
    const bool ascends = step > 0;
    // Small numbers, so that their differences do not overflow.
    if (!name || step == 0 || std::max({first, last, step}) > kMostNumber ||
        std::min(first, last) < 0 || step < -kMostNumber) {
      fail("the data files " + in_quotes(value_) +
           " need a name such as slice%03d.raw, the first and the last number, and a step");
    }
    if (ascends ? last < first : last > first) {
      fail("no number from " + std::to_string(first) + " to " + std::to_string(last) +
           " in steps of " + std::to_string(step));
    }
    if ((last - first) / step >= kMostFiles) {
      fail(std::to_string((last - first) / step + 1) + " data files");
    }
    axes_.file_dimension = words.size() == 5 ? whole(words[4]) : 0;
    for (std::int64_t n = first; ascends ? n <= last : n >= last; n += step) {
      header_.data_files.push_back(name->with(n));
    }
  }

  [[nodiscard]] std::int64_t whole(std::string_view word) const {
    const std::optional<std::int64_t> number = to_integer(word);
    if (!number) {
      fail(in_quotes(word) + " in field " + in_quotes(name_) + " is no integer");
    }
    return *number;
  }

  [[nodiscard]] double number(std::string_view word) const {
    const std::optional<double> value = to_number(trimmed(word));
    if (!value) {
      fail(in_quotes(word) + " in field " + in_quotes(name_) + " is no number");
    }
    return *value;
  }

  /// Takes "(x,y,z)" off the front of the value.
  Vec3 vector() {
    value_ = trimmed(value_);
    const std::size_t close = value_.find(')');
    if (!value_.starts_with('(') || close == std::string_view::npos) {
      fail("field '" + name_ + "' needs vectors such as (0,0,1)");
    }
    std::string_view inside = value_.substr(1, close - 1);
    value_.remove_prefix(close + 1);
    if (std::count(inside.begin(), inside.end(), ',') != 2) {
      fail("a vector in field '" + name_ + "' has not three components");
    }
    Vec3 vector{};
    for (double& component : vector) {
      const std::size_t comma = std::min(inside.find(','), inside.size());
      component = number(inside.substr(0, comma));
      inside.remove_prefix(std::min(comma + 1, inside.size()));
    }
    return vector;
  }

  void expect_end() const {
    if (!trimmed(value_).empty()) {
      fail("more vectors in field '" + name_ + "' than the field has dimensions");
    }
  }

  void require(const std::string& field) const {
    if (!seen_.contains(field)) {
      fail_format(path_, "the NRRD header has no field '" + field + "'");
    }
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::int64_t line_number_ = 0;
  std::string_view line_;
  std::string name_;        ///< of the field being parsed, as written
  std::string_view value_;  ///< of the field being parsed
  std::set<std::string> seen_;
  NrrdAxes axes_;
  NrrdHeader header_;
};

}  // namespace

NrrdHeader read_nrrd_header(const InputFile& file) {
  const Array<char> text = file.read_text(0, kLongestHeader);
  return HeaderParser(file.path(), {text.data(), text.size()}).parse();
}

}  // namespace difmesh::detail
