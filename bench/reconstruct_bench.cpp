// Time of the whole and of each phase on a sphere of radius 0.35 N, one thread. The phases are
// timed by the library's own report, in the same runs as the whole.

#include <benchmark/benchmark.h>

#include "difmesh/reconstruct.hpp"
#include "fields.hpp"

using namespace difmesh;

namespace {

using Seconds = Report::Seconds;

template <class T>
const std::vector<T>& sphere_field(std::int64_t n) {
  static std::int64_t size = 0;
  static std::vector<T> field;
  if (size != n) {
    field = bench::sphere<T>(n);
    size = n;
  }
  return field;
}

template <class T>
void run(benchmark::State& state, Placement placement, double Seconds::*phase) {
  const std::int64_t n = state.range(0);
  const std::vector<T>& field = sphere_field<T>(n);
  const Grid grid{{n, n, n}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  Options options;
  options.placement = placement;
  options.threads = 1;
  std::int64_t vertices = 0;
  for (auto _ : state) {
    const Reconstruction result =
        reconstruct(FieldView::x_fastest(field.data(), grid.dims), grid, options);
    state.SetIterationTime(result.report.seconds.*phase);
    vertices = static_cast<std::int64_t>(result.mesh.positions.size());
  }
  state.counters["vertices"] = static_cast<double>(vertices);
}

void add(const char* name, void (*function)(benchmark::State&, Placement, double Seconds::*),
         Placement placement, double Seconds::*phase) {
  benchmark::RegisterBenchmark(name, function, placement, phase)
      ->Arg(128)
      ->Arg(256)
      ->Arg(512)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  add("whole/linear/float32", run<float>, Placement::linear, &Seconds::total);
  add("whole/plic/float32", run<float>, Placement::plic, &Seconds::total);
  add("classify/plic/float32", run<float>, Placement::plic, &Seconds::classify);
  add("normals/plic/float32", run<float>, Placement::plic, &Seconds::normals);
  add("count/plic/float32", run<float>, Placement::plic, &Seconds::count);
  add("vertices/plic/float32", run<float>, Placement::plic, &Seconds::vertices);
  add("triangles/plic/float32", run<float>, Placement::plic, &Seconds::triangles);
  add("whole/plic/float64", run<double>, Placement::plic, &Seconds::total);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
