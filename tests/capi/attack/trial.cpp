#include "trial.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "float_settings.hpp"
#include "instructions.hpp"
#include "random.hpp"
#include "text.hpp"

namespace difmesh::attack {
namespace {

struct Result {
  MeshHandle mesh;
  Surface surface;
  dif_report report{};
  dif_status status = DIF_OK;
};

void complete(Result& result, dif_mesh* mesh) {
  result.mesh.reset(mesh);
  if (result.status == DIF_OK) {
    result.surface = surface_of(mesh);
    result.report.struct_size = sizeof result.report;
    (void)dif_mesh_report(mesh, &result.report);
  }
}

Result reconstruct(const dif_field& field, const dif_options& options) {
  Result result;
  dif_mesh* mesh = nullptr;
  result.status = dif_reconstruct(&field, &options, &mesh);
  complete(result, mesh);
  return result;
}

// What differs from a surface that should have the same bits.
Finding difference_of(const Surface& surface, const Result& result, const char* what) {
  return result.status == DIF_OK ? difference(surface, result.surface, what)
                                 : Finding{what, dif_last_message()};
}

bool same_facts(const dif_report& a, const dif_report& b) {
  return a.cells == b.cells && a.interfacial_cells == b.interfacial_cells &&
         a.clamped_cells == b.clamped_cells && a.largest_overshoot == b.largest_overshoot &&
         a.fraction_volume == b.fraction_volume && a.planes == b.planes &&
         a.height_function_cells == b.height_function_cells &&
         a.gradient_free_cells == b.gradient_free_cells && a.solved_edges == b.solved_edges &&
         a.newton_steps_mean == b.newton_steps_mean && a.newton_steps_max == b.newton_steps_max &&
         a.non_monotone_edges == b.non_monotone_edges && a.closed == b.closed &&
         a.enclosed_volume == b.enclosed_volume;
}

bool is_in_bounds(const Specimen& specimen) {
  return specimen.type == DIF_UINT8 || specimen.type == DIF_UINT16 ||
         std::all_of(specimen.values.begin(), specimen.values.end(), [&](double value) {
           return std::max(-value, value - 1.0) <= specimen.options.overshoot_bound;
         });
}

dif_grid grid_of(const Specimen& specimen) {
  dif_grid grid{};
  grid.struct_size = sizeof grid;
  for (std::size_t a = 0; a < 3; ++a) {
    grid.dims[a] = specimen.dims[a];
    grid.origin[a] = specimen.origin[a];
    grid.spacing[a] = specimen.spacing[a];
  }
  return grid;
}

// Cells [low, high) with ghost layers: as many as needed and some more.
dif_block block_of(const Specimen& specimen, const Index3& low, const Index3& high) {
  dif_block block{};
  block.struct_size = sizeof block;
  const std::int64_t needed = specimen.options.placement == DIF_PLACEMENT_CURVED
                                  ? DIF_CURVED_GHOST_LAYERS
                                  : DIF_GHOST_LAYERS;
  const std::int64_t most = needed + specimen.more_ghosts;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t dim = specimen.dims[a];
    block.offset[a] = low[a];
    block.dims[a] = high[a] - low[a];
    if (specimen.is_periodic(a)) {
      // One that is whole along an axis needs none.
      const bool none = block.dims[a] == dim && specimen.more_ghosts % 2 == 0;
      block.ghost_low[a] = none ? 0 : most;
      block.ghost_high[a] = none ? 0 : most;
    } else {
      block.ghost_low[a] = std::min(most, low[a]);
      block.ghost_high[a] = std::min(most, dim - high[a]);
    }
  }
  return block;
}

Result reconstruct_block(const Specimen& specimen, const dif_block& block, const dif_grid& grid,
                         Elements& elements) {
  Index3 from;
  Index3 size;
  for (std::size_t a = 0; a < 3; ++a) {
    from[a] = block.offset[a] - block.ghost_low[a];
    size[a] = block.ghost_low[a] + block.dims[a] + block.ghost_high[a];
  }
  const dif_field field = elements.lay_out(specimen, from, size);
  Result result;
  dif_mesh* mesh = nullptr;
  result.status = dif_reconstruct_block(&field, &block, &grid, &specimen.options, &mesh);
  complete(result, mesh);
  return result;
}

// By the method's description: a node of open faces is inside where the plane of its cell says so,
// unless the cell holds or lacks so little that it may count as pure; then it may be as its cell
// is. `normal` is null where the cell has no plane.
bool is_as_described(const Specimen& specimen, const OpenNode& open, const double* normal,
                     double offset) {
  const double fraction = specimen.fraction(open.cell);
  const bool follows_cell = open.inside == (fraction >= 0.5);
  if (normal == nullptr) {
    return follows_cell;
  }
  double height = -offset;  // above the plane
  double scale = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    height += 0.5 * static_cast<double>(open.face[a]) * specimen.spacing[a] * normal[a];
    scale += specimen.spacing[a] * std::abs(normal[a]);
  }
  const double smear = std::max(0.01, specimen.options.purity_tolerance) + 1e-9;
  const bool may_follow_cell = fraction <= smear || fraction >= 1.0 - smear;
  const bool near = std::abs(height) <= 1e-9 * scale;
  return near || open.inside == (height < 0.0) || (may_follow_cell && follows_cell);
}

}  // namespace

