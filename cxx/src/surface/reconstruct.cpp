#include "difmesh/reconstruct.hpp"

#include <limits>
#include <new>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "cells/classify.hpp"
#include "cells/memory_plan.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/out_of_memory.hpp"
#include "difmesh/values.hpp"
#include "grid/block_field.hpp"
#include "placement/placement.hpp"
#include "surface/dual_grid.hpp"
#include "surface/phase.hpp"
#include "surface/plane_table.hpp"
#include "surface/triangles.hpp"
#include "surface/vertices.hpp"

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

// \param now what is about to be made
Reconstruction run_phases(const BlockField& field, const Options& options, const char*& now) {
  Reconstruction result;
  Report& report = result.report;
  Mesh& mesh = result.mesh;
  Stopwatch whole;
  Stopwatch watch;
  detail::Workers workers(options.threads);
  Phases phases(workers, options.progress);

  const bool with_planes = detail::placement_part(options.placement).by_planes;
  detail::LayerPlanes layer_planes(field, with_planes);
  now = detail::kInsideBits.makes;
  detail::ClassifiedNodes classified = detail::classify(
      field, {options.overshoot_bound, layer_planes}, detail::kInsideBits.weight, phases, report);
  DualGrid grid(field, std::move(classified.nodes));
  report.seconds.classify = watch.lap();

  now = detail::kPlanes.makes;
  if (with_planes || options.vertex_normals) {
    grid.set_planes(
        detail::make_planes(field, grid.nodes(), classified.row_ends, options, phases, report),
        with_planes);
  }
  report.seconds.normals = watch.lap();

  now = detail::kCounts.makes;
  const detail::MeshCounts counts = detail::count_mesh(grid, phases);
  const std::int64_t vertices = counts.vertex_start.back();
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::too_large, "the mesh would have " + std::to_string(vertices) +
                                          " vertices, more than 2^32 - 1; reconstruct blocks");
  }
  report.seconds.count = watch.lap();

  now = detail::kVertices.makes;
  detail::place_vertices(grid, options, counts.vertex_start, phases, mesh, report);
  watch.lap();  // of planes and of vertices, which take turns: they are in the report

  now = detail::kTriangles.makes;
  detail::connect(grid, counts, phases, mesh);
  now = detail::kVolume.makes;
  if (report.closed) {
    report.enclosed_volume = detail::enclosed_volume(mesh, middle_level(field), phases);
  }
  report.seconds.triangles = watch.lap();
  report.seconds.total = whole.lap();
  phases.finish();
  return result;
}

Reconstruction run(const BlockField& field, const Options& options) {
  detail::check_memory(field);
  const char* now = "the work";
  try {
    return run_phases(field, options, now);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::bad_alloc&) {
    detail::fail_memory(field, now);
  }
}

/// A body of some size has more full cells than interfacial ones, which settles it without a pass: no
/// cell that is not full counts for more than 1, nor for anything where it is not interfacial.
bool may_lack_full_cells(const FieldView& field, const Grid& grid, const Options& options,
                         const Report& report) {
  if (field.type != ScalarType::uint8 && field.type != ScalarType::uint16) {
    return false;
  }
  const bool all_seen = options.purity_tolerance * largest_value(value_type_of(field.type)) < 1.0;
  const auto interfacial = static_cast<double>(report.interfacial_cells);
  return !all_seen ||
         (interfacial > 0.0 && report.fraction_volume <= interfacial * grid.cell_volume());
}

}  // namespace

Reconstruction reconstruct(const FieldView& field, const Grid& grid, const Options& options) {
  const DefaultFloatEnvironment environment;
  const Block whole{{0, 0, 0}, grid.dims, {0, 0, 0}, {0, 0, 0}};
  Reconstruction result = run(detail::make_block_field(field, whole, grid, options), options);
  if (may_lack_full_cells(field, grid, options, result.report)) {
    std::string doubt = doubt_of_scale(ValueView(field));
    if (!doubt.empty()) {
      result.report.warnings.push_back(std::move(doubt));
    }
  }
  return result;
}

Reconstruction reconstruct_block(const FieldView& field, const Block& block, const Grid& grid,
                                 const Options& options) {
  const DefaultFloatEnvironment environment;
  Options named = options;
  named.edge_ids = true;
  return run(detail::make_block_field(field, block, grid, named), named);
}

}  // namespace difmesh
