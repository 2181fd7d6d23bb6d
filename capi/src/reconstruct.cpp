#include "difmesh/reconstruct.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/weld.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

std::unique_ptr<dif_mesh> to_handle(difmesh::Reconstruction&& result) {
  auto handle = std::make_unique<dif_mesh>();
  handle->warnings = std::move(result.report.warnings);
  handle->mesh = std::move(result.mesh);
  handle->report = std::move(result.report);
  return handle;
}

dif_report to_report(const difmesh::Report& report) {
  dif_report result{};
  result.cells = report.cells;
  result.interfacial_cells = report.interfacial_cells;
  result.clamped_cells = report.clamped_cells;
  result.largest_overshoot = report.largest_overshoot;
  result.fraction_volume = report.fraction_volume;
  result.planes = report.planes;
  result.height_function_cells = report.height_function_cells;
  result.gradient_free_cells = report.gradient_free_cells;
  result.solved_edges = report.solved_edges;
  result.newton_steps_mean = report.newton_steps_mean;
  result.newton_steps_max = report.newton_steps_max;
  result.non_monotone_edges = report.non_monotone_edges;
  result.enclosed_volume = report.enclosed_volume;
  result.closed = report.closed ? 1 : 0;
  result.seconds_classify = report.seconds.classify;
  result.seconds_normals = report.seconds.normals;
  result.seconds_count = report.seconds.count;
  result.seconds_vertices = report.seconds.vertices;
  result.seconds_triangles = report.seconds.triangles;
  result.seconds_total = report.seconds.total;
  result.curved_cells = report.curved_cells;
  result.curved_vertices = report.curved_vertices;
  result.moved_centres = report.moved_centres;
  return result;
}

difmesh::Block to_block(const dif_block* block) {
  capi::required(block, "block");
  const dif_block given = capi::read_struct(block, dif_block{}, "block");
  return {capi::to_index(given.offset), capi::to_index(given.dims), capi::to_index(given.ghost_low),
          capi::to_index(given.ghost_high)};
}

}  // namespace

dif_status dif_field_init(dif_field* field, uint64_t struct_size, const void* data, int32_t type,
                          const int64_t dims[3]) {
  return capi::guarded([&] {
    capi::required(field, "field");
    capi::required(dims, "dims");
    const difmesh::Grid grid{.dims = {dims[0], dims[1], dims[2]}};
    validate(grid);
    dif_field value{};
    value.data = &capi::required(static_cast<const char*>(data), "data");
    value.type = capi::from_value_type(capi::to_value_type(type));
    const difmesh::Index3 strides{1, dims[0], dims[0] * dims[1]};
    std::copy_n(dims, 3, value.dims);
    std::copy_n(strides.begin(), 3, value.strides);
    std::fill_n(value.spacing, 3, 1.0);
    capi::write_struct(field, struct_size, value, "field");
  });
}

dif_status dif_options_init(dif_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    const difmesh::Options defaults;
    dif_options value{};
    value.purity_tolerance = defaults.purity_tolerance;
    value.overshoot_bound = defaults.overshoot_bound;
    value.clearance = defaults.clearance;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_report_init(dif_report* report, uint64_t struct_size) {
  return capi::guarded([&] { capi::write_struct(report, struct_size, dif_report{}, "report"); });
}

dif_status dif_block_init(dif_block* block, uint64_t struct_size) {
  return capi::guarded([&] { capi::write_struct(block, struct_size, dif_block{}, "block"); });
}

dif_status dif_reconstruct(const dif_field* field, const dif_options* options, dif_mesh** mesh) {
  return capi::guarded([&] {
    dif_mesh*& handle = capi::out_handle(mesh, "mesh");
    const auto [view, grid] = capi::to_field(field);
    handle = to_handle(reconstruct(view, grid, capi::to_options(options))).release();
  });
}

dif_status dif_mesh_report(const dif_mesh* mesh, dif_report* report) {
  return capi::guarded([&] {
    if (!capi::required(mesh, "mesh").report) {
      capi::fail_argument("the mesh was not made by a reconstruction and has no report");
    }
    capi::write_output(report, to_report(*mesh->report), "report");
  });
}

dif_status dif_reconstruct_block(const dif_field* field, const dif_block* block,
                                 const dif_grid* grid, const dif_options* options,
                                 dif_mesh** mesh) {
  return capi::guarded([&] {
    dif_mesh*& handle = capi::out_handle(mesh, "mesh");
    handle = to_handle(reconstruct_block(capi::to_view(field), to_block(block), capi::to_grid(grid),
                                         capi::to_options(options)))
                 .release();
  });
}

dif_status dif_mesh_weld(const dif_mesh* const* meshes, int64_t count, const dif_grid* grid,
                         dif_mesh** mesh) {
  return capi::guarded([&] {
    dif_mesh*& handle = capi::out_handle(mesh, "mesh");
    capi::required_array(meshes, count, "meshes");
    std::vector<const difmesh::Mesh*> parts;
    for (std::int64_t part = 0; part < count; ++part) {
      parts.push_back(meshes[part] != nullptr ? &meshes[part]->mesh : nullptr);
    }
    const difmesh::Grid whole = capi::to_grid(grid);
    handle = new dif_mesh{weld_pointers(parts, whole), std::nullopt};
  });
}