Finding Trial::run(const Specimen& specimen) {
  const int sets = instruction_sets();
  const auto set = static_cast<int>(specimen.variants >> 8 & 0xff) % sets;
  use_instruction_set(set);
  const dif_field field = elements_.lay_out(specimen, {0, 0, 0}, specimen.dims);
  Result main = reconstruct(field, specimen.options);
  mesh_ = std::move(main.mesh);
  surface_ = main.surface;
  report_ = main.report;
  if (main.status != DIF_OK || !is_in_bounds(specimen)) {
    return check_refusal(specimen, main.status);
  }
  if (Finding finding = judge_.check(specimen, surface_, report_)) {
    return finding;
  }
  dif_options options = specimen.options;
  options.threads = specimen.other_threads;
  if ((specimen.variants & kWithProgress) != 0) {
    options.progress = [](void*, double) { return std::int32_t{0}; };
  }
  use_instruction_set((set + 1 + static_cast<int>(specimen.variants >> 16 & 1)) % sets);
  const Result other = reconstruct(field, options);
  if (other.status != DIF_OK || !same_facts(report_, other.report)) {
    return {"another report with another instruction set or number of threads", dif_last_message()};
  }
  if (Finding finding = difference(surface_, other.surface,
                                   "another surface with another instruction set or number of "
                                   "threads")) {
    return finding;
  }
  if (Finding finding = check_variants(specimen, field)) {
    return finding;
  }
  return check_blocks(specimen);
}

Finding Trial::check_refusal(const Specimen& specimen, dif_status status) const {
  const dif_status expected = is_in_bounds(specimen) ? DIF_OK : DIF_ERROR_INVALID_VALUE;
  if (status != expected) {
    return {"another status", text("%s, not %s: %s", dif_status_name(status),
                                   dif_status_name(expected), dif_last_message())};
  }
  return mesh_ == nullptr ? Finding{} : Finding{"a mesh from a refused field", ""};
}

Finding Trial::check_variants(const Specimen& specimen, const dif_field& field) {
  Finding finding;
  const auto check = [&](Variant variant, const auto& what) {
    if (!finding && (specimen.variants & variant) != 0) {
      finding = what();
    }
  };
  check(kWithoutGaps, [&] {
    const Result plain = reconstruct(others_.lay_out_plainly(specimen), specimen.options);
    return difference_of(surface_, plain, "another surface without gaps");
  });
  check(kWithoutNormals, [&] { return check_bare(field, specimen.options); });
  check(kInFloat64, [&] { return check_float64(specimen); });
  check(kOtherFloats, [&] { return check_other_floats(specimen, field); });
  check(kMeasured, [&] { return check_measure(); });
  check(kOpenFaces, [&] { return check_open_faces(specimen, field); });
  return finding;
}

Finding Trial::check_float64(const Specimen& specimen) {
  Specimen wide = specimen;
  wide.type = DIF_FLOAT64;
  if (specimen.type == DIF_UINT8 || specimen.type == DIF_UINT16) {
    for (double& value : wide.values) {
      value /= specimen.type == DIF_UINT8 ? 255.0 : 65535.0;
    }
  }
  const Result same = reconstruct(others_.lay_out(wide, {0, 0, 0}, wide.dims), wide.options);
  return difference_of(surface_, same, "another surface in float64");
}

Finding Trial::check_other_floats(const Specimen& specimen, const dif_field& field) const {
  dif_options options = specimen.options;
  options.threads = specimen.other_threads;
  bool untouched = false;
  Result result;
  {
    const OtherFloatSettings settings(specimen.variants >> 20);
    result = reconstruct(field, options);
    untouched = settings.are_untouched();
  }
  if (!untouched) {
    return {"floating-point settings or flags that a reconstruction left behind", ""};
  }
  return difference_of(surface_, result, "another surface with other floating-point settings");
}

