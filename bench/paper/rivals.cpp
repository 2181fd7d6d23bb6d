// Smoothing and curvature as VTK's users have them, and ours beside it, on a ball of radius 0.35 N cells:
// what a grid of N³ cells holds.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "difmesh/curvature.hpp"
#include "difmesh/measure.hpp"
#include "errors.hpp"
#include "run.hpp"
#include "surfaces.hpp"
#ifdef DIFMESH_WITH_VTK
#include "vtk_filters.hpp"
#endif

namespace difmesh::paper {
namespace {

constexpr double kRadiusOverN = 0.35;
constexpr std::int64_t kCells = 128;

double cells_per_radius(std::int64_t n) {
  return kRadiusOverN * static_cast<double>(n);
}

struct Named {
  std::string name;
  Mesh mesh;
};

/// What smoothing does to a ball: moves it, changes its volume.
void add_smoothing_row(const Sample& at, const Named& surface, Table& table) {
  const Tally distance = errors(at.body, surface.mesh).distance;
  const double cells = at.body.size / at.spacing();
  const double exact = at.body.shape->volume().value_or(0.0);
  table.add({surface.name, number(distance.mean() * cells, 3), number(distance.rms() * cells, 3),
             number(distance.maximum * cells, 3),
             number(100.0 * (measure(surface.mesh).volume / exact - 1.0), 3)});
}

/// Of values that should all be 1 / R: mean of |H| R, and the rms of |H| R - 1.
struct CurvatureFacts {
  double mean = 0.0;
  double rms = 0.0;
};

template <class Values>
CurvatureFacts facts_of(const Values& curvatures, double radius) {
  CurvatureFacts facts;
  const auto count = static_cast<double>(curvatures.size());
  for (const double h : curvatures) {
    const double relative = std::abs(h) * radius;
    facts.mean += relative / count;
    facts.rms += (relative - 1.0) * (relative - 1.0) / count;
  }
  facts.rms = std::sqrt(facts.rms);
  return facts;
}

void add_curvature_row(std::int64_t n, const std::string& name, const CurvatureFacts& facts,
                       Table& table) {
  table.add({std::to_string(n), name, number(facts.mean, 4), number(facts.rms, 3)});
}

CurvatureFacts our_facts(const Sample& at, const std::string& way_name) {
  const Curvature fitted = curvature(way(way_name).surface(at));
  return facts_of(fitted.mean, at.body.size);
}

#ifdef DIFMESH_WITH_VTK

VtkSurface contour(const Sample& at) {
  Array<double> field = at.fractions;
  return vtk_contour(field.data(), at.grid.dims, at.grid.cell_centre({0, 0, 0}), at.spacing());
}

Mesh to_mesh(const VtkSurface& surface) {
  Mesh mesh;
  mesh.positions.assign(surface.positions.begin(), surface.positions.end());
  mesh.triangles.assign(surface.triangles.begin(), surface.triangles.end());
  return mesh;
}

void add_vtk_smoothing(Run& run, const Sample& at, Table& table) {
  constexpr int kSteps = 15;
  const VtkSurface surface = contour(at);
  add_smoothing_row(at, {"VTK: FlyingEdges3D", to_mesh(surface)}, table);
  const Named smooth{"VTK: FlyingEdges3D + WindowedSinc 15",
                     to_mesh(vtk_windowed_sinc(surface, kSteps))};
  add_smoothing_row(at, smooth, table);
  const double moved = errors(at.body, smooth.mesh).distance.mean() / at.spacing() * at.body.size;
  run.claim("VTK's WindowedSinc moves a ball outward, N = 128", "about 0.1 dx",
            number(moved, 3) + " dx", moved > 0.05);
}

CurvatureFacts vtk_facts(const Sample& at) {
  return facts_of(vtk_mean_curvatures(contour(at)), at.body.size);
}

#endif

void smoothing(Run& run) {
  const Sample at = sample(Body::sphere(), cells_per_radius(kCells), 0, run.threads);
  Table table({"surface", "mean distance, dx", "rms, dx", "max, dx", "volume, %"});
  for (const Way& one : all_ways()) {
    add_smoothing_row(at, {one.name, one.surface(at)}, table);
  }
#ifdef DIFMESH_WITH_VTK
  add_vtk_smoothing(run, at, table);
#endif
  run.write("smoothing", table);
}

void curvatures(Run& run) {
  Table table({"N", "surface and curvature", "mean of R abs(H)", "rms of R abs(H) - 1"});
  std::vector<std::int64_t> sizes{128, 256, 512};
  if (run.is_short) {
    sizes = {64, 128};
  }
  std::vector<double> ours;
  for (const std::int64_t n : sizes) {
    std::fprintf(stderr, "paper: curvature at N = %lld\n", static_cast<long long>(n));
    const Sample at = sample(Body::sphere(), cells_per_radius(n), 0, run.threads);
#ifdef DIFMESH_WITH_VTK
    add_curvature_row(n, "VTK: FlyingEdges3D + vtkCurvatures", vtk_facts(at), table);
#endif
    add_curvature_row(n, "linear + curvature()", our_facts(at, "linear"), table);
    const CurvatureFacts facts = our_facts(at, "plic");
    add_curvature_row(n, "plic + curvature()", facts, table);
    ours.push_back(facts.rms);
  }
  run.write("curvature", table);
  run.claim("curvature of plic does not get worse with more cells", "rms error falls",
            number(ours.front(), 3) + " to " + number(ours.back(), 3), ours.back() < ours.front());
}

}  // namespace

void run_rivals(Run& run) {
#ifndef DIFMESH_WITH_VTK
  std::printf("left out: VTK's smoothing and curvature, as this was built without VTK\n");
#endif
  smoothing(run);
  curvatures(run);
}

}  // namespace difmesh::paper
