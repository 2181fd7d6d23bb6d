#pragma once
/// \file ply_values.hpp
/// The values of a PLY file one after the other, text and binary by the same calls. Copies go on
/// from where the original is.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "ply_header.hpp"
#include "scanner.hpp"
#include "text.hpp"

namespace difmesh::detail {

/// Values of a text PLY: one line per item.
class TextValues {
 public:
  TextValues(const std::filesystem::path& path, const PlyHeader& header, std::string_view text)
      : lines_(path, text.substr(header.data_offset), {.lines_before = header.lines}) {}
  void begin_item() {
    if (!lines_.next_line()) {
      lines_.fail("truncated: the data end here");
    }
  }
  void end_item() {
    if (!lines_.word().empty()) {
      lines_.fail("more values than the element has properties");
    }
  }
  double number(PlyType) { return lines_.number("a value"); }
  /// Anything that is no number is NaN: the mesh does not need it.
  double scalar(PlyType) {
    const std::string_view word = lines_.word();
    if (word.empty()) {
      lines_.fail("a value is missing");
    }
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = error == std::errc() && end == word.data() + word.size();
    return is_number ? number : std::numeric_limits<double>::quiet_NaN();
  }
  std::int64_t integer(PlyType) { return lines_.integer("an index or length"); }
  void skip(PlyType) {
    if (lines_.word().empty()) {
      lines_.fail("a value is missing");
    }
  }
  /// What follows the last item, in words; empty if nothing does.
  std::string tail() {
    return lines_.next_line() ? "what follows the data, from line " +
                                    std::to_string(lines_.line_number()) + " on, was left out"
                              : std::string();
  }
  static constexpr std::int64_t smallest_size(PlyType) { return 2; }  // a digit and a space

 private:
  Scanner lines_;
};

template <class T>
[[nodiscard]] T reversed(T value) {
  std::array<std::byte, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof value);
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// Values of a binary PLY.
template <bool kSwap>
class BinaryValues {
 public:
  BinaryValues(const std::filesystem::path& path, const PlyHeader& header, std::string_view text)
      : path_(path), text_(text), at_(header.data_offset) {}
  void begin_item() {}
  void end_item() {}
  double number(PlyType type) { return take<double>(type); }
  double scalar(PlyType type) { return take<double>(type); }
  std::int64_t integer(PlyType type) { return take<std::int64_t>(type); }
  void skip(PlyType type) { (void)bytes(static_cast<std::size_t>(size_of(type))); }
  [[nodiscard]] std::string tail() const {
    return at_ < text_.size() ? count_of(text_.size() - at_, "byte") + " behind the data left out"
                              : std::string();
  }
  static constexpr std::int64_t smallest_size(PlyType type) { return size_of(type); }

 private:
  const char* bytes(std::size_t count) {
    if (text_.size() - at_ < count) {
      fail_format(path_, "truncated: " + std::to_string(at_ + count) + " bytes or more wanted, " +
                             std::to_string(text_.size()) + " found");
    }
    return text_.data() + std::exchange(at_, at_ + count);
  }
  template <class T>
  T value() {
    T result{};
    std::memcpy(&result, bytes(sizeof result), sizeof result);
    return kSwap ? reversed(result) : result;
  }
  template <class Result>
  Result take(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return static_cast<Result>(value<std::int8_t>());
      case PlyType::uint8:
        return static_cast<Result>(value<std::uint8_t>());
      case PlyType::int16:
        return static_cast<Result>(value<std::int16_t>());
      case PlyType::uint16:
        return static_cast<Result>(value<std::uint16_t>());
      case PlyType::int32:
        return static_cast<Result>(value<std::int32_t>());
      case PlyType::uint32:
        return static_cast<Result>(value<std::uint32_t>());
      case PlyType::int64:
        return static_cast<Result>(value<std::int64_t>());
      case PlyType::uint64:
        return static_cast<Result>(value<std::uint64_t>());
      case PlyType::float32:
        return static_cast<Result>(value<float>());
      case PlyType::float64:
        return static_cast<Result>(value<double>());
    }
    return Result{};
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  std::size_t at_;
};

}  // namespace difmesh::detail
