#include "json.hpp"

#include <algorithm>

#include "difmesh/printable.hpp"
#include "difmesh/version.hpp"

namespace difmesh::cli {

Json json_head() {
  return {{"program", "difmesh"}, {"version", DIFMESH_VERSION}};
}

std::string to_text(const Json& json) {
  const auto dump = [&](bool ascii) {
    return json.dump(2, ' ', ascii, Json::error_handler_t::replace) + "\n";
  };
  std::string text = dump(false);
  std::string line = text;
  std::replace(line.begin(), line.end(), '\n', ' ');
  // JSON may hold some control characters as they are, which terminals may not.
  return printable(line) == line ? text : dump(true);
}

}  // namespace difmesh::cli
