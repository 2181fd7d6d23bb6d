#pragma once
/// \file cgal_writer.hpp
/// Arrays to the items of CGAL's graphs and back. Internal to cgal.hpp. Of CGAL only headers under
/// the LGPL are included.

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <boost/graph/graph_traits.hpp>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "difmesh/adapters/detail/export_mesh.hpp"
#include "difmesh/adapters/detail/import_plan.hpp"

namespace difmesh::detail {

template <class Graph>
using VertexOf = typename boost::graph_traits<Graph>::vertex_descriptor;
template <class Graph>
using HalfedgeOf = typename boost::graph_traits<Graph>::halfedge_descriptor;
template <class Graph>
using FaceOf = typename boost::graph_traits<Graph>::face_descriptor;

/// CGAL::Surface_mesh, known by what is used of it. Its header is under the GPL and not needed
/// here.
template <class Graph>
concept CgalSurfaceMesh = requires(Graph& mesh, std::uint32_t n, const std::string& name) {
  typename Graph::Point;
  { mesh.number_of_removed_vertices() } -> std::convertible_to<std::size_t>;
  mesh.template add_property_map<typename Graph::Vertex_index, double>(name);
  mesh.template property_map<typename Graph::Vertex_index, double>(name);
  mesh.resize(n, n, n);
  requires std::constructible_from<typename Graph::Vertex_index, std::uint32_t>;
  requires std::constructible_from<typename Graph::Halfedge_index, std::uint32_t>;
  requires std::constructible_from<typename Graph::Face_index, std::uint32_t>;
};

/// The number type of points or vectors.
template <class Vector>
using NumberOf = std::remove_cvref_t<decltype(std::declval<const Vector&>()[0])>;

/// The largest coordinate that stays finite.
template <class Number>
[[nodiscard]] constexpr double largest_of() {
  if constexpr (std::is_floating_point_v<Number> && sizeof(Number) < sizeof(double)) {
    return static_cast<double>(std::numeric_limits<Number>::max());
  } else {
    return std::numeric_limits<double>::max();
  }
}

template <class Vector>
[[nodiscard]] Vector vector_from(const double* v) {
  using Number = NumberOf<Vector>;
  return Vector(static_cast<Number>(v[0]), static_cast<Number>(v[1]), static_cast<Number>(v[2]));
}

template <class Vector>
[[nodiscard]] std::array<double, 3> numbers_of(const Vector& v) {
  return {CGAL::to_double(v[0]), CGAL::to_double(v[1]), CGAL::to_double(v[2])};
}

/// New items of a Surface_mesh: the next indices, all made at once.
template <class SurfaceMesh>
class IndexedItems {
 public:
  IndexedItems(SurfaceMesh& mesh, const Corners& corners, const Halfedges& halfedges)
      : first_vertex_(mesh.number_of_vertices() + mesh.number_of_removed_vertices()),
        first_halfedge_(mesh.number_of_halfedges() + mesh.number_of_removed_halfedges()),
        first_face_(mesh.number_of_faces() + mesh.number_of_removed_faces()) {
    mesh.resize(first_vertex_ + corners.vertices, first_halfedge_ / 2 + halfedges.edges,
                first_face_ + corners.count / 3);
  }
  [[nodiscard]] auto vertex(std::uint32_t v) const {
    return VertexOf<SurfaceMesh>(first_vertex_ + v);
  }
  [[nodiscard]] auto halfedge(std::uint32_t h) const {
    return HalfedgeOf<SurfaceMesh>(first_halfedge_ + h);
  }
  [[nodiscard]] auto face(std::uint32_t f) const { return FaceOf<SurfaceMesh>(first_face_ + f); }

 private:
  std::uint32_t first_vertex_;
  std::uint32_t first_halfedge_;
  std::uint32_t first_face_;
};

/// Outside of the class below, whose own halfedge() would hide that of the graph.
template <class Graph>
[[nodiscard]] HalfedgeOf<Graph> new_edge(Graph& graph) {
  return halfedge(add_edge(graph), graph);
}

/// New items of any MutableFaceGraph, which can only be asked for them one by one.
template <class Graph>
class GraphItems {
 public:
  GraphItems(Graph& graph, const Corners& corners, const Halfedges& halfedges) : graph_(graph) {
    if constexpr (requires { reserve(graph, 1U, 1U, 1U); }) {
      reserve(graph, num_vertices(graph) + corners.vertices, num_edges(graph) + halfedges.edges,
              num_faces(graph) + corners.count / 3);
    }
    vertices_.reserve(corners.vertices);
    for (std::uint32_t v = 0; v < corners.vertices; ++v) {
      vertices_.push_back(add_vertex(graph));
    }
    // Where every item is an allocation of its own, those of a face had better lie together.
    edges_.reserve(halfedges.edges);
    faces_.reserve(corners.count / 3);
    for (std::uint32_t c = 0; c < corners.count; ++c) {
      if (halfedges.of_corner[c] / 2 == edges_.size()) {
        edges_.push_back(new_edge(graph));
      }
      if (c % 3 == 2) {
        faces_.push_back(add_face(graph));
      }
    }
  }
  [[nodiscard]] auto vertex(std::uint32_t v) const { return vertices_[v]; }
  [[nodiscard]] auto halfedge(std::uint32_t h) const {
    return h % 2 == 0 ? edges_[h / 2] : opposite(edges_[h / 2], graph_);
  }
  [[nodiscard]] auto face(std::uint32_t f) const { return faces_[f]; }

