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
  const std::size_t rest = text.size() % 4;
  if (rest == 1) {
    return std::nullopt;  // a last digit that adds no byte
  }
  std::vector<char> bytes(text.size() / 4 * 3 + (rest > 0 ? rest - 1 : 0));
  std::int32_t all = 0;  // negative as soon as one value is
  const auto value = [&](std::size_t at) {
    const std::int32_t digit = kValues[static_cast<unsigned char>(text[at])];
    all |= digit;
    return static_cast<std::uint32_t>(digit);
  };
  char* out = bytes.data();
  for (std::size_t at = 0; at + 4 <= text.size(); at += 4) {
    const std::uint32_t bits =
        (value(at) << 18U) | (value(at + 1) << 12U) | (value(at + 2) << 6U) | value(at + 3);
    *out++ = static_cast<char>((bits >> 16U) & 0xFFU);
    *out++ = static_cast<char>((bits >> 8U) & 0xFFU);
    *out++ = static_cast<char>(bits & 0xFFU);
  }
  std::uint32_t bits = 0;
  for (std::size_t digit = 0; digit < rest; ++digit) {
    bits |= value(text.size() - rest + digit) << (18U - 6U * static_cast<std::uint32_t>(digit));
  }
  for (std::size_t byte = 0; byte + 1 < rest; ++byte) {
    *out++ = static_cast<char>((bits >> (16U - 8U * static_cast<std::uint32_t>(byte))) & 0xFFU);
  }
  return all < 0 ? std::nullopt : std::optional(std::move(bytes));
}

}  // namespace difmesh::detail
