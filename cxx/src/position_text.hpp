#pragma once
// How numbers and positions look in messages. Not to_text(), which is what io has in this
// namespace.

#include <array>
#include <cstdio>
#include <string>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// Nine digits: enough to find a place, short enough to read.
[[nodiscard]] inline std::string rounded_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
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
