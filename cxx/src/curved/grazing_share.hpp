#pragma once
// The volume between a paraboloid and its tangent plane in a cell whose faces the plane grazes.

#include "curved/graph_share.hpp"
#include "curved/tangent_plane.hpp"

namespace difmesh::detail {

/// Where the plane leans little against the axis that it is most nearly across, two faces of the
/// cell may cut off much of what is between plane and graph, and the square of a small distance by
/// a small slope does not tell it. Integrates what these faces leave of it, slice by slice along
/// the slope, exactly but for the slices' quadrature; the other four sides count to second order.
/// Returns false, without a result, where neither face comes near the graph.
/// \param slopes integrals of the terms over where the graph is between the faces
[[nodiscard]] bool add_grazing_share(const PlaneGraph<2>& graph, const TangentPlane<2>& plane,
                                     const Vec3& size, double& volume,
                                     PlanePolynomial<2>::Terms& slopes);

}  // namespace difmesh::detail
