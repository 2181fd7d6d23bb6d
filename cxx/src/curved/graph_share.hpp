#pragma once
// The share of a cell below a graph.

#include "curved/plane_polynomial.hpp"
#include "curved/plane_section.hpp"

namespace difmesh::detail {

/// A graph over a plane, by total degree.
template <int kDegree>
struct PlaneGraph {
  std::array<Vec3, 3> frame{};  ///< as in Graph
  PlanePolynomial<kDegree> polynomial;
};

/// A box by its centre and edges.
struct Box {
  Vec3 centre;
  Vec3 size;
};

/// Share of a box below a graph, and its derivatives by the graph's coefficients; pure where the
/// plane that touches the graph over the box's centre does not meet it.
template <int kDegree>
struct GraphShare {
  double share = 0.0;
  typename PlanePolynomial<kDegree>::Terms slopes{};
  bool is_pure = false;
};

/// The share of the tangent plane, and the volume between it and the graph: over the section of
/// the plane, less what the sides cut off, to second order in the distance of the two. Exact for
/// planes.
/// For degree 2, with `grazes`, the two faces that the plane is nearly parallel to cut the graph
/// itself where that matters.
template <int kDegree>
[[nodiscard]] GraphShare<kDegree> share_below(const PlaneGraph<kDegree>& graph, const Box& box,
                                              bool grazes);

}  // namespace difmesh::detail
