// Ours and VTK's vtkFlyingEdges3D on the same field in the same process, in turn, so that a machine
// that changes its speed changes both. Prints medians, the median of the ratios of neighbouring
// runs, and how far each raises the process's memory; then how the time grows with the grid.
// scripts/bench.sh runs it.
//   side_by_side [rounds] [most threads]

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "difmesh/names.hpp"
#include "difmesh/reconstruct.hpp"
#include "fields.hpp"
#include "flying_edges.hpp"

using namespace difmesh;

namespace {

template <class Call>
double seconds_of(const Call& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// A line "Name: 123 kB" of /proc/self/status, in MiB.
double status_mib(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(name + ":", 0) == 0) {
      return std::strtod(line.c_str() + name.size() + 1, nullptr) / 1024.0;
    }
  }
  return 0.0;
}

// How far a call raises the memory of the process.
template <class Call>
double peak_mib(const Call& call) {
  // What earlier calls left on the heap would hide it.
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
  const double before = status_mib("VmRSS");
  call();
  return std::max(0.0, status_mib("VmHWM") - before);
}

template <class T>
Reconstruction run_ours(const std::vector<T>& field, std::int64_t n, Placement placement,
                        int threads) {
  const Grid grid{{n, n, n}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  Options options;
  options.placement = placement;
  options.threads = threads;
  return reconstruct(FieldView::x_fastest(field.data(), grid.dims), grid, options);
}

// Medians of one case, in seconds.
struct Times {
  double ours = 0.0;
  double theirs = 0.0;
  double ratio = 0.0;
};

template <class T>
Times time_in_turn(const std::vector<T>& field, std::int64_t n, Placement placement, int threads,
                   int rounds, bench::FlyingEdges& flying_edges) {
  std::vector<double> ours;
  std::vector<double> theirs;
  std::vector<double> ratios;
  for (int round = -1; round < rounds; ++round) {
    const double mine = seconds_of([&] { run_ours(field, n, placement, threads); });
    const double vtk = seconds_of([&] { flying_edges.run(); });
    if (round >= 0) {
      ours.push_back(mine);
      theirs.push_back(vtk);
      ratios.push_back(mine / vtk);
    }
  }
  return {median(ours), median(theirs), median(ratios)};
}

// Runs one field with both placements; appends the times in the order linear, plic.
template <class T>
void compare(const std::string& name, std::int64_t n, int threads, int rounds, std::vector<T> field,
             std::vector<Times>* all) {
  bench::FlyingEdges flying_edges(field, static_cast<int>(n));
  for (const Placement placement : {Placement::linear, Placement::plic}) {
    const Times times = time_in_turn(field, n, placement, threads, rounds, flying_edges);
    std::size_t vertices = 0;
    const double our_peak =
        peak_mib([&] { vertices = run_ours(field, n, placement, threads).mesh.positions.size(); });
    const double their_peak = peak_mib([&] { flying_edges.run(); });
    std::printf(
        "| %-6s %3lld | %-7s | %d | %-6s | %8.2f | %8.2f | %5.2f | %7zu | %6.1f | %6.1f |\n",
        name.c_str(), static_cast<long long>(n), sizeof(T) == 4 ? "float32" : "float64", threads,
        name_of(kPlacements, placement).data(), 1e3 * times.ours, 1e3 * times.theirs, times.ratio,
        vertices, our_peak, their_peak);
    std::fflush(stdout);
    if (all != nullptr) {
      all->push_back(times);
    }
  }
}

// Least squares of time = a N³ + b N², relative, over the sizes.
void print_growth(const std::vector<std::int64_t>& sizes, const std::vector<Times>& times,
                  std::size_t which) {
  double s33 = 0.0;
  double s32 = 0.0;
  double s22 = 0.0;
  double t3 = 0.0;
  double t2 = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const auto n = static_cast<double>(sizes[k]);
    const double seconds = times[2 * k + which].ours;
    const double x3 = n * n * n / seconds;
    const double x2 = n * n / seconds;
    s33 += x3 * x3;
    s32 += x3 * x2;
    s22 += x2 * x2;
    t3 += x3;
    t2 += x2;
  }
  const double determinant = s33 * s22 - s32 * s32;
  std::printf("| %s | %.3f | %.1f |\n", which == 0 ? "linear" : "plic",
              1e9 * (s22 * t3 - s32 * t2) / determinant, 1e9 * (s33 * t2 - s32 * t3) / determinant);
}

// Nanoseconds to read one float of a field in memory, where the compiler may use the machine's
// baseline only.
double read_nanoseconds(std::int64_t n) {
  const std::vector<float> field(static_cast<std::size_t>(n * n * n), 1.0F);
  std::vector<double> times;
  float sum = 0.0F;
  for (int round = 0; round < 9; ++round) {
    times.push_back(seconds_of([&] {
      float lanes[16] = {};
      for (std::size_t i = 0; i < field.size(); i += 16) {
        for (std::size_t lane = 0; lane < 16; ++lane) {
          lanes[lane] += field[i + lane];
        }
      }
      sum += std::accumulate(lanes, lanes + 16, 0.0F);
    }));
  }
  return sum > 0.0F ? 1e9 * median(times) / static_cast<double>(n * n * n) : 0.0;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 11;
  const int most_threads = argc > 2 ? std::atoi(argv[2]) : 2;
  const std::vector<std::int64_t> sizes{64, 128, 256, 512};
  std::printf("VTK %s, back end %s, without normals; medians of up to %d runs in turn\n\n",
              bench::FlyingEdges::version(), bench::FlyingEdges::back_end(), rounds);
  std::printf(
      "| field | elements | threads | placement | difmesh ms | vtkFlyingEdges3D ms | ratio | "
      "vertices "
      "| difmesh MiB | VTK MiB |\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<Times> growth;
  for (int threads = 1; threads <= most_threads; ++threads) {
    bench::FlyingEdges::set_threads(threads);
    for (const std::int64_t n : sizes) {
      const int fewer = n > 256 ? (rounds + 1) / 2 : rounds;
      compare("sphere", n, threads, fewer, bench::sphere<float>(n),
              threads == 1 ? &growth : nullptr);
      if (threads == 1 && n < 512) {
        compare("sphere", n, threads, fewer, bench::sphere<double>(n), nullptr);
      }
    }
    compare("gyroid", 256, threads, (rounds + 1) / 2, bench::gyroid<float>(256), nullptr);
    compare("gyroid", 256, threads, (rounds + 1) / 2, bench::gyroid<double>(256), nullptr);
  }
  std::printf(
      "\nTime of the float32 spheres on one thread as a N³ + b N²; reading the field takes %.3f ns "
      "per cell "
      "(512³)\n\n| placement | a, ns per cell | b, ns |\n|---|---|---|\n",
      read_nanoseconds(512));
  print_growth(sizes, growth, 0);
  print_growth(sizes, growth, 1);
  return 0;
}
