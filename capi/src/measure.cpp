#include "difmesh/measure.hpp"

#include <algorithm>

#include "boundary.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

dif_status dif_measure_init(dif_measure* measure, uint64_t struct_size) {
  return capi::guarded([&] { capi::write_struct(measure, struct_size, dif_measure{}, "measure"); });
}

dif_status dif_mesh_measure(const dif_mesh* mesh, dif_measure* measure) {
  return capi::guarded([&] {
    capi::check_output(measure, "measure");
    const difmesh::Measure facts = difmesh::measure(capi::required(mesh, "mesh").mesh);
    dif_measure result{};
    result.vertices = facts.vertices;
    result.edges = facts.edges;
    result.triangles = facts.triangles;
    result.components = facts.components;
    result.isolated_vertices = facts.isolated_vertices;
    result.boundary_edges = facts.boundary_edges;
    result.non_manifold_edges = facts.non_manifold_edges;
    result.misoriented_edges = facts.misoriented_edges;
    result.non_manifold_vertices = facts.non_manifold_vertices;
    result.degenerate_triangles = facts.degenerate_triangles;
    result.euler_number = facts.euler_number;
    result.closed = facts.closed ? 1 : 0;
    result.manifold = facts.manifold ? 1 : 0;
    result.area = facts.area;
    result.volume = facts.volume;
    std::copy(facts.low.begin(), facts.low.end(), result.low);
    std::copy(facts.high.begin(), facts.high.end(), result.high);
    result.unbalanced_edges = facts.unbalanced_edges;
    result.has_volume = facts.has_volume ? 1 : 0;
    capi::write_output(measure, result, "measure");
  });
}
