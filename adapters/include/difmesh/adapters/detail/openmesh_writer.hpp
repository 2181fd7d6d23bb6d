#pragma once
/// \file openmesh_writer.hpp
/// Arrays to OpenMesh's items and back. Internal to openmesh.hpp.

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Utils/Property.hh>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "difmesh/adapters/detail/export_mesh.hpp"
#include "difmesh/adapters/detail/import_plan.hpp"

namespace difmesh::detail {

/// Makes room in a mesh for a plan and fills it. The functions are to be called in their order.
template <class OMesh>
class OpenMeshWriter {
 public:
  OpenMeshWriter(OMesh& mesh, const MeshView& view, const ImportPlan& plan)
      : mesh_(mesh),
        view_(view),
        plan_(plan),
        first_vertex_(static_cast<int>(mesh.n_vertices())),
        first_halfedge_(static_cast<int>(mesh.n_halfedges())),
        first_face_(static_cast<int>(mesh.n_faces())) {
    mesh.resize(mesh.n_vertices() + plan.corners.vertices, mesh.n_edges() + plan.halfedges.edges,
                mesh.n_faces() + plan.corners.count / 3);
  }

  void write_points() const {
    write_vectors<typename OMesh::Point>(
        mesh_.property(mesh_.points_property_handle()).data_vector(), view_.positions);
  }

  void write_halfedges() const {
    const Halfedges& halfedges = plan_.halfedges;
    for (std::uint32_t v = 0; v < plan_.corners.vertices; ++v) {
      if (halfedges.leaving[v] != kNone) {
        mesh_.set_halfedge_handle(vertex(v), halfedge(halfedges.leaving[v]));
      }
    }
    for (std::uint32_t c = 0; c < plan_.corners.count; c += 3) {
      const OpenMesh::FaceHandle face(first_face_ + static_cast<int>(c / 3));
      const std::array<OpenMesh::HalfedgeHandle, 3> around{halfedge(halfedges.of_corner[c]),
                                                           halfedge(halfedges.of_corner[c + 1]),
                                                           halfedge(halfedges.of_corner[c + 2])};
      for (std::uint32_t i = 0; i < 3; ++i) {
        mesh_.set_vertex_handle(around[i], vertex(plan_.corners.to(c + i)));
        mesh_.set_next_halfedge_handle(around[i], around[(i + 1) % 3]);
        mesh_.set_face_handle(around[i], face);
      }
      mesh_.set_halfedge_handle(face, around[2]);
    }
    for (const std::uint32_t c : halfedges.border) {
      const std::uint32_t to = plan_.corners.from(c);
      const OpenMesh::HalfedgeHandle border = halfedge(halfedges.of_corner[c] ^ 1U);
      mesh_.set_vertex_handle(border, vertex(to));
      mesh_.set_next_halfedge_handle(border, halfedge(halfedges.leaving[to]));
    }
  }

  void write_attributes(const ImportOptions& options) const {
    if (options.normals && view_.normals) {
      if (!mesh_.has_vertex_normals()) {
        mesh_.request_vertex_normals();
      }
      write_vectors<typename OMesh::Normal>(
          mesh_.property(mesh_.vertex_normals_pph()).data_vector(), view_.normals);
    }
    if (options.edge_ids && view_.edge_ids) {
      write_property("v:edge_id", view_.edge_ids);
    }
    for (std::size_t n = 0; options.scalars && n < view_.scalars.size(); ++n) {
      write_property("v:" + view_.scalars[n].name, view_.scalars[n].values.data());
    }
  }

 private:
  [[nodiscard]] OpenMesh::VertexHandle vertex(std::uint32_t v) const {
    return OpenMesh::VertexHandle(first_vertex_ + static_cast<int>(v));
  }
  [[nodiscard]] OpenMesh::HalfedgeHandle halfedge(std::uint32_t h) const {
    return OpenMesh::HalfedgeHandle(first_halfedge_ + static_cast<int>(h));
  }

  template <class Vector>
  void write_vectors(std::vector<Vector>& to, const double* from) const {
    using Scalar = std::remove_cvref_t<decltype(to.front()[0])>;
    auto place = to.begin() + first_vertex_;
    for (std::size_t v = 0; v < plan_.corners.vertices; ++v, ++place) {
      const double* p = from + 3 * v;
      *place =
          Vector(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2]));
    }
  }

  template <class T>
  void write_property(const std::string& name, const T* values) const {
    OpenMesh::VPropHandleT<T> handle;
    if (!mesh_.get_property_handle(handle, name)) {
      mesh_.add_property(handle, name);
    }
    std::copy_n(values, plan_.corners.vertices,
                mesh_.property(handle).data_vector().begin() + first_vertex_);
  }

  OMesh& mesh_;
  const MeshView& view_;
  const ImportPlan& plan_;
  int first_vertex_;
  int first_halfedge_;
  int first_face_;
};

template <class OMesh>
void read_scalars(const OMesh& mesh, MeshBuilder& builder) {
  for (auto property = mesh.vprops_begin(); property != mesh.vprops_end(); ++property) {
    OpenMesh::VPropHandleT<double> handle;
    if (*property == nullptr || !(*property)->name().starts_with("v:") ||
        !mesh.get_property_handle(handle, (*property)->name())) {
      continue;
    }
    Array<double>& scalar = builder.add_scalar((*property)->name().substr(2));
    for (const auto vertex : mesh.all_vertices()) {
      if (!mesh.has_vertex_status() || !mesh.status(vertex).deleted()) {
        scalar.push_back(mesh.property(handle, vertex));
      }
    }
  }
}

template <class OMesh>
[[nodiscard]] Mesh read_openmesh(const OMesh& mesh) {
  MeshBuilder builder;
  std::vector<std::uint32_t> number(mesh.n_vertices(), kNone);
  OpenMesh::VPropHandleT<std::uint64_t> ids;
  const bool with_ids = mesh.get_property_handle(ids, "v:edge_id");
  for (const auto vertex : mesh.all_vertices()) {
    if (mesh.has_vertex_status() && mesh.status(vertex).deleted()) {
      continue;
    }
    number[static_cast<std::size_t>(vertex.idx())] = builder.add_position(mesh.point(vertex));
    if (mesh.has_vertex_normals()) {
      builder.add_normal(mesh.normal(vertex));
    }
    if (with_ids) {
      builder.add_edge_id(mesh.property(ids, vertex));
    }
  }
  read_scalars(mesh, builder);
  for (const auto face : mesh.all_faces()) {
    if (mesh.has_face_status() && mesh.status(face).deleted()) {
      continue;
    }
    builder.start_face();
    const OpenMesh::HalfedgeHandle first = mesh.halfedge_handle(face);
    OpenMesh::HalfedgeHandle h = first;
    do {
      builder.add_corner(number[static_cast<std::size_t>(mesh.to_vertex_handle(h).idx())]);
      h = mesh.next_halfedge_handle(h);
    } while (h != first);
  }
  return std::move(builder).finish();
}

}  // namespace difmesh::detail