Finding Trial::check_bare(const dif_field& field, const dif_options& options) const {
  dif_options bare = options;
  bare.vertex_normals = 0;
  bare.edge_ids = 0;
  const Result result = reconstruct(field, bare);
  if (result.status != DIF_OK || !same_positions(surface_, result.surface) ||
      !same_triangles(surface_, result.surface)) {
    return {"another surface without normals", ""};
  }
  return result.surface.normals.empty() && result.surface.ids.empty()
             ? Finding{}
             : Finding{"normals or edge ids that were not asked for", ""};
}

Finding Trial::check_measure() const {
  dif_measure measure{};
  measure.struct_size = sizeof measure;
  if (dif_mesh_measure(mesh_.get(), &measure) != DIF_OK) {
    return {"a surface that cannot be measured", dif_last_message()};
  }
  if (measure.manifold == 0 || measure.isolated_vertices != 0 || measure.closed != report_.closed ||
      measure.euler_number != measure.vertices - measure.edges + measure.triangles) {
    return {"a measure that finds the surface not manifold", ""};
  }
  return {};
}

Finding Trial::check_open_faces(const Specimen& specimen, const dif_field& field) const {
  if (specimen.options.placement == DIF_PLACEMENT_CURVED) {
    return {};  // surfaces decide, of which this knows nothing
  }
  std::vector<OpenNode> open;
  std::vector<std::int64_t> cells;
  judge_.nodes().for_each_open([&](const OpenNode& node) {
    open.push_back(node);
    cells.insert(cells.end(), node.cell.begin(), node.cell.end());
  });
  std::vector<double> normals(3 * open.size());
  std::vector<double> offsets(open.size());
  std::vector<std::int32_t> sources(open.size());
  if (dif_cell_planes(&field, &specimen.options, std::ssize(open), cells.data(), normals.data(),
                      offsets.data(), sources.data()) != DIF_OK) {
    return {"planes that cannot be had", dif_last_message()};
  }
  for (std::size_t n = 0; n < open.size(); ++n) {
    const bool has_plane = sources[n] != DIF_SOURCE_NONE;
    if (!is_as_described(specimen, open[n], has_plane ? &normals[3 * n] : nullptr, offsets[n])) {
      return {"a node of an open face against its cell and the plane in it",
              node_text(open[n].node)};
    }
  }
  return {};
}

Finding Trial::check_blocks(const Specimen& specimen) {
  std::array<std::vector<std::int64_t>, 3> bounds;
  for (std::size_t a = 0; a < 3; ++a) {
    bounds[a] = {0};
    bounds[a].insert(bounds[a].end(), specimen.cuts[a].begin(), specimen.cuts[a].end());
    bounds[a].push_back(specimen.dims[a]);
  }
  const dif_grid grid = grid_of(specimen);
  std::vector<Result> parts;
  std::int64_t interfacial = 0;
  for_each_node(
      {0, 0, 0}, {std::ssize(bounds[0]) - 2, std::ssize(bounds[1]) - 2, std::ssize(bounds[2]) - 2},
      [&](const Index3& place) {
        Index3 low;
        Index3 high;
        for (std::size_t a = 0; a < 3; ++a) {
          low[a] = bounds[a][static_cast<std::size_t>(place[a])];
          high[a] = bounds[a][static_cast<std::size_t>(place[a]) + 1];
        }
        parts.push_back(reconstruct_block(specimen, block_of(specimen, low, high), grid, others_));
        interfacial += parts.back().report.interfacial_cells;
      });
  Random random(specimen.variants);
  std::vector<const dif_mesh*> meshes;
  for (const Result& part : parts) {
    if (part.status != DIF_OK) {
      return {"a block that cannot be reconstructed", dif_last_message()};
    }
    meshes.push_back(part.mesh.get());
    std::swap(meshes.back(), meshes[static_cast<std::size_t>(random.below(std::ssize(meshes)))]);
  }
  dif_mesh* mesh = nullptr;
  if (dif_mesh_weld(meshes.data(), std::ssize(meshes), &grid, &mesh) != DIF_OK) {
    return {"blocks that cannot be welded", dif_last_message()};
  }
  const MeshHandle welded(mesh);
  if (interfacial != report_.interfacial_cells) {
    return {"blocks with other interfacial cells", ""};
  }
  return difference(surface_, surface_of(mesh), "blocks that do not make the whole");
}

}  // namespace difmesh::attack
