#pragma once
/// \file openmesh.hpp
/// Surfaces into OpenMesh and back, without files: to_openmesh, append_to_openmesh,
/// mesh_from_openmesh. For every TriMesh_ArrayKernelT and PolyMesh_ArrayKernelT of OpenMesh 9, with
/// points of float or double. Header-only; users link OpenMeshCore, and nothing of difmesh. For
/// meshes of libdifmesh see c_mesh.hpp.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "difmesh/adapters/detail/import_plan.hpp"
#include "difmesh/adapters/detail/openmesh_writer.hpp"
#include "difmesh/adapters/mesh_view.hpp"

namespace difmesh {

/// Adds a mesh to one that may hold others. Vertex n of the source becomes vertex (old count) + n,
/// and faces likewise, but for those refused; halfedges and edges are numbered as by add_face() in
/// a loop.
/// - Positions: as they are, or rounded to float where the mesh has float points.
/// - Normals, if the source has them and options.normals: the standard property, which is requested
///   if it was not.
/// - Edge ids: the property "v:edge_id" of std::uint64_t; scalars: "v:" + name, of double. These
///   are made where absent; vertices that were there before keep their values.
/// - Faces that cannot be held are left out and reported; nothing is printed.
///
/// \throw Error invalid_argument (arrays that do not fit); invalid_value for a position that is
///   NaN, infinite or beyond float, with its vertex; too_large beyond 2^31 - 1 vertices or
///   halfedges in all. The mesh is then as it was.
/// Cost: linear, some 70 ns per triangle, a fifth of the time of add_face() in a loop; 14 bytes per
/// triangle on top of the mesh's own memory while it lasts. Soups with faces to refuse take 0.5 to
/// 1 µs per triangle. Thread safety: concurrent calls for different meshes are safe.
template <class OMesh>
ImportReport append_to_openmesh(OMesh& mesh, const MeshView& view,
                                const ImportOptions& options = {}) {
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  const std::size_t used = std::max({mesh.n_vertices(), mesh.n_halfedges(), mesh.n_faces()});
  const detail::Limits limits{
      kMost - used, static_cast<double>(std::numeric_limits<typename OMesh::Scalar>::max())};
  detail::ImportPlan plan = detail::plan_import(view, limits);
  const detail::OpenMeshWriter<OMesh> writer(mesh, view, plan);
  writer.write_points();
  writer.write_halfedges();
  writer.write_attributes(options);
  return std::move(plan.report);
}

/// A new mesh: `auto [mesh, report] = difmesh::to_openmesh<MyMesh>(surface);` OpenMesh's meshes
/// cannot be moved: taking `.mesh` from the result copies it.
/// \throw as append_to_openmesh()
template <class OMesh>
[[nodiscard]] Import<OMesh> to_openmesh(const MeshView& view, const ImportOptions& options = {}) {
  Import<OMesh> result;
  result.report = append_to_openmesh(result.mesh, view, options);
  return result;
}

/// The way back. Vertices and faces keep their order; what is marked as deleted is left out.
/// Polygons become fans about their first corner, which keeps the signed volume of planar ones,
/// convex or not, and so their fractions. For fractions_from_mesh(), measure(), write_mesh(); in C
/// for dif_mesh_from_arrays().
/// - normals: the standard property, where the mesh has it.
/// - edge_ids: the property "v:edge_id", where it is there and ascends over the vertices, as
///   Mesh::edge_ids must.
/// - scalars: all properties of double called "v:" + name.
/// \throw Error too_large for more than 2^32 - 1 vertices
/// Cost: linear. Thread safety: only reads the mesh.
template <class OMesh>
[[nodiscard]] Mesh mesh_from_openmesh(const OMesh& mesh) {
  return detail::read_openmesh(mesh);
}

}  // namespace difmesh
