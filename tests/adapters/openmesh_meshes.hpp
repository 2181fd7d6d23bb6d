#pragma once
/// \file openmesh_meshes.hpp
/// Kinds of OpenMesh meshes, its own way to build them, and its judge.

#include <doctest/doctest.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Utils/MeshCheckerT.hh>
#include <sstream>
#include <string>
#include <vector>

#include "difmesh/mesh.hpp"

namespace difmesh::test {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
/// Normals from the start, and of another type than points; elements that can be deleted.
struct MixedTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3f;
  VertexAttributes(OpenMesh::Attributes::Normal | OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  VertexTraits { int mark = 7; };
};
using DoubleTriangles = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using FloatTriangles = OpenMesh::TriMesh_ArrayKernelT<>;
using DoublePolygons = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using FloatPolygons = OpenMesh::PolyMesh_ArrayKernelT<>;
using MixedTriangles = OpenMesh::TriMesh_ArrayKernelT<MixedTraits>;

/// By add_vertex() and add_face(), all of whose faces must be accepted.
template <class OMesh>
OMesh built_by_openmesh(const Mesh& mesh) {
  using Point = typename OMesh::Point;
  using Scalar = typename OMesh::Scalar;
  OMesh other;
  std::vector<OpenMesh::VertexHandle> vertices;
  for (const Vec3& p : mesh.positions) {
    vertices.push_back(other.add_vertex(
        Point(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2]))));
  }
  for (const Triangle& t : mesh.triangles) {
    REQUIRE(other.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]).is_valid());
  }
  return other;
}

/// What OpenMesh's MeshChecker and is_manifold() find wrong, or nothing.
template <class OMesh>
std::string judged_by_openmesh(const OMesh& mesh) {
  std::ostringstream said;
  if (!OpenMesh::Utils::MeshCheckerT<OMesh>(mesh).check(
          OpenMesh::Utils::MeshCheckerT<OMesh>::CHECK_ALL, said) &&
      said.str().empty()) {
    return "MeshChecker gives no reason";
  }
  for (const auto vertex : mesh.vertices()) {
    if (!mesh.is_isolated(vertex) && !mesh.is_manifold(vertex)) {
      said << "vertex " << vertex.idx() << " is not manifold\n";
    }
  }
  return said.str();
}

/// Whether two meshes have the same halfedges under the same numbers. The halfedge that a vertex
/// inside the surface refers to may be any that leaves it; at the border it must be the border's.
template <class A, class B>
bool same_halfedges(const A& a, const B& b) {
  if (a.n_vertices() != b.n_vertices() || a.n_edges() != b.n_edges() ||
      a.n_faces() != b.n_faces()) {
    return false;
  }
  bool same = true;
  for (const auto h : a.halfedges()) {
    const OpenMesh::HalfedgeHandle other(h.idx());
    same = same && a.to_vertex_handle(h) == b.to_vertex_handle(other) &&
           a.next_halfedge_handle(h) == b.next_halfedge_handle(other) &&
           a.prev_halfedge_handle(h) == b.prev_halfedge_handle(other) &&
           a.face_handle(h) == b.face_handle(other);
  }
  for (const auto f : a.faces()) {
    same = same && a.halfedge_handle(f) == b.halfedge_handle(OpenMesh::FaceHandle(f.idx()));
  }
  for (const auto v : a.vertices()) {
    const OpenMesh::HalfedgeHandle ours = a.halfedge_handle(v);
    const OpenMesh::HalfedgeHandle theirs = b.halfedge_handle(OpenMesh::VertexHandle(v.idx()));
    same = same && ours.is_valid() == theirs.is_valid();
    if (same && ours.is_valid()) {
      same = b.is_boundary(theirs) ? ours == theirs : a.from_vertex_handle(ours).idx() == v.idx();
    }
  }
  return same;
}

}  // namespace difmesh::test