 private:
  Graph& graph_;
  std::vector<VertexOf<Graph>> vertices_;
  std::vector<HalfedgeOf<Graph>> edges_;
  std::vector<FaceOf<Graph>> faces_;
};

template <class Graph, class Items>
void write_halfedges(Graph& graph, const Items& items, const ImportPlan& plan) {
  const Halfedges& halfedges = plan.halfedges;
  for (std::uint32_t v = 0; v < plan.corners.vertices; ++v) {
    if (halfedges.leaving[v] != kNone) {
      set_halfedge(items.vertex(v), items.halfedge(halfedges.leaving[v] ^ 1U), graph);
    }
  }
  for (std::uint32_t c = 0; c < plan.corners.count; c += 3) {
    const auto face = items.face(c / 3);
    const std::array<HalfedgeOf<Graph>, 3> around{items.halfedge(halfedges.of_corner[c]),
                                                  items.halfedge(halfedges.of_corner[c + 1]),
                                                  items.halfedge(halfedges.of_corner[c + 2])};
    for (std::uint32_t i = 0; i < 3; ++i) {
      set_target(around[i], items.vertex(plan.corners.to(c + i)), graph);
      set_next(around[i], around[(i + 1) % 3], graph);
      set_face(around[i], face, graph);
    }
    set_halfedge(face, around[2], graph);
  }
  for (const std::uint32_t c : halfedges.border) {
    const std::uint32_t to = plan.corners.from(c);
    const auto border = items.halfedge(halfedges.of_corner[c] ^ 1U);
    set_target(border, items.vertex(to), graph);
    set_next(border, items.halfedge(halfedges.leaving[to]), graph);
    set_face(border, boost::graph_traits<Graph>::null_face(), graph);
    set_halfedge(items.vertex(to), border, graph);
  }
  // CGAL's vertices refer to the border halfedge that ends in them; OpenMesh's, behind its
  // functions for CGAL, to that which starts there.
  if constexpr (requires { adjust_border_halfedge(items.vertex(0), graph); }) {
    for (const std::uint32_t c : halfedges.border) {
      adjust_border_halfedge(items.vertex(plan.corners.from(c)), graph);
    }
  }
}

template <class SurfaceMesh, class Items>
void write_properties(SurfaceMesh& mesh, const Items& items, const MeshView& view,
                      const ImportOptions& options) {
  using Index = typename SurfaceMesh::Vertex_index;
  const auto write = [&](const std::string& name, const auto& value_of) {
    using Value = std::remove_cvref_t<decltype(value_of(0))>;
    auto map = mesh.template add_property_map<Index, Value>(name).first;
    for (std::uint32_t v = 0; v < view.vertices; ++v) {
      map[items.vertex(v)] = value_of(v);
    }
  };
  if (options.normals && view.normals) {
    using Normal = typename CGAL::Kernel_traits<typename SurfaceMesh::Point>::Kernel::Vector_3;
    write("v:normal", [&](std::size_t v) { return vector_from<Normal>(view.normals + 3 * v); });
  }
  if (options.edge_ids && view.edge_ids) {
    write("v:edge_id", [&](std::size_t v) { return view.edge_ids[v]; });
  }
  for (std::size_t n = 0; options.scalars && n < view.scalars.size(); ++n) {
    const ScalarView& scalar = view.scalars[n];
    write("v:" + scalar.name, [&](std::size_t v) { return scalar.values[v]; });
  }
}

/// Normals, edge ids and scalars of a Surface_mesh, where it has them.
template <class SurfaceMesh>
void read_properties(const SurfaceMesh& mesh, MeshBuilder& builder) {
  using Index = typename SurfaceMesh::Vertex_index;
  using Normal = typename CGAL::Kernel_traits<typename SurfaceMesh::Point>::Kernel::Vector_3;
  const auto [normals, with_normals] = mesh.template property_map<Index, Normal>("v:normal");
  const auto [ids, with_ids] = mesh.template property_map<Index, std::uint64_t>("v:edge_id");
  for (const Index v : vertices(mesh)) {
    if (with_normals) {
      builder.add_normal(numbers_of(normals[v]));
    }
    if (with_ids) {
      builder.add_edge_id(ids[v]);
    }
  }
  for (const std::string& name : mesh.template properties<Index>()) {
    const auto [values, is_scalar] = mesh.template property_map<Index, double>(name);
    if (is_scalar && name.starts_with("v:")) {
      Array<double>& scalar = builder.add_scalar(name.substr(2));
      for (const Index v : vertices(mesh)) {
        scalar.push_back(values[v]);
      }
    }
  }
}

template <class Graph>
[[nodiscard]] Mesh read_graph(const Graph& graph) {
  MeshBuilder builder;
  const auto points = get(CGAL::vertex_point, graph);
  std::unordered_map<VertexOf<Graph>, std::uint32_t> number;
  std::vector<std::uint32_t> number_by_index;  // for Surface_mesh
  for (const auto vertex : vertices(graph)) {
    const std::uint32_t n = builder.add_position(numbers_of(get(points, vertex)));
    if constexpr (CgalSurfaceMesh<Graph>) {
      number_by_index.resize(std::size_t{vertex} + 1, kNone);
      number_by_index[vertex] = n;
    } else {
      number.emplace(vertex, n);
    }
  }
  if constexpr (CgalSurfaceMesh<Graph>) {
    read_properties(graph, builder);
  }
  for (const auto face : faces(graph)) {
    builder.start_face();
    const auto first = halfedge(face, graph);
    auto h = first;
    do {
      const auto vertex = target(h, graph);
      if constexpr (CgalSurfaceMesh<Graph>) {
        builder.add_corner(number_by_index[vertex]);
      } else {
        builder.add_corner(number.at(vertex));
      }
      h = next(h, graph);
    } while (h != first);
  }
  return std::move(builder).finish();
}

}  // namespace difmesh::detail
