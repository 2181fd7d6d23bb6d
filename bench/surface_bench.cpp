// Curvature, smoothing, mollification and the normals that are fitted, on a sphere of radius 0.35
// N, one thread: processor time per vertex or cell.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "difmesh/cell_planes.hpp"
#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/curvature.hpp"
#include "difmesh/mollify.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/smoothing.hpp"
#include "fields.hpp"

using namespace difmesh;

namespace {

struct Sphere {
  Grid grid;
  std::vector<double> field;
  Mesh mesh;

  explicit Sphere(std::int64_t n) : field(bench::sphere<double>(n)) {
    grid.dims = {n, n, n};
    Options options;
    options.edge_ids = true;
    mesh = reconstruct(view(), grid, options).mesh;
  }
  [[nodiscard]] FieldView view() const { return FieldView::x_fastest(field.data(), grid.dims); }
};

const Sphere& sphere() {
  static const Sphere made(128);
  return made;
}

/// Counts what the time is per; kIsRate inverted is seconds.
void report(benchmark::State& state, std::size_t count) {
  state.counters["per_item"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

void curvature_of_vertices(benchmark::State& state) {
  CurvatureOptions options;
  options.threads = 1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(curvature(sphere().mesh, options));
  }
  report(state, sphere().mesh.positions.size());
}
BENCHMARK(curvature_of_vertices)->Unit(benchmark::kMillisecond);

void laplacian_step(benchmark::State& state) {
  LaplacianOptions options;
  options.steps = 10;
  options.threads = 1;
  const Mesh& mesh = sphere().mesh;
  for (auto _ : state) {
    benchmark::DoNotOptimize(smooth_laplacian(mesh.positions, mesh.triangles, options));
  }
  report(state, 10 * mesh.positions.size());
}
BENCHMARK(laplacian_step)->Unit(benchmark::kMillisecond);

void curvature_flow(benchmark::State& state) {
  CurvatureFlowOptions options;
  options.threads = 1;
  const Mesh& mesh = sphere().mesh;
  for (auto _ : state) {
    benchmark::DoNotOptimize(smooth_by_curvature_flow(mesh.positions, mesh.triangles, options));
  }
  report(state, mesh.positions.size());
}
BENCHMARK(curvature_flow)->Unit(benchmark::kMillisecond);

void within_fractions(benchmark::State& state) {
  ConstrainedSmoothingOptions options;
  options.threads = 1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(smooth_within_fractions(sphere().mesh, sphere().grid, options));
  }
  report(state, sphere().mesh.positions.size());
}
BENCHMARK(within_fractions)->Unit(benchmark::kMillisecond);

void mollified(benchmark::State& state) {
  MollifyOptions options;
  options.radius = static_cast<double>(state.range(0));
  options.threads = 1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(mollify(sphere().view(), options));
  }
  report(state, sphere().field.size());
}
BENCHMARK(mollified)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

void normals_of_cells(benchmark::State& state) {
  Options options;
  options.normals = static_cast<Normals>(state.range(0));
  options.threads = 1;
  const Array<Index3> cells = interfacial_cells(sphere().view(), sphere().grid);
  std::vector<CellPlane> planes(cells.size());
  for (auto _ : state) {
    cell_planes(sphere().view(), sphere().grid, cells, options, planes);
  }
  report(state, cells.size());
}
BENCHMARK(normals_of_cells)
    ->Arg(static_cast<int>(Normals::height_function))
    ->Arg(static_cast<int>(Normals::elvira))
    ->Arg(static_cast<int>(Normals::lvira))
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
