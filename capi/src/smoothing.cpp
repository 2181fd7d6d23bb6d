#include "difmesh/smoothing.hpp"

#include <array>
#include <string>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/constrained_smoothing.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

using difmesh::BoundaryVertices;
using difmesh::Mesh;

/// What all kinds take.
template <class Options>
Options common(const dif_smoothing_options& given) {
  Options options;
  options.steps = given.steps == 0 ? options.steps : given.steps;
  options.threads = given.threads;
  options.progress = capi::to_progress(given.progress, given.progress_user);
  return options;
}

BoundaryVertices boundary_of(const dif_smoothing_options& given) {
  return capi::to_choice(given.boundary, BoundaryVertices::stay, difmesh::kBoundaryVertices,
                         "boundary");
}

Mesh laplacian(const Mesh& mesh, const dif_smoothing_options& given) {
  auto options = common<difmesh::LaplacianOptions>(given);
  options.factor = given.factor;
  options.boundary = boundary_of(given);
  return smooth_laplacian(mesh, options);
}

Mesh taubin(const Mesh& mesh, const dif_smoothing_options& given) {
  auto options = common<difmesh::TaubinOptions>(given);
  options.lambda = given.lambda;
  options.pass_band = given.pass_band;
  options.boundary = boundary_of(given);
  return smooth_taubin(mesh, options);
}

Mesh flow(const Mesh& mesh, const dif_smoothing_options& given) {
  auto options = common<difmesh::CurvatureFlowOptions>(given);
  options.time = given.time;
  options.residual = given.residual;
  return smooth_by_curvature_flow(mesh, options);
}

Mesh constrained(const Mesh& mesh, const dif_grid* grid, const dif_smoothing_options& given) {
  auto options = common<difmesh::ConstrainedSmoothingOptions>(given);
  options.tolerance = given.tolerance;
  options.clearance = given.clearance;
  return smooth_within_fractions(mesh, capi::to_grid(grid), options).mesh;
}

Mesh smoothed(const Mesh& mesh, const dif_grid* grid, const dif_smoothing_options& given) {
  static_cast<void>(boundary_of(given));
  switch (given.kind) {
    case DIF_SMOOTHING_DEFAULT:
    case DIF_SMOOTHING_TAUBIN:
      return taubin(mesh, given);
    case DIF_SMOOTHING_LAPLACIAN:
      return laplacian(mesh, given);
    case DIF_SMOOTHING_FLOW:
      return flow(mesh, given);
    case DIF_SMOOTHING_CONSTRAINED:
      return constrained(mesh, grid, given);
    default:
      capi::fail_argument("kind is " + std::to_string(given.kind) + "; 0 to 4 are possible");
  }
}

}  // namespace

dif_status dif_smoothing_options_init(dif_smoothing_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    const difmesh::LaplacianOptions laplacian_defaults;
    const difmesh::TaubinOptions taubin_defaults;
    const difmesh::CurvatureFlowOptions flow_defaults;
    const difmesh::ConstrainedSmoothingOptions constrained_defaults;
    dif_smoothing_options value{};
    value.factor = laplacian_defaults.factor;
    value.lambda = taubin_defaults.lambda;
    value.pass_band = taubin_defaults.pass_band;
    value.time = flow_defaults.time;
    value.residual = flow_defaults.residual;
    value.tolerance = constrained_defaults.tolerance;
    value.clearance = constrained_defaults.clearance;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_mesh_smooth(const dif_mesh* mesh, const dif_grid* grid,
                           const dif_smoothing_options* options, dif_mesh** smooth) {
  return capi::guarded([&] {
    dif_mesh*& handle = capi::out_handle(smooth, "smooth");
    const Mesh& given = capi::required(mesh, "mesh").mesh;
    dif_smoothing_options defaults{};
    dif_smoothing_options_init(&defaults, sizeof defaults);
    const dif_smoothing_options chosen = capi::read_struct(options, defaults, "options");
    handle = new dif_mesh{.mesh = smoothed(given, grid, chosen)};
  });
}
