#include "difmesh/printable.hpp"

#include <array>
#include <cstdint>

namespace difmesh {
namespace {

/// One character of UTF-8: its bytes and number; no bytes where the text is no UTF-8.
struct Character {
  std::size_t bytes = 0;
  std::uint32_t number = 0;
};

Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) {
    return std::uint32_t{static_cast<unsigned char>(text[i])};
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) {
    return {1, lead};
  }
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) {
    return {};
  }
  std::uint32_t number = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) {
      return {};
    }
    number = (number << 6U) | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = number >= 0xD800 && number <= 0xDFFF;
  return number < least[bytes] || is_surrogate || number > 0x10FFFF ? Character{}
                                                                    : Character{bytes, number};
}

/// Control characters, and what turns or hides the text around it.
bool is_printable(std::uint32_t number) {
  struct Range {
    std::uint32_t first;
    std::uint32_t last;
  };
  constexpr std::array<Range, 6> hidden{{{0, 0x1F},
                                         {0x7F, 0x9F},
                                         {0x200B, 0x200F},
                                         {0x2028, 0x202E},
                                         {0x2060, 0x206F},
                                         {0xFEFF, 0xFEFF}}};
  for (const Range& range : hidden) {
    if (number >= range.first && number <= range.last) {
      return false;
    }
  }
  return true;
}

void append_escaped(std::string& text, char byte) {
  constexpr std::string_view digits = "0123456789abcdef";
  const auto value = static_cast<unsigned char>(byte);
  text += '\\';
  if (byte == '\n' || byte == '\r' || byte == '\t') {
    text += byte == '\n' ? 'n' : byte == '\r' ? 'r' : 't';
    return;
  }
  text += 'x';
  text += digits[value >> 4U];
  text += digits[value & 15U];
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t bytes = character.bytes > 0 ? character.bytes : 1;
    const bool as_it_is = character.bytes > 0 && is_printable(character.number);
    for (const char byte : text.substr(0, bytes)) {
      if (as_it_is) {
        result += byte;
      } else {
        append_escaped(result, byte);
      }
    }
    text.remove_prefix(bytes);
  }
  return result;
}

}  // namespace difmesh
