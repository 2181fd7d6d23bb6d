#include "surfaces.hpp"

#include <algorithm>
#include <iterator>

#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/mollify.hpp"
#include "difmesh/smoothing.hpp"

namespace difmesh::paper {
namespace {

Options one_thread(Placement placement, Normals normals = Normals::height_function) {
  Options options;
  options.placement = placement;
  options.normals = normals;
  options.threads = 1;
  return options;
}

Way plain(const std::string& name, const Options& options) {
  return {name, [options](const Sample& sample) {
            return reconstruct(sample.field(), sample.grid, options).mesh;
          }};
}

/// E19, Fig. 2c.
Mesh mollified_linear(const Sample& sample) {
  MollifyOptions options;
  options.threads = 1;
  const Array<double> field = mollify(sample.field(), options);
  return reconstruct(FieldView::x_fastest(field.data(), sample.grid.dims), sample.grid,
                     one_thread(Placement::linear))
      .mesh;
}

Mesh linear(const Sample& sample) {
  return reconstruct(sample.field(), sample.grid, one_thread(Placement::linear)).mesh;
}

/// Steps of all smoothing, as in E19, Fig. 2d.
constexpr int kSteps = 15;

Mesh laplacian_linear(const Sample& sample) {
  LaplacianOptions options;
  options.steps = kSteps;
  options.threads = 1;
  Mesh mesh = linear(sample);
  mesh.positions = smooth_laplacian(mesh.positions, mesh.triangles, options);
  return mesh;
}

Mesh taubin_linear(const Sample& sample) {
  TaubinOptions options;
  options.steps = kSteps;
  options.threads = 1;
  Mesh mesh = linear(sample);
  mesh.positions = smooth_taubin(mesh.positions, mesh.triangles, options);
  return mesh;
}

/// One step, so long that waves of four cells are damped to a tenth.
Mesh flow_linear(const Sample& sample) {
  CurvatureFlowOptions options;
  options.time = 3.6 * sample.spacing() * sample.spacing();
  options.threads = 1;
  Mesh mesh = linear(sample);
  mesh.positions = smooth_by_curvature_flow(mesh.positions, mesh.triangles, options);
  return mesh;
}

/// With the default tolerance in the fractions.
Mesh constrained(const Sample& sample, Placement placement) {
  Options options = one_thread(placement);
  options.edge_ids = true;
  Mesh mesh = reconstruct(sample.field(), sample.grid, options).mesh;
  ConstrainedSmoothingOptions smoothing;
  smoothing.threads = 1;
  mesh = smooth_within_fractions(mesh, sample.grid, smoothing).mesh;
  return mesh;
}

Way constrained_way(const std::string& name, Placement placement) {
  return {name, [placement](const Sample& sample) { return constrained(sample, placement); }};
}

}  // namespace

std::vector<Way> placements() {
  return {plain("linear", one_thread(Placement::linear)),
          plain("manson", one_thread(Placement::manson)),
          plain("plic", one_thread(Placement::plic))};
}

std::vector<Way> kinds_of_normals() {
  return {plain("plic", one_thread(Placement::plic)),
          plain("plic (youngs)", one_thread(Placement::plic, Normals::youngs)),
          plain("plic (myc)", one_thread(Placement::plic, Normals::myc)),
          plain("plic (elvira)", one_thread(Placement::plic, Normals::elvira)),
          plain("plic (lvira)", one_thread(Placement::plic, Normals::lvira))};
}

std::vector<Way> smoothings() {
  return {{"linear (mollified)", mollified_linear},
          {"linear + laplacian", laplacian_linear},
          {"linear + taubin", taubin_linear},
          {"linear + curvature flow", flow_linear},
          constrained_way("linear + constrained", Placement::linear),
          constrained_way("plic + constrained", Placement::plic)};
}

std::vector<std::string> golf_ball_ways() {
  return {"linear", "linear (mollified)", "linear + taubin", "linear + constrained", "manson",
          "plic"};
}

Way way(const std::string& name) {
  std::vector<Way> ways = placements();
  std::ranges::copy(smoothings(), std::back_inserter(ways));
  return *std::ranges::find(ways, name, &Way::name);
}

}  // namespace difmesh::paper
