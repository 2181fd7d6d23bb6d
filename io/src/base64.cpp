#include "base64.hpp"

#include <array>
#include <utility>

namespace difmesh::detail {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::int8_t, 256> value_table() {
  std::array<std::int8_t, 256> table{};
  table.fill(-1);
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    table[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  }
  return table;
}
constexpr std::array<std::int8_t, 256> kValues = value_table();

}  // namespace

Base64Encoder::Base64Encoder(std::string_view prefix, std::uint64_t expected_bytes)
    : text_(prefix) {
  text_.reserve(prefix.size() + static_cast<std::size_t>((expected_bytes + 2) / 3 * 4));
}

void Base64Encoder::add(const void* data, std::size_t bytes) {
  const auto* from = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i) {
    bits_ = (bits_ << 8U) | from[i];
    if (++bytes_ == 3) {
      put(4);
    }
  }
}

void Base64Encoder::put(std::size_t digits) {
  const std::uint32_t left = bits_ << (8U * (3U - static_cast<std::uint32_t>(bytes_)));
  for (std::size_t d = 0; d < 4; ++d) {
    const std::uint32_t digit = (left >> (18U - 6U * static_cast<std::uint32_t>(d))) & 63U;
    text_ += d < digits ? kDigits[digit] : '=';
  }
  bits_ = 0;
  bytes_ = 0;
}

std::string Base64Encoder::finish() {
  if (bytes_ > 0) {
    put(bytes_ + 1);
  }
  return std::move(text_);
}

std::optional<std::vector<char>> from_base64(std::string_view text) {
  while (!text.empty() && text.back() == '=') {
    text.remove_suffix(1);
  }
  std::vector<char> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  unsigned count = 0;
  for (const char c : text) {
    const std::int8_t value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) {
      return std::nullopt;
    }
    bits = (bits << 6U) | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<char>((bits >> count) & 0xFFU));
    }
  }
  if (count >= 6) {
    return std::nullopt;  // a last digit that adds no byte
  }
  return bytes;
}

}  // namespace difmesh::detail
