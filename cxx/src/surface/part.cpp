#include "surface/part.hpp"

#include <limits>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "base/stopwatch.hpp"
#include "cells/memory_plan.hpp"
#include "curved/surface_table.hpp"
#include "difmesh/error.hpp"
#include "difmesh/out_of_memory.hpp"
#include "placement/placement.hpp"
#include "surface/curved_nodes.hpp"
#include "surface/curved_vertices.hpp"
#include "surface/dual_grid.hpp"
#include "surface/phase.hpp"
#include "surface/plane_table.hpp"
#include "surface/triangles.hpp"
#include "surface/vertices.hpp"

namespace difmesh::detail {
namespace {

// \param now what is about to be made
void run_phases(const BlockField& field, const Options& options, const char*& now, PartSums& sums,
                Mesh& mesh) {
  Report& report = sums.facts.report;
  Stopwatch whole;
  Stopwatch watch;
  Workers workers(options.threads);
  const PlacementPart& placement = placement_part(options.placement);
  Phases phases(workers, options.progress, placement.by_surfaces ? kWeightWithSurfaces : 1.0);

  const bool with_planes = placement.by_planes;
  LayerPlanes layer_planes(field, with_planes);
  now = kInsideBits.makes;
  ClassifiedNodes classified = classify(field, {options.overshoot_bound, layer_planes},
                                        kInsideBits.weight, phases, sums.facts);
  report.seconds.classify += watch.lap();

  now = kSurfaces.makes;
  std::optional<SurfaceTable> surfaces;
  if (placement.by_surfaces) {
    surfaces.emplace(field, phases, kSurfaces.weight);
    report.curved_cells += surfaces->own_surfaces();
    report.moved_centres += settle_centres(*surfaces, classified.nodes);
  }
  DualGrid grid(field, std::move(classified.nodes));

  now = kPlanes.makes;
  if (with_planes || options.vertex_normals) {
    grid.set_planes(
        make_planes(field, grid.nodes(), {classified.row_ends, surfaces ? &*surfaces : nullptr},
                    options, phases, report),
        with_planes);
    if (surfaces) {
      settle_faces(*surfaces, grid);
    }
  }
  report.seconds.normals += watch.lap();

  now = kCounts.makes;
  const MeshCounts counts = count_mesh(grid, phases);
  const std::int64_t vertices = counts.vertex_start.back();
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::too_large, "the mesh would have " + std::to_string(vertices) +
                                          " vertices, more than 2^32 - 1; reconstruct blocks");
  }
  report.seconds.count += watch.lap();

  now = kVertices.makes;
  place_vertices(grid, options, counts.vertex_start, phases, mesh, report);
  watch.lap();  // of planes and of vertices, which take turns: they are in the report
  if (surfaces) {
    now = kCurving.makes;
    report.curved_vertices +=
        curve_vertices(*surfaces, grid, options, counts.vertex_start, phases, mesh);
    report.seconds.vertices += watch.lap();
  }

  now = kTriangles.makes;
  connect(grid, counts, phases, mesh);
  now = kVolume.makes;
  if (report.closed) {
    sums.volume.add(mesh, phases);
  }
  report.seconds.triangles += watch.lap();
  report.seconds.total += whole.lap();
  phases.finish();
}

}  // namespace

// Half-way up the grid.
PartSums::PartSums(const Grid& grid)
    : volume(grid.is_uniform(2)
                 ? grid.origin[2] + grid.spacing[2] * (0.5 * static_cast<double>(grid.dims[2]))
                 : 0.5 * (grid.faces[2].front() + grid.faces[2].back())) {}

Report PartSums::finish() {
  facts.report.enclosed_volume = facts.report.closed ? volume.value() : 0.0;
  return std::move(facts.report);
}

Mesh reconstruct_part(const BlockField& field, const Options& options, PartSums& sums) {
  check_memory(field);
  const char* now = "the work";
  Mesh mesh;
  try {
    run_phases(field, options, now, sums, mesh);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail_memory(field, now);
  }
  return mesh;
}

}  // namespace difmesh::detail
