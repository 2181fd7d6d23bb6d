#include "surface/seam.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "difmesh/edge_id.hpp"
#include "difmesh/error.hpp"

namespace difmesh::detail {

Seam::Seam(const Index3& dims, bool with_ids, MeshSink sink)
    : dims_(dims), with_ids_(with_ids), sink_(std::move(sink)) {}

// The triangles that wait get the numbers that their vertices have as the first of this mesh.
void Seam::number_waiting(const Mesh& mesh) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(ids_.size());
  std::size_t n = 0;
  for (const std::uint64_t id : ids_) {
    while (mesh.edge_ids[n] != id) {
      ++n;
    }
    numbers.push_back(static_cast<std::uint32_t>(vertices_ + n));
  }
  for (Triangle& triangle : triangles_) {
    for (std::uint32_t& corner : triangle) {
      corner = corner < vertices_ ? corner : numbers[corner - vertices_];
    }
  }
}

void Seam::hand_on(const Mesh& mesh, std::size_t vertices,
                   std::span<const Triangle> triangles) const {
  if (vertices == 0 && triangles.empty()) {
    return;
  }
  const auto first = [&](const auto& all) {
    return std::span(all).first(std::min(all.size(), vertices));
  };
  MeshPortion portion;
  portion.positions = first(mesh.positions);
  portion.normals = first(mesh.normals);
  portion.edge_ids = with_ids_ ? first(mesh.edge_ids) : portion.edge_ids;
  portion.triangles = triangles;
  sink_(portion);
}

void Seam::add(Mesh mesh, std::int64_t shared_layer) {
  if (vertices_ + mesh.positions.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::too_large, "the mesh would have more than 2^32 - 1 vertices");
  }
  number_waiting(mesh);
  const std::uint64_t first_id =
      shared_layer < dims_[2] ? edge_id(dims_, {{-1, -1, shared_layer}, 0}) : edge_id_end(dims_);
  const auto known = static_cast<std::size_t>(
      std::lower_bound(mesh.edge_ids.begin(), mesh.edge_ids.end(), first_id) -
      mesh.edge_ids.begin());
  const auto first_to_wait =
      std::find_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& triangle) {
        return *std::max_element(triangle.begin(), triangle.end()) >= known;
      });
  if (vertices_ > 0) {
    for (Triangle& triangle : mesh.triangles) {
      for (std::uint32_t& corner : triangle) {
        corner += static_cast<std::uint32_t>(vertices_);
      }
    }
  }
  const std::span<const Triangle> final_ones(mesh.triangles.begin(), first_to_wait);
  if (triangles_.empty()) {
    hand_on(mesh, known, final_ones);
  } else {
    hand_on(mesh, known, triangles_);
    hand_on(mesh, 0, final_ones);
  }
  vertices_ += known;
  ids_.assign(mesh.edge_ids.begin() + static_cast<std::ptrdiff_t>(known), mesh.edge_ids.end());
  triangles_.assign(first_to_wait, mesh.triangles.end());
}

}  // namespace difmesh::detail
