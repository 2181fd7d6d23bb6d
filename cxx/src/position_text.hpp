#pragma once
// How numbers and positions look in messages.

#include <array>
#include <cstdio>
#include <string>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// Nine digits: enough to find a place, short enough to read.
[[nodiscard]] inline std::string to_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
}

[[nodiscard]] inline std::string to_text(const Vec3& position) {
  std::string text = "(";
  text += to_text(position[0]);
  text += ", ";
  text += to_text(position[1]);
  text += ", ";
  text += to_text(position[2]);
  text += ")";
  return text;
}

}  // namespace difmesh::detail
