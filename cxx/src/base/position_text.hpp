#pragma once
// How numbers and positions look in messages. Not to_text(), which is what io has in this
// namespace.

#include <array>
#include <charconv>
#include <string>

#include "difmesh/vec3.hpp"

namespace difmesh::detail {

/// Nine digits: enough to find a place, short enough to read. A point before the decimals whatever
/// the caller's locale, which std::snprintf() and streams follow.
[[nodiscard]] inline std::string rounded_text(double value) {
  std::array<char, 32> text{};
  const auto result =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9);
  return {text.data(), result.ptr};
}

[[nodiscard]] inline std::string rounded_text(const Vec3& position) {
  std::string text = "(";
  text += rounded_text(position[0]);
  text += ", ";
  text += rounded_text(position[1]);
  text += ", ";
  text += rounded_text(position[2]);
  text += ")";
  return text;
}

}  // namespace difmesh::detail
