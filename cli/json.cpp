#include "json.hpp"

#include "difmesh/version.hpp"

namespace difmesh::cli {

Json json_head() {
  return {{"program", "difmesh"}, {"version", DIFMESH_VERSION}};
}

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace difmesh::cli
