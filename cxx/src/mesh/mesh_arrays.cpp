#include "mesh/mesh_arrays.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "difmesh/error.hpp"

namespace difmesh::detail {

void check_mesh_arrays(const std::string& caller, std::span<const Vec3> positions,
                       std::span<const Triangle> triangles) {
  if (positions.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::too_large, caller + ": the mesh has " +
                                          std::to_string(positions.size()) +
                                          " vertices, more than 2^32 - 1");
  }
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3& p = positions[v];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
      throw Error(ErrorCode::invalid_argument,
                  caller + ": the position of vertex " + std::to_string(v) + " is not finite");
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) {
      if (v >= positions.size()) {
        throw Error(ErrorCode::invalid_argument,
                    caller + ": triangle " + std::to_string(t) + " refers to vertex " +
                        std::to_string(v) + ", but the mesh has " +
                        std::to_string(positions.size()) + " vertices");
      }
    }
  }
}

}  // namespace difmesh::detail
