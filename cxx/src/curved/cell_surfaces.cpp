#include "difmesh/cell_surfaces.hpp"

#include "base/parallel.hpp"
#include "base/vector3.hpp"
#include "curved/neighbourhood.hpp"
#include "curved/surface_maker.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "grid/block_field.hpp"
#include "grid/cell_list.hpp"

namespace difmesh {
namespace {

constexpr std::int64_t kCellsPerPortion = 64;

CellSurface in_space(const detail::LocalSurface& local, double length) {
  CellSurface result;
  result.source = local.source;
  result.length = length;
  if (local.count == 0) {
    return result;
  }
  const detail::Graph& graph = local.graphs[0];
  const Vec3 foot = detail::foot_of(local);
  const detail::FunctionJet jet = local.jet(foot);
  const detail::LevelCurvature curvature = detail::curvature_of(jet);
  const double spread = curvature.spread();
  result.axis = local.axis;
  result.foot = detail::scaled(foot, length);
  result.normal = detail::unit(jet.gradient);
  result.mean = curvature.mean / length;
  result.gaussian = curvature.gaussian / length / length;
  result.largest = (curvature.mean + spread) / length;
  result.smallest = (curvature.mean - spread) / length;
  result.residual = graph.residual;
  result.frame = graph.frame;
  result.coefficients = graph.coefficients;
  return result;
}

}  // namespace

void cell_surfaces(const FieldView& field, const Grid& grid, std::span<const Index3> cells,
                   CellSurfaceKind kind, const Options& options, std::span<CellSurface> surfaces) {
  const DefaultFloatEnvironment environment;
  if (kind != CellSurfaceKind::position && kind != CellSurfaceKind::curvature) {
    throw Error(ErrorCode::invalid_argument, "cell_surfaces: unknown kind");
  }
  const detail::BlockField block =
      detail::make_block_field(field, {{0, 0, 0}, grid.dims, {}, {}}, grid, options);
  detail::check_cell_list("cell_surfaces", grid, cells, surfaces.size(), "surfaces");
  detail::Workers workers(options.threads);
  detail::Phases phases(workers, options.progress);
  detail::with_scalar(field.type, [&](auto type) {
    const detail::SurfaceMaker<decltype(type)> maker(block, kind);
    phases.run(1.0, static_cast<std::int64_t>(cells.size()), kCellsPerPortion,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end);
                      ++n) {
                   surfaces[n] = in_space(maker(cells[n]), detail::unit_length(block, cells[n]));
                 }
               });
  });
  phases.finish();
}

}  // namespace difmesh
