#pragma once
/// \file export_mesh.hpp
/// The arrays of a Mesh, filled from the items of another library. Internal to the adapters.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "difmesh/error.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

class MeshBuilder {
 public:
  /// \return the number of the vertex
  template <class Point>
  std::uint32_t add_position(const Point& p) {
    constexpr std::size_t kMost = 0xffffffffU;
    if (mesh_.positions.size() >= kMost) {
      throw Error(ErrorCode::too_large, "the mesh has more than 2^32 - 1 vertices");
    }
    mesh_.positions.push_back(vector(p));
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }
  template <class Normal>
  void add_normal(const Normal& n) {
    mesh_.normals.push_back(vector(n));
  }
  void add_edge_id(std::uint64_t id) { mesh_.edge_ids.push_back(id); }
  /// \return where its values go, valid until the next call
  Array<double>& add_scalar(const std::string& name) {
    return mesh_.scalars.emplace_back(VertexScalar{name, {}}).values;
  }

  void start_face() { corners_ = 0; }
  /// The third corner of a face and those after make a triangle with the first and the last one.
  void add_corner(std::uint32_t vertex) {
    if (corners_ == 0) {
      first_ = vertex;
    } else if (corners_ > 1) {
      mesh_.triangles.push_back({first_, last_, vertex});
    }
    last_ = vertex;
    ++corners_;
  }

  [[nodiscard]] Mesh finish() && {
    if (std::adjacent_find(mesh_.edge_ids.begin(), mesh_.edge_ids.end(), std::greater_equal<>()) !=
        mesh_.edge_ids.end()) {
      mesh_.edge_ids.clear();
    }
    return std::move(mesh_);
  }

 private:
  template <class Vector>
  static Vec3 vector(const Vector& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  }

  Mesh mesh_;
  std::size_t corners_ = 0;  // of the present face
  std::uint32_t first_ = 0;
  std::uint32_t last_ = 0;
};

}  // namespace difmesh::detail
