#include "ply_header.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "text.hpp"

namespace difmesh::detail {
namespace {

std::optional<PlyType> type_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 18> names{{
      {"char", PlyType::int8},
      {"int8", PlyType::int8},
      {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},
      {"short", PlyType::int16},
      {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},
      {"uint16", PlyType::uint16},
      {"int", PlyType::int32},
      {"int32", PlyType::int32},
      {"uint", PlyType::uint32},
      {"uint32", PlyType::uint32},
      {"int64", PlyType::int64},
      {"uint64", PlyType::uint64},
      {"float", PlyType::float32},
      {"float32", PlyType::float32},
      {"double", PlyType::float64},
      {"float64", PlyType::float64},
  }};
  const auto* const found =
      std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.first == name; });
  return found == names.end() ? std::nullopt : std::optional<PlyType>(found->second);
}

class PlyHeaderParser {
 public:
  PlyHeaderParser(const std::filesystem::path& path, std::string_view text)
      : path_(path), text_(text), line_end_(line_end(text)) {}

  PlyHeader parse() {
    if (!next_line() || words_.size() != 1 || words_[0] != "ply") {
      fail_format(path_, "no PLY file: it does not start with ply");
    }
    bool format_seen = false;
    while (next_line()) {
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") {
        continue;
      }
      if (words_[0] == "end_header") {
        if (!format_seen) {
          fail("the header has no format");
        }
        header_.data_offset = at_;
        header_.lines = line_number_;
        return std::move(header_);
      }
      if (words_[0] == "format") {
        format();
        format_seen = true;
      } else if (words_[0] == "element") {
        element();
      } else if (words_[0] == "property") {
        property();
      } else {
        fail("unknown word '" + std::string(words_[0].substr(0, 40)) + "' in the header");
      }
    }
    fail_format(path_, "truncated: no end_header ends the PLY header");
  }

 private:
  [[noreturn]] void fail(const std::string& matter) const {
    fail_format(path_, "line " + std::to_string(line_number_) + ": " + matter);
  }

  /// What ends the first line ends all: binary data may begin with a line feed.
  static char line_end(std::string_view text) {
    const std::size_t end = text.find_first_of("\r\n");
    const bool is_return =
        end != std::string_view::npos && text[end] == '\r' && text.substr(end + 1, 1) != "\n";
    return is_return ? '\r' : '\n';
  }

  bool next_line() {
    if (at_ >= text_.size()) {
      return false;
    }
    const std::size_t end = std::min(text_.find(line_end_, at_), text_.size());
    words_ = words_of(text_.substr(at_, end - at_));
    at_ = std::min(end + 1, text_.size());
    ++line_number_;
    return true;
  }

  void format() {
    const std::string_view name = words_.size() == 3 && words_[2] == "1.0" ? words_[1] : "";
    if (name == "ascii") {
      header_.encoding = PlyEncoding::text;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      fail("a format other than ascii, binary_little_endian or binary_big_endian 1.0");
    }
  }

  void element() {
    const std::optional<std::int64_t> count =
        words_.size() == 3 ? to_integer(words_[2]) : std::nullopt;
    if (!count || *count < 0) {
      fail("an element needs a name and a count");
    }
    header_.elements.push_back({std::string(words_[1]), *count, {}});
  }

  void property() {
    const bool list = words_.size() == 5 && words_[1] == "list";
    if (header_.elements.empty() || (!list && words_.size() != 3)) {
      fail("a property out of place or without type and name");
    }
    PlyProperty property;
    property.name = std::string(words_.back());
    const std::optional<PlyType> type = type_named(words_[words_.size() - 2]);
    if (list) {
      property.length_type = type_named(words_[2]);
    }
    if (!type || (list && !property.length_type)) {
      fail("a property of unknown type");
    }
    if (list && !is_integer(*property.length_type)) {
      fail("a list whose length is no integer");
    }
    property.type = *type;
    header_.elements.back().properties.push_back(std::move(property));
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  char line_end_;
  std::size_t at_ = 0;
  std::int64_t line_number_ = 0;
  std::vector<std::string_view> words_;
  PlyHeader header_;
};

}  // namespace

PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view text) {
  return PlyHeaderParser(path, text).parse();
}

}  // namespace difmesh::detail
