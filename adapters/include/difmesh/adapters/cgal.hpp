#pragma once
/// \file cgal.hpp
/// Surfaces into CGAL and back, without files: to_cgal, append_to_cgal, mesh_from_cgal. For
/// CGAL::Surface_mesh over any kernel, and any model of MutableFaceGraph whose vertices have
/// points: Polyhedron_3, OpenMesh's meshes through CGAL/boost/graph. Header-only; users link CGAL,
/// and nothing of difmesh. For meshes of libdifmesh see c_mesh.hpp.
///
/// Licences: difmesh is under MIT and includes of CGAL only headers under the LGPL here. CGAL's
/// Surface_mesh, Polyhedron_3 and Polygon_mesh_processing are under the GPL (or a commercial
/// licence of GeometryFactory): a program that includes them and is passed on comes under its
/// terms.
///
/// Include the header of the mesh itself before: <CGAL/Surface_mesh.h>, <CGAL/Polyhedron_3.h> or
/// <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "difmesh/adapters/detail/cgal_writer.hpp"
#include "difmesh/adapters/mesh_view.hpp"

namespace difmesh {

/// Adds a mesh to one that may hold others. Vertices, edges and faces are made in the order of the
/// source, but for faces refused, and numbered as by CGAL::Euler::add_face() in a loop; removed
/// items of a Surface_mesh are not used again.
/// - Points: by the conversion of double to the kernel's number type, exact unless that is float.
///   OpenMesh through CGAL rounds to float by itself unless CGAL_USE_OM_POINTS is defined.
/// - Surface_mesh only: normals, if the source has them and options.normals, as the property map
///   "v:normal" of Vector_3; edge ids "v:edge_id" of std::uint64_t; scalars "v:" + name, of double.
///   These are made where absent; vertices that were there before keep their values. Other graphs
///   have no named properties and get none.
/// - Faces that cannot be held are left out and reported; no assertion of CGAL is met. Vertices
///   without faces stay: CGAL::is_valid_polygon_mesh() objects to them.
///
/// \throw Error invalid_argument (arrays that do not fit); invalid_value for a position that is
///   NaN, infinite or beyond the kernel's float, with its vertex; too_large for more items than
///   Surface_mesh has indices. The mesh is then as it was.
/// Cost: linear. Surface_mesh: some 60 ns per triangle, two fifths of the time of add_face() in a
/// loop, and 14 bytes per triangle on top of the mesh's own memory while it lasts. Polyhedron_3:
/// 0.3 µs and 38 bytes; its own builder takes hardly longer, for most of the time goes into the
/// list nodes that it makes one by one. Soups with faces to refuse take 0.5 to 1 µs per triangle.
/// Thread safety: concurrent calls for different meshes are safe.
template <class PolygonMesh>
ImportReport append_to_cgal(PolygonMesh& mesh, const MeshView& view,
                            const ImportOptions& options = {}) {
  using PointMap = typename boost::property_map<PolygonMesh, CGAL::vertex_point_t>::type;
  using Point = typename boost::property_traits<PointMap>::value_type;
  constexpr bool kIsSurfaceMesh = detail::CgalSurfaceMesh<PolygonMesh>;
  detail::Limits limits{std::numeric_limits<std::uint64_t>::max(),
                        detail::largest_of<detail::NumberOf<Point>>()};
  if constexpr (kIsSurfaceMesh) {
    const std::uint64_t used =
        std::max({std::uint64_t{mesh.number_of_vertices()} + mesh.number_of_removed_vertices(),
                  std::uint64_t{mesh.number_of_halfedges()} + mesh.number_of_removed_halfedges(),
                  std::uint64_t{mesh.number_of_faces()} + mesh.number_of_removed_faces()});
    limits.items = std::numeric_limits<std::uint32_t>::max() - used;
  }
  detail::ImportPlan plan = detail::plan_import(view, limits);
  using Items = std::conditional_t<kIsSurfaceMesh, detail::IndexedItems<PolygonMesh>,
                                   detail::GraphItems<PolygonMesh>>;
  const Items items(mesh, plan.corners, plan.halfedges);
  const auto points = get(CGAL::vertex_point, mesh);
  for (std::uint32_t v = 0; v < plan.corners.vertices; ++v) {
    put(points, items.vertex(v), detail::vector_from<Point>(view.positions + std::size_t{3} * v));
  }
  detail::write_halfedges(mesh, items, plan);
  if constexpr (kIsSurfaceMesh) {
    detail::write_properties(mesh, items, view, options);
  }
  return std::move(plan.report);
}

/// A new mesh: `auto [mesh, report] = difmesh::to_cgal<MyMesh>(surface);` Polyhedron_3 cannot be
/// moved: taking `.mesh` from the result copies it.
/// \throw as append_to_cgal()
template <class PolygonMesh>
[[nodiscard]] Import<PolygonMesh> to_cgal(const MeshView& view, const ImportOptions& options = {}) {
  Import<PolygonMesh> result;
  result.report = append_to_cgal(result.mesh, view, options);
  return result;
}

/// The way back, for any model of FaceListGraph. Vertices and faces keep their order. Polygons
/// become fans about their first corner, which keeps the signed volume of planar ones, convex or
/// not, and so their fractions. For fractions_from_mesh(), measure(), write_mesh(); in C for
/// dif_mesh_from_arrays(). Coordinates are the nearest doubles.
/// - normals and edge_ids: of a Surface_mesh, the property maps named above where they are there;
///   edge ids only if they ascend over the vertices, as Mesh::edge_ids must.
/// - scalars: of a Surface_mesh, all property maps of double called "v:" + name.
/// \throw Error too_large for more than 2^32 - 1 vertices
/// Cost: linear. Thread safety: only reads the mesh.
template <class PolygonMesh>
[[nodiscard]] Mesh mesh_from_cgal(const PolygonMesh& mesh) {
  return detail::read_graph(mesh);
}

}  // namespace difmesh
