// Time of fractions_from_mesh(): a sphere of 80,000 triangles and, where it is there, the Stanford
// bunny. "ns_per_piece" is the clipping phase, writing of the field included, over the
// triangle-cell pieces; "write_field" shows what of it is the field alone.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "difmesh/fractions_from_mesh.hpp"
#include "support/triangle_meshes.hpp"

namespace {

using namespace difmesh;
using test::TriangleMesh;

/// The unit sphere by rings of quadrilaterals, each split in two, and caps of triangles.
TriangleMesh sphere(std::uint32_t rings, std::uint32_t sectors) {
  TriangleMesh mesh;
  mesh.positions.push_back({0, 0, 1});
  for (std::uint32_t r = 1; r < rings; ++r) {
    const double polar = std::numbers::pi * r / rings;
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const double azimuth = 2.0 * std::numbers::pi * s / sectors;
      mesh.positions.push_back({std::sin(polar) * std::cos(azimuth),
                                std::sin(polar) * std::sin(azimuth), std::cos(polar)});
    }
  }
  mesh.positions.push_back({0, 0, -1});
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (std::uint32_t s = 0; s < sectors; ++s) {
    const std::uint32_t next = (s + 1) % sectors;
    mesh.triangles.push_back({0, 1 + s, 1 + next});
    for (std::uint32_t r = 0; r + 2 < rings; ++r) {
      const std::uint32_t upper = 1 + r * sectors;
      const std::uint32_t lower = upper + sectors;
      mesh.triangles.push_back({upper + s, lower + s, lower + next});
      mesh.triangles.push_back({upper + s, lower + next, upper + next});
    }
    mesh.triangles.push_back({last, last - sectors + next, last - sectors + s});
  }
  return mesh;
}

/// A cube of cells round the mesh, its longest side over all cells but two.
Grid cube_around(const TriangleMesh& mesh, std::int64_t cells) {
  const auto [low, high] = test::corners_of_box_round(mesh);
  const double longest = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const double spacing = longest / static_cast<double>(cells - 2);
  Grid grid;
  grid.dims = {cells, cells, cells};
  grid.spacing = {spacing, spacing, spacing};
  for (std::size_t a = 0; a < 3; ++a) {
    grid.origin[a] = 0.5 * (low[a] + high[a]) - 0.497 * spacing * static_cast<double>(cells);
  }
  return grid;
}

void measure(benchmark::State& state, const TriangleMesh& mesh, const Grid& grid) {
  FractionsFromMeshOptions options;
  options.threads = static_cast<int>(state.range(1));
  double clip = 0.0;
  std::int64_t pieces = 0;
  for (auto _ : state) {
    const FractionsFromMesh result =
        fractions_from_mesh(grid, mesh.positions, mesh.triangles, options);
    benchmark::DoNotOptimize(result.fractions.data());
    clip += result.report.seconds.clip;
    pieces += result.report.pieces;
  }
  const auto runs = static_cast<double>(state.iterations());
  state.counters["pieces"] = static_cast<double>(pieces) / runs;
  state.counters["ns_per_cell"] = 1e9 * clip / runs / static_cast<double>(grid.cell_count());
  if (pieces > 0) {
    state.counters["ns_per_piece"] = 1e9 * clip / static_cast<double>(pieces);
  }
}

void sizes_and_threads(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"cells", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const std::int64_t cells : {64, 128, 256}) {
    bench->Args({cells, 1});
  }
  bench->Args({256, 0});
}

void sphere_80k(benchmark::State& state) {
  const TriangleMesh mesh = sphere(200, 200);
  measure(state, mesh, cube_around(mesh, state.range(0)));
}
BENCHMARK(sphere_80k)->Apply(sizes_and_threads);

/// Few triangles that cross many cells each.
void octahedron(benchmark::State& state) {
  const TriangleMesh mesh = sphere(2, 4);
  measure(state, mesh, cube_around(mesh, state.range(0)));
}
BENCHMARK(octahedron)->Apply(sizes_and_threads);

/// The mesh lies beside the grid: nothing but zeros to write.
void write_field(benchmark::State& state) {
  const TriangleMesh mesh = sphere(2, 4);
  Grid grid = cube_around(mesh, state.range(0));
  grid.origin[1] += 10.0;
  measure(state, mesh, grid);
}
BENCHMARK(write_field)->Apply(sizes_and_threads);

#ifdef DIFMESH_SHARED_DATA
void bunny_75k(benchmark::State& state) {
  const auto mesh = test::read_off(std::string(DIFMESH_SHARED_DATA) + "/bunny00_75k.off");
  if (!mesh) {
    state.SkipWithError("bunny00_75k.off is not there");
    return;
  }
  measure(state, *mesh, cube_around(*mesh, state.range(0)));
}
BENCHMARK(bunny_75k)->Apply(sizes_and_threads);
#endif

}  // namespace

BENCHMARK_MAIN();
