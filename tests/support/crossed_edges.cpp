#include "support/crossed_edges.hpp"

#include <array>
#include <cstddef>

#include "difmesh/cell_planes.hpp"
#include "support/dual_edges.hpp"

namespace difmesh::test {
namespace {

Plane plane_on(const CrossedEdge& edge, const CellPlane& cell, double fraction) {
  if (cell.source != NormalSource::none) {
    return cell.plane;
  }
  const auto axis = static_cast<std::size_t>(edge.axis);
  Plane plane;
  plane.normal[axis] = -edge.direction;
  plane.offset = (fraction - 0.5) * edge.spacing[axis];
  return plane;
}

CrossedEdge crossed_edge(std::size_t axis, const Vec3& spacing, const std::array<double, 2>& ends,
                         std::span<const CellPlane> planes) {
  const std::size_t outer = ends[0] < ends[1] ? 0 : 1;
  CrossedEdge edge;
  edge.spacing = spacing;
  edge.axis = static_cast<int>(axis);
  edge.direction = outer == 0 ? 1.0 : -1.0;
  edge.outer_fraction = ends[outer];
  edge.inner_fraction = ends[1 - outer];
  edge.outer_plane = plane_on(edge, planes[outer], edge.outer_fraction);
  edge.inner_plane = plane_on(edge, planes[1 - outer], edge.inner_fraction);
  return edge;
}

}  // namespace

std::vector<CrossedEdge> crossed_edges(std::span<const double> fractions, const Grid& grid,
                                       const Options& options,
                                       std::span<const std::uint64_t> edge_ids) {
  std::vector<Index3> cells;
  cells.reserve(2 * edge_ids.size());
  for (const std::uint64_t id : edge_ids) {
    const DualEdge dual = dual_edge(id, grid.dims);
    cells.push_back(dual.node);
    cells.push_back(dual.upper());
  }
  std::vector<CellPlane> planes(cells.size());
  cell_planes(FieldView::x_fastest(fractions.data(), grid.dims), grid, cells, options, planes);
  std::vector<CrossedEdge> edges;
  edges.reserve(edge_ids.size());
  for (std::size_t e = 0; e < edge_ids.size(); ++e) {
    const std::array<double, 2> ends{fractions[element(cells[2 * e], grid.dims)],
                                     fractions[element(cells[2 * e + 1], grid.dims)]};
    edges.push_back(crossed_edge(static_cast<std::size_t>(edge_ids[e] % 3), grid.spacing, ends,
                                 std::span(planes).subspan(2 * e, 2)));
  }
  return edges;
}

double share_along(const CrossedEdge& edge, std::uint64_t edge_id, const Grid& grid,
                   const Vec3& position) {
  const DualEdge dual = dual_edge(edge_id, grid.dims);
  const Vec3 outer = grid.cell_centre(edge.direction > 0.0 ? dual.node : dual.upper());
  return edge.direction * (position[dual.axis] - outer[dual.axis]) / grid.spacing[dual.axis];
}

}  // namespace difmesh::test
