#pragma once
/// \file mesh_portion.hpp
/// A mesh in portions: how surfaces that need not fit into memory are handed on.

#include <cstdint>
#include <functional>
#include <span>

#include "difmesh/mesh.hpp"

namespace difmesh {

/// Vertices and triangles that follow those of the portions before, in their final order. All
/// portions with vertices have the same arrays. Valid during the call that hands it over.
struct MeshPortion {
  std::span<const Vec3> positions = {};
  std::span<const Vec3> normals = {};            ///< empty, or one per position
  std::span<const std::uint64_t> edge_ids = {};  ///< likewise; see Mesh::edge_ids
  std::span<const VertexScalar> scalars = {};    ///< each with one value per position
  /// Indices are those of the whole mesh, of vertices in this portion or those before.
  std::span<const Triangle> triangles = {};
};

/// Takes the portions of a mesh one by one. What it throws ends the work that makes them.
using MeshSink = std::function<void(const MeshPortion& portion)>;

/// A whole mesh as one portion.
[[nodiscard]] inline MeshPortion portion_of(const Mesh& mesh) {
  return {mesh.positions, mesh.normals, mesh.edge_ids, mesh.scalars, mesh.triangles};
}

}  // namespace difmesh
