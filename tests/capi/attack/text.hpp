#pragma once
/// \file text.hpp
/// Words about findings.

#include <string>

#include "specimen.hpp"

namespace difmesh::attack {

/// As printf() would print it, up to 400 characters.
[[nodiscard, gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);
/// "(1, 2, 3)"
[[nodiscard]] std::string node_text(const Index3& node);

}  // namespace difmesh::attack
