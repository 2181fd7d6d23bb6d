#pragma once
/// \file graphs.hpp
/// CGAL's own way to build graphs, and its judges.

#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <doctest/doctest.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <unordered_map>
#include <vector>

#include "difmesh/adapters/detail/cgal_writer.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::test {

/// By CGAL::Euler::add_face(), all of whose faces must be accepted.
template <class Graph>
Graph built_by_cgal(const Mesh& mesh) {
  using PointMap = typename boost::property_map<Graph, CGAL::vertex_point_t>::type;
  using Point = typename boost::property_traits<PointMap>::value_type;
  Graph other;
  std::vector<typename boost::graph_traits<Graph>::vertex_descriptor> all;
  for (const Vec3& p : mesh.positions) {
    all.push_back(add_vertex(other));
    put(get(CGAL::vertex_point, other), all.back(), detail::vector_from<Point>(p.data()));
  }
  for (const Triangle& t : mesh.triangles) {
    const std::vector corners{all[t[0]], all[t[1]], all[t[2]]};
    REQUIRE(CGAL::Euler::add_face(corners, other) != boost::graph_traits<Graph>::null_face());
  }
  return other;
}

/// What CGAL finds wrong, or nothing. Vertices without faces, which no valid polygon mesh of CGAL
/// has, are taken away first.
template <class Graph>
std::string judged_by_cgal(Graph graph) {
  using Traits = boost::graph_traits<Graph>;
  std::vector<typename Traits::vertex_descriptor> alone;
  for (const auto v : vertices(graph)) {
    if (halfedge(v, graph) == Traits::null_halfedge()) {
      alone.push_back(v);
    }
  }
  for (const auto v : alone) {
    remove_vertex(v, graph);
  }
  if (!CGAL::is_valid_polygon_mesh(graph)) {
    return "no valid polygon mesh";
  }
  std::vector<typename boost::graph_traits<Graph>::halfedge_descriptor> tips;
  CGAL::Polygon_mesh_processing::non_manifold_vertices(graph, std::back_inserter(tips));
  return tips.empty() ? "" : std::to_string(tips.size()) + " vertices that are not manifold";
}

/// The structure of a graph in numbers: of each halfedge its opposite, next and previous one,
/// vertex and face; of each face its halfedge; of each vertex its halfedge if that is at the
/// border, else whether it has one that ends there.
template <class Graph>
std::vector<std::size_t> structure(const Graph& graph) {
  using Traits = boost::graph_traits<Graph>;
  std::unordered_map<typename Traits::vertex_descriptor, std::size_t> vertex_number;
  std::unordered_map<typename Traits::halfedge_descriptor, std::size_t> halfedge_number;
  std::unordered_map<typename Traits::face_descriptor, std::size_t> face_number;
  for (const auto v : vertices(graph)) {
    vertex_number.emplace(v, vertex_number.size());
  }
  for (const auto h : halfedges(graph)) {
    halfedge_number.emplace(h, halfedge_number.size());
  }
  for (const auto f : faces(graph)) {
    face_number.emplace(f, face_number.size());
  }
  constexpr std::size_t kBorder = 1000000001;
  std::vector<std::size_t> numbers;
  for (const auto h : halfedges(graph)) {
    const auto f = face(h, graph);
    numbers.insert(numbers.end(),
                   {halfedge_number.at(opposite(h, graph)), halfedge_number.at(next(h, graph)),
                    halfedge_number.at(prev(h, graph)), vertex_number.at(target(h, graph)),
                    f == Traits::null_face() ? kBorder : face_number.at(f)});
  }
  for (const auto f : faces(graph)) {
    numbers.push_back(halfedge_number.at(halfedge(f, graph)));
  }
  for (const auto v : vertices(graph)) {
    const auto h = halfedge(v, graph);
    if (h == Traits::null_halfedge()) {
      numbers.push_back(kBorder + 1);
    } else {
      const bool at_border = is_border(h, graph) || is_border(opposite(h, graph), graph);
      numbers.push_back(at_border ? halfedge_number.at(h)
                                  : kBorder + 2 + vertex_number.at(target(h, graph)));
    }
  }
  return numbers;
}

}  // namespace difmesh::test
