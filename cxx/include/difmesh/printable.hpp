#pragma once
/// \file printable.hpp
/// Text of others in messages.

#include <string>
#include <string_view>

namespace difmesh {

/// Text from files, names and callers, fit for a terminal and a line of a log: control characters,
/// characters that turn or hide others, and bytes that are no UTF-8 become \n, \r, \t or \xNN; the
/// rest is as it was. Printable text does not change.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace difmesh
