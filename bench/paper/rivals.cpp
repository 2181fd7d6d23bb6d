// Smoothing and curvature as VTK's users have them, and ours beside it, on a ball of radius 0.35 N
// cells: what a grid of N³ cells holds.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>

#include "difmesh/curvature.hpp"
#include "difmesh/measure.hpp"
#include "errors.hpp"
#include "run.hpp"
#include "support/vec3.hpp"
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

/// Of the volume inside a mesh, percent of the body's.
double swelling(const Body& body, const Mesh& mesh) {
  return 100.0 * (measure(mesh).volume / body.shape->volume().value() - 1.0);
}

/// What smoothing does to a ball: moves it, changes its volume.
void add_smoothing_row(const Sample& at, const Named& surface, Table& table) {
  const Tally distance = errors(at.body, surface.mesh).distance;
  const double cells = at.body.size / at.spacing();
  table.add({surface.name, number(distance.mean() * cells, 3), number(distance.rms() * cells, 3),
             number(distance.maximum * cells, 3), number(swelling(at.body, surface.mesh), 3)});
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

CurvatureFacts our_facts(const Sample& at, const Mesh& mesh, int rings) {
  CurvatureOptions options;
  options.rings = rings;
  return facts_of(curvature(mesh, options).mean, at.body.size);
}

/// The mesh with its vertices moved on to the sphere: what the fit alone is off.
Mesh on_the_sphere(Mesh mesh, double radius) {
  for (Vec3& p : mesh.positions) {
    p = test::scaled(test::unit(p), radius);
  }
  return mesh;
}

#ifdef DIFMESH_WITH_VTK

constexpr int kSteps = 15;

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
  const VtkSurface surface = contour(at);
  add_smoothing_row(at, {"VTK: FlyingEdges3D", to_mesh(surface)}, table);
  const Named smooth{"VTK: FlyingEdges3D + WindowedSinc 15",
                     to_mesh(vtk_windowed_sinc(surface, kSteps))};
  add_smoothing_row(at, smooth, table);
  const double moved = errors(at.body, smooth.mesh).distance.mean() / at.spacing() * at.body.size;
  run.claim("VTK's WindowedSinc moves a ball outward, N = 128", "about 0.1 dx",
            number(moved, 3) + " dx", std::abs(moved - 0.1) < 0.02);
  const double swollen = swelling(at.body, smooth.mesh);
  run.claim("VTK's WindowedSinc changes the volume of a ball, N = 128", "about +0.6 %",
            number(swollen, 3) + " %", std::abs(swollen - 0.6) < 0.1);
}

/// Adds VTK's rows. \return those of its contours as they are
CurvatureFacts add_vtk_curvatures(std::int64_t n, const Sample& at, Table& table) {
  const VtkSurface surface = contour(at);
  const CurvatureFacts plain = facts_of(vtk_mean_curvatures(surface), at.body.size);
  const VtkSurface smooth = vtk_windowed_sinc(surface, kSteps);
  add_curvature_row(n, "VTK: FlyingEdges3D + vtkCurvatures", plain, table);
  add_curvature_row(n, "VTK: FlyingEdges3D + WindowedSinc 15 + vtkCurvatures",
                    facts_of(vtk_mean_curvatures(smooth), at.body.size), table);
  return plain;
}

#endif

void smoothing(Run& run) {
  const Sample at = sample(Body::sphere(), cells_per_radius(kCells), 0, run.threads);
  Table table({"surface", "mean distance, dx", "rms, dx", "max, dx", "volume, %"});
  std::vector<Way> ways = placements();
  std::ranges::copy(smoothings(), std::back_inserter(ways));
  for (const Way& one : ways) {
    add_smoothing_row(at, {one.name, one.surface(at)}, table);
  }
  const double swollen = swelling(at.body, way("linear + taubin").surface(at));
  run.claim("ours (taubin, 15 steps) changes the volume of a ball, N = 128", "< 0.1 %",
            number(swollen, 3) + " %", std::abs(swollen) < 0.1);
#ifdef DIFMESH_WITH_VTK
  add_vtk_smoothing(run, at, table);
#endif
  run.write_csv("smoothing", table);
  run.write_page("smoothing", table);
}

void curvatures(Run& run) {
  Table table({"N", "surface and curvature", "mean of R abs(H)", "rms of R abs(H) - 1"});
  std::vector<std::int64_t> sizes{128, 256, 512};
  if (run.is_short) {
    sizes = {48, 96};
  }
  std::vector<double> ours;
  [[maybe_unused]] std::vector<double> vtk;
  for (const std::int64_t n : sizes) {
    std::fprintf(stderr, "paper: curvature at N = %lld\n", static_cast<long long>(n));
    const Sample at = sample(Body::sphere(), cells_per_radius(n), 0, run.threads);
#ifdef DIFMESH_WITH_VTK
    vtk.push_back(add_vtk_curvatures(n, at, table).mean);
#endif
    add_curvature_row(n, "linear + curvature()", our_facts(at, way("linear").surface(at), 2),
                      table);
    add_curvature_row(n, "linear + taubin + curvature()",
                      our_facts(at, way("linear + taubin").surface(at), 2), table);
    const Mesh plic = way("plic").surface(at);
    const CurvatureFacts facts = our_facts(at, plic, 2);
    add_curvature_row(n, "plic + curvature()", facts, table);
    add_curvature_row(n, "plic + curvature() of 3 rings", our_facts(at, plic, 3), table);
    const Mesh exact = on_the_sphere(plic, at.body.size);
    add_curvature_row(n, "exact vertices + curvature()", our_facts(at, exact, 2), table);
    ours.push_back(facts.rms);
  }
  run.write_csv("curvature", table);
  run.write_page("curvature", table);
#ifdef DIFMESH_WITH_VTK
  run.claim("vtkCurvatures on linear contours, mean of R abs(H), from the first N to the last",
            "grows like N", number(vtk.front(), 3) + " to " + number(vtk.back(), 3),
            vtk.back() > 1.8 * vtk.front());
#endif
  run.claim("curvature of plic stays good with more cells, rms of R H - 1", "< 0.005",
            "at most " + number(std::ranges::max(ours), 3), std::ranges::max(ours) < 0.005);
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
