#include "difmesh/reconstruct.hpp"

#include <limits>
#include <string>

#include "block_field.hpp"
#include "classify.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "dual_grid.hpp"
#include "parallel.hpp"
#include "plane_table.hpp"
#include "stopwatch.hpp"
#include "triangles.hpp"
#include "vertices.hpp"

namespace difmesh {
namespace {

using detail::BlockField;
using detail::DualGrid;
using detail::Phases;
using detail::Stopwatch;

// Half-way up the block.
double middle_level(const BlockField& field) {
  return field.grid.origin[2] +
         field.grid.spacing[2] * (static_cast<double>(field.block.offset[2]) +
                                  0.5 * static_cast<double>(field.block.dims[2]));
}

Reconstruction run(const BlockField& field, const Options& options) {
  Reconstruction result;
  Report& report = result.report;
  Mesh& mesh = result.mesh;
  Stopwatch whole;
  Stopwatch watch;
  detail::Workers workers(options.threads);
  Phases phases(workers, options.progress);

  detail::ClassifiedNodes classified =
      detail::classify(field, options.overshoot_bound, 0.1, phases, report);
  DualGrid grid(field, std::move(classified.nodes));
  report.seconds.classify = watch.lap();

  const bool with_planes = options.placement == Placement::plic;
  if (with_planes || options.vertex_normals) {
    grid.set_planes(
        detail::make_planes(field, grid.nodes(), classified.row_ends, options, phases, report),
        with_planes);
  }
  report.seconds.normals = watch.lap();

  const detail::MeshCounts counts = detail::count_mesh(grid, phases);
  const std::int64_t vertices = counts.vertex_start.back();
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::too_large, "the mesh would have " + std::to_string(vertices) +
                                          " vertices, more than 2^32 - 1; reconstruct blocks");
  }
  report.seconds.count = watch.lap();

  detail::place_vertices(grid, options, counts.vertex_start, phases, mesh, report);
  watch.lap();  // of planes and of vertices, which take turns: they are in the report

  detail::connect(grid, counts, phases, mesh);
  if (report.closed) {
    report.enclosed_volume = detail::enclosed_volume(mesh, middle_level(field), phases);
  }
  report.seconds.triangles = watch.lap();
  report.seconds.total = whole.lap();
  phases.finish();
  return result;
}

}  // namespace

Reconstruction reconstruct(const FieldView& field, const Grid& grid, const Options& options) {
  const DefaultFloatEnvironment environment;
  const Block whole{{0, 0, 0}, grid.dims, {0, 0, 0}, {0, 0, 0}};
  return run(detail::make_block_field(field, whole, grid, options), options);
}

Reconstruction reconstruct_block(const FieldView& field, const Block& block, const Grid& grid,
                                 const Options& options) {
  const DefaultFloatEnvironment environment;
  Options named = options;
  named.edge_ids = true;
  return run(detail::make_block_field(field, block, grid, named), named);
}

}  // namespace difmesh
