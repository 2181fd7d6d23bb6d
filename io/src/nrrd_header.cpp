#include "nrrd_header.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kLongestHeader = 1 << 20;

/// Fields without a say in where the samples are or what they are worth.
constexpr std::array kIgnored{
    std::string_view{"content"},     std::string_view{"number"},
    std::string_view{"min"},         std::string_view{"max"},
    std::string_view{"oldmin"},      std::string_view{"oldmax"},
    std::string_view{"thicknesses"}, std::string_view{"labels"},
    std::string_view{"units"},       std::string_view{"sampleunits"},
    std::string_view{"spaceunits"},  std::string_view{"measurementframe"},
};

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
    if (header_.data_file.empty() && !ended) {
      fail_format(path_, "truncated: no blank line ends the NRRD header");
    }
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
      header_.type = scalar_type();
    } else if (field == "dimension") {
      if (value_ != "3") {
        fail("dimension " + std::string(value_) + "; a field has dimension 3");
      }
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

  [[nodiscard]] ScalarType scalar_type() const {
    const std::string name = lower_case(value_);
    if (name == "float") {
      return ScalarType::float32;
    }
    if (name == "double") {
      return ScalarType::float64;
    }
    if (name == "uchar" || name == "unsigned char" || name == "uint8" || name == "uint8_t") {
      return ScalarType::uint8;
    }
    if (name == "ushort" || name == "unsigned short" || name == "unsigned short int" ||
        name == "uint16" || name == "uint16_t") {
      return ScalarType::uint16;
    }
    fail("type '" + std::string(value_) + "'; float, double, uchar and ushort can be read");
  }

  [[nodiscard]] NrrdEncoding encoding() const {
    const std::string name = lower_case(value_);
    if (name == "raw") {
      return NrrdEncoding::raw;
    }
    if (name == "gzip" || name == "gz") {
      return NrrdEncoding::gzip;
    }
    if (name == "ascii" || name == "text" || name == "txt") {
      return NrrdEncoding::ascii;
    }
    fail("encoding '" + std::string(value_) + "'; raw, gzip and ascii can be read");
  }

  bool axis_field(const std::string& field) {
    if (field == "sizes") {
      const std::vector<std::string_view> words = three_words();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::optional<std::int64_t> size = to_integer(words[axis]);
        if (!size) {
          fail("size '" + std::string(words[axis]) + "' is no integer");
        }
        header_.sizes[axis] = *size;
      }
    } else if (field == "spacings") {
      header_.spacings = three_numbers();
    } else if (field == "axismins") {
      header_.axis_mins = three_numbers();
    } else if (field == "axismaxs") {
      header_.axis_maxs = three_numbers();
    } else if (field == "centers" || field == "centerings") {
      const std::vector<std::string_view> words = three_words();
      std::transform(words.begin(), words.end(), header_.node_centred.begin(),
                     [](std::string_view word) { return lower_case(word) == "node"; });
    } else if (field == "kinds") {
      check_kinds();
    } else {
      return false;
    }
    return true;
  }

  void check_kinds() const {
    constexpr std::array<std::string_view, 4> spatial{"domain", "space", "???", "none"};
    for (const std::string_view kind : three_words()) {
      if (!one_of<4>(lower_case(kind), spatial)) {
        fail("an axis of kind '" + std::string(kind) + "'; a field has three axes in space");
      }
    }
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
      header_.space_directions.emplace();
      for (Vec3& direction : *header_.space_directions) {
        direction = vector();
      }
      expect_end();
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
      if (value_.starts_with("LIST") || value_.find('%') != std::string_view::npos) {
        fail("data in several files (LIST or %d); join them into one");
      }
      if (value_.empty()) {
        fail("the data file has no name");
      }
      header_.data_file = std::string(value_);
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

  [[nodiscard]] std::vector<std::string_view> three_words() const {
    std::vector<std::string_view> words = words_of(value_);
    if (words.size() != 3) {
      fail("field '" + name_ + "' needs 3 values and has " + std::to_string(words.size()));
    }
    return words;
  }

  [[nodiscard]] double number(std::string_view word) const {
    const std::optional<double> value = to_number(trimmed(word));
    if (!value) {
      fail(in_quotes(word) + " in field " + in_quotes(name_) + " is no number");
    }
    return *value;
  }

  [[nodiscard]] Vec3 three_numbers() const {
    const std::vector<std::string_view> words = three_words();
    return {number(words[0]), number(words[1]), number(words[2])};
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
  NrrdHeader header_;
};

}  // namespace

NrrdHeader read_nrrd_header(const InputFile& file) {
  const Array<char> text = file.read_text(0, kLongestHeader);
  return HeaderParser(file.path(), {text.data(), text.size()}).parse();
}

}  // namespace difmesh::detail
