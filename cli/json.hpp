#pragma once
/// \file json.hpp
/// Reports as JSON: keys in the order of writing, numbers that read back as the same float64.

#include <nlohmann/json.hpp>
#include <string>

namespace difmesh::cli {

using Json = nlohmann::ordered_json;

/// The start of every report: program and version.
[[nodiscard]] Json json_head();
/// Indented, a newline at the end. Bytes of paths that are no UTF-8 become U+FFFD; fit
/// for a terminal.
[[nodiscard]] std::string to_text(const Json& json);

}  // namespace difmesh::cli
