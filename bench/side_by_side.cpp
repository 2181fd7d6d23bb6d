// Ours and VTK's vtkFlyingEdges3D on the same float32 field in the same process, in turn, so that a machine
// that changes its speed changes both. Prints medians and the median of the ratios of neighbouring runs.
//   side_by_side [threads] [rounds]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "difmesh/reconstruct.hpp"
#include "fields.hpp"
#include "flying_edges.hpp"

using namespace difmesh;

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double run_ours(const std::vector<float>& field, std::int64_t n, Placement placement, int threads) {
  const Grid grid{{n, n, n}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  Options options;
  options.placement = placement;
  options.threads = threads;
  const auto start = std::chrono::steady_clock::now();
  const Reconstruction result =
      reconstruct(FieldView::x_fastest(field.data(), grid.dims), grid, options);
  return seconds_since(start);
}

void compare(const std::string& name, std::vector<float> field, std::int64_t n, int threads,
             int rounds) {
  bench::FlyingEdges theirs(field, static_cast<int>(n));
  long long vertices = 0;
  for (const Placement placement : {Placement::linear, Placement::plic}) {
    std::vector<double> ours_times;
    std::vector<double> their_times;
    std::vector<double> ratios;
    for (int round = -1; round < rounds; ++round) {
      const double ours = run_ours(field, n, placement, threads);
      const auto start = std::chrono::steady_clock::now();
      vertices = theirs.run();
      const double vtk = seconds_since(start);
      if (round >= 0) {
        ours_times.push_back(ours);
        their_times.push_back(vtk);
        ratios.push_back(ours / vtk);
      }
    }
    std::printf("| %-8s %3lld | %-6s | %8.2f | %8.2f | %5.2f | %lld |\n", name.c_str(),
                static_cast<long long>(n), placement == Placement::plic ? "plic" : "linear",
                1e3 * median(ours_times), 1e3 * median(their_times), median(ratios), vertices);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 1;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 11;
  bench::FlyingEdges::set_threads(threads);
  std::printf("threads: %d, VTK's back end: %s\n", threads, bench::FlyingEdges::back_end());
  std::printf("| field | placement | difmesh ms | vtkFlyingEdges3D ms | ratio | vertices |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const std::int64_t n : {64, 128, 256, 512}) {
    compare("sphere", bench::sphere<float>(n), n, threads, n > 256 ? (rounds + 1) / 2 : rounds);
  }
  compare("gyroid", bench::gyroid<float>(256), 256, threads, (rounds + 1) / 2);
  return 0;
}
