#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "text.hpp"

namespace difmesh::attack {
namespace {

template <class T>
bool same_bytes(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

template <class T>
std::span<const T> array_of(const T* data, std::int64_t count, std::size_t each) {
  return {data, static_cast<std::size_t>(count) * each};
}

}  // namespace

Surface surface_of(const dif_mesh* mesh) {
  const double* numbers = nullptr;
  const std::uint32_t* indices = nullptr;
  const std::uint64_t* ids = nullptr;
  std::int64_t count = 0;
  Surface surface;
  if (dif_mesh_positions(mesh, &numbers, &count) == DIF_OK) {
    surface.positions = array_of(numbers, count, 3);
  }
  if (dif_mesh_normals(mesh, &numbers, &count) == DIF_OK) {
    surface.normals = array_of(numbers, count, 3);
  }
  if (dif_mesh_edge_ids(mesh, &ids, &count) == DIF_OK) {
    surface.ids = array_of(ids, count, 1);
  }
  if (dif_mesh_triangles(mesh, &indices, &count) == DIF_OK) {
    surface.triangles = array_of(indices, count, 3);
  }
  return surface;
}

bool same_positions(const Surface& a, const Surface& b) {
  return same_bytes(a.positions, b.positions);
}

bool same_triangles(const Surface& a, const Surface& b) {
  return same_bytes(a.triangles, b.triangles);
}

Finding difference(const Surface& a, const Surface& b, const char* what) {
  if (!same_bytes(a.ids, b.ids)) {
    return {what, text("other edges: %zu and %zu vertices", a.vertices(), b.vertices())};
  }
  double most = 0.0;
  std::size_t first = a.positions.size();
  const bool positions = same_positions(a, b);
  const std::span<const double> one = positions ? a.normals : a.positions;
  const std::span<const double> other = positions ? b.normals : b.positions;
  if (one.size() != other.size()) {
    return {what, "other numbers of normals"};
  }
  if (positions && same_bytes(a.normals, b.normals)) {
    return same_triangles(a, b) ? Finding{} : Finding{what, "other triangles"};
  }
  for (std::size_t n = 0; n < one.size(); ++n) {
    if (!(one[n] == other[n])) {
      first = std::min(first, n / 3);
      most = std::max(most, std::abs(one[n] - other[n]));
    }
  }
  return {what, text("%s differ by up to %g, first at vertex %zu",
                     positions ? "normals" : "positions", most, first)};
}

}  // namespace difmesh::attack
