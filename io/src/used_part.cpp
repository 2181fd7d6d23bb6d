#include "used_part.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace difmesh::detail {
namespace {

/// Bytes: bits cost twice the time for meshes of which all is used.
using Used = std::vector<std::uint8_t>;

template <class T>
Array<T> chosen(const Array<T>& values, const Used& is_used) {
  Array<T> result;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (is_used[v] != 0) {
      result.push_back(values[v]);
    }
  }
  return result;
}

}  // namespace

std::optional<Mesh> used_part(const Mesh& mesh) {
  Used is_used(mesh.positions.size(), 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      is_used[v] = 1;
    }
  }
  if (std::find(is_used.begin(), is_used.end(), std::uint8_t{0}) == is_used.end()) {
    return std::nullopt;
  }
  Mesh part;
  part.positions = chosen(mesh.positions, is_used);
  part.normals = chosen(mesh.normals, is_used);
  part.edge_ids = chosen(mesh.edge_ids, is_used);
  for (const VertexScalar& one : mesh.scalars) {
    part.scalars.push_back({one.name, chosen(one.values, is_used)});
  }
  std::vector<std::uint32_t> place(is_used.size());
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < place.size(); ++v) {
    place[v] = next;
    next += is_used[v];
  }
  part.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    part.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  }
  return part;
}

}  // namespace difmesh::detail
