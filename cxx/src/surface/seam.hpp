#pragma once
// Joins the meshes of parts that follow each other in z.

#include <cstdint>
#include <vector>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/mesh_portion.hpp"

namespace difmesh::detail {

/// Hands the vertices and triangles of a mesh on as soon as their numbers are final.
///
/// A part and the next one share a layer of nodes. The part makes the vertices on edges within the
/// layer, and the next one makes them again, to the same bit, among those on edges that lead up
/// from it; only there do they get their numbers. Until then they wait, with the triangles that end
/// at them and those after: one layer of numbers, since edge ids ascend from layer to layer.
class Seam {
 public:
  /// \param dims of the whole grid \param with_ids whether the sink gets edge ids
  Seam(const Index3& dims, bool with_ids, MeshSink sink);

  /// Takes the mesh of a part, with edge ids.
  /// \param shared_layer of nodes, by the index of their cells in z; beyond all where no part
  ///   follows
  void add(Mesh mesh, std::int64_t shared_layer);

 private:
  void number_waiting(const Mesh& mesh);
  void hand_on(const Mesh& mesh, std::size_t vertices, std::span<const Triangle> triangles) const;

  Index3 dims_;
  bool with_ids_;
  MeshSink sink_;
  std::uint64_t vertices_ = 0;       // handed on
  std::vector<std::uint64_t> ids_;   // of vertices that wait, which would be numbered from there
  std::vector<Triangle> triangles_;  // that wait
};

}  // namespace difmesh::detail
