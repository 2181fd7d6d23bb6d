// Meshes of any kind: in and out by arrays, measured, curved, smoothed, and back to fractions.

#include <algorithm>
#include <cmath>

#include "calls.hpp"
#include "drawn.hpp"

namespace difmesh::fuzz {
namespace {

std::int64_t vertices_of(const dif_mesh* mesh) {
  const double* positions = nullptr;
  std::int64_t vertices = -1;
  demand(dif_mesh_positions(mesh, &positions, &vertices) == DIF_OK);
  return vertices;
}

std::int64_t triangles_of(const dif_mesh* mesh) {
  const std::uint32_t* indices = nullptr;
  std::int64_t triangles = -1;
  demand(dif_mesh_triangles(mesh, &indices, &triangles) == DIF_OK);
  return triangles;
}

/// Of three different vertices.
std::int64_t proper_triangles_of(const dif_mesh* mesh) {
  const std::uint32_t* t = nullptr;
  std::int64_t triangles = 0;
  demand(dif_mesh_triangles(mesh, &t, &triangles) == DIF_OK);
  std::int64_t proper = 0;
  for (std::int64_t n = 0; n < triangles; ++n, t += 3) {
    proper += t[0] != t[1] && t[1] != t[2] && t[2] != t[0] ? 1 : 0;
  }
  return proper;
}

std::size_t size(std::int64_t count) {
  return static_cast<std::size_t>(count);
}

void check_measure(const DrawnMesh& drawn) {
  dif_measure facts = prepared(dif_measure_init);
  const dif_status status = dif_mesh_measure(drawn.mesh.get(), &facts);
  demand_honest(status);
  demand(!drawn.usual || status == DIF_OK);
  if (status != DIF_OK) {
    return;
  }
  const std::int64_t used = facts.vertices - facts.isolated_vertices;
  demand(facts.vertices == vertices_of(drawn.mesh.get()));
  demand(facts.triangles == triangles_of(drawn.mesh.get()));
  const std::int64_t proper = proper_triangles_of(drawn.mesh.get());
  demand(facts.euler_number == used - facts.edges + proper);
  demand(facts.components <= proper);
  demand(!(facts.area < 0.0));
  demand(facts.vertices == 0 || (facts.low[0] <= facts.high[0] && facts.low[2] <= facts.high[2]));
  demand(facts.closed == 0 || facts.boundary_edges == 0);
}

/// A name of scalars, or what is none.
std::array<char, 4> draw_name(Input& input) {
  constexpr char letters[] = "az_9\0 ~";
  std::array<char, 4> name{};
  for (std::size_t n = 0; n < 3; ++n) {
    name[n] = letters[input.number(sizeof letters)];
  }
  return name;
}

void set_and_get(Input& input, const DrawnMesh& drawn) {
  dif_mesh* mesh = drawn.mesh.get();
  const std::int64_t vertices = vertices_of(mesh);
  const std::vector<double> numbers = draw_points(input, vertices);
  const std::vector<std::uint64_t> ids(size(vertices), input.byte());
  const bool removes = input.number(4) == 1;
  demand_honest(dif_mesh_set_normals(mesh, removes ? nullptr : numbers.data()));
  demand_honest(dif_mesh_set_edge_ids(mesh, ids.data()));
  for (int n = 0; n < 2; ++n) {
    const std::array<char, 4> name = draw_name(input);
    const double* values = n == 1 && removes ? nullptr : numbers.data();
    const dif_status status = dif_mesh_set_scalars(mesh, name.data(), values);
    demand_honest(status);
    const double* found = nullptr;
    std::int64_t count = -1;
    demand_honest(dif_mesh_scalars(mesh, name.data(), &found, &count));
    demand(count == (status == DIF_OK && values != nullptr ? vertices : 0));
    demand(std::equal(found, found + count, numbers.data(),
                      [](double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }));
  }
  const char* name = nullptr;
  demand_honest(dif_mesh_scalars_name(mesh, input.rarely() ? -1 : input.number(4), &name));
}

/// Room for `elements` of eight bytes, the largest that are copied, and nothing more.
void copy_out(Input& input, const DrawnMesh& drawn) {
  const dif_mesh* mesh = drawn.mesh.get();
  const std::int64_t stride =
      input.rarely() ? static_cast<std::int64_t>(input.word()) : 3 + input.number(3);
  const std::int64_t capacity = 4 * input.number(40);
  const std::int64_t first = input.rarely() ? static_cast<std::int64_t>(input.word()) : 1;
  const std::int32_t real = input.choice(DIF_FLOAT64);
  const std::int32_t integer = DIF_INT32 + input.choice(2);
  std::vector<double> out(size(capacity));
  std::vector<std::int64_t> indices(size(capacity));
  demand_honest(dif_mesh_copy_positions(mesh, real, stride, capacity, out.data()));
  demand_honest(dif_mesh_copy_normals(mesh, real, stride, capacity, out.data()));
  const dif_status status =
      dif_mesh_copy_triangles(mesh, integer, first, stride, capacity, indices.data());
  demand_honest(status);
  if (status == DIF_OK && integer == DIF_INT64 && triangles_of(mesh) > 0) {
    demand(indices[0] >= first && indices[0] < first + vertices_of(mesh));
  }
}

dif_smoothing_options draw_smoothing(Input& input) {
  dif_smoothing_options options = prepared(dif_smoothing_options_init);
  options.kind = input.choice(DIF_SMOOTHING_CONSTRAINED);
  options.steps = input.rarely() ? -1 : static_cast<std::int32_t>(1 + input.number(3));
  if (options.kind == DIF_SMOOTHING_CONSTRAINED) {
    // Each step measures all fractions some times.
    options.kind = input.number(16) == 1 ? options.kind : DIF_SMOOTHING_DEFAULT;
    options.steps = std::min(options.steps, 1);
  }
  options.boundary = input.choice(DIF_BOUNDARY_ALONG);
  options.threads = draw_threads(input);
  options.factor = input.number_or_any(1.0);
  options.lambda = input.number_or_any(0.6307);
  options.pass_band = input.number_or_any(0.1);
  options.time = input.number_or_any(0.25);
  options.residual = input.number_or_any(1e-6);
  options.tolerance = input.number_or_any(0.05);
  options.clearance = input.number_or_any(1e-12);
  return options;
}

bool all_finite(const dif_mesh* mesh) {
  const double* positions = nullptr;
  std::int64_t vertices = 0;
  demand(dif_mesh_positions(mesh, &positions, &vertices) == DIF_OK);
  return std::all_of(positions, positions + 3 * vertices,
                     [](double number) { return std::isfinite(number); });
}

/// The fractions under a surface; none where it is not taken.
std::vector<double> fractions_under(const dif_mesh* mesh, const dif_grid& grid) {
  std::vector<double> fractions(size(grid.dims[0] * grid.dims[1] * grid.dims[2]));
  dif_triangle_options options = prepared(dif_triangle_options_init);
  options.threads = 1;
  if (dif_fractions_from_mesh(&grid, mesh, &options, nullptr, fractions.data()) != DIF_OK) {
    fractions.clear();
  }
  return fractions;
}

void check_kept(const dif_mesh* before, const dif_mesh* after, const dif_grid& grid,
                double tolerance) {
  const std::vector<double> was = fractions_under(before, grid);
  const std::vector<double> is = fractions_under(after, grid);
  demand(was.size() == is.size());
  for (std::size_t cell = 0; cell < was.size(); ++cell) {
    demand(std::abs(was[cell] - is[cell]) <= tolerance + 1e-9);
  }
}

}  // namespace

void call_mesh_arrays(Input& input) {
  const std::int64_t what = input.number(3);
  const DrawnMesh drawn(input);
  if (!drawn.mesh) {
    return;
  }
  check_measure(drawn);
  if (what == 1) {
    set_and_get(input, drawn);
  } else if (what == 2) {
    copy_out(input, drawn);
  }
}

void call_curvature(Input& input) {
  dif_curvature_options options = prepared(dif_curvature_options_init);
  options.rings = input.rarely() ? static_cast<std::int32_t>(input.byte()) - 100
                                 : static_cast<std::int32_t>(1 + input.number(3));
  options.threads = draw_threads(input);
  Watch watch(input);
  watch.attend(options);
  const DrawnMesh drawn(input);
  if (!drawn.mesh) {
    return;
  }
  const std::int64_t vertices = vertices_of(drawn.mesh.get());
  std::vector<double> mean(size(vertices), -9.0);
  std::vector<double> largest = mean;
  std::vector<double> smallest = mean;
  const dif_status status = dif_mesh_curvature(drawn.mesh.get(), &options, mean.data(), nullptr,
                                               largest.data(), smallest.data());
  demand_honest(status);
  watch.check(status);
  for (std::size_t n = 0; status == DIF_OK && n < mean.size(); ++n) {
    demand(std::isnan(mean[n]) == std::isnan(largest[n]));
    demand(std::isnan(mean[n]) == std::isnan(smallest[n]));
    demand(!(largest[n] < smallest[n]));
    demand(!drawn.usual || !std::isinf(mean[n]));
  }
}

void call_smooth(Input& input) {
  dif_smoothing_options options = draw_smoothing(input);
  Watch watch(input);
  watch.attend(options);
  const DrawnMesh drawn(input);
  if (!drawn.mesh) {
    return;
  }
  dif_mesh* made = nullptr;
  const dif_status status = dif_mesh_smooth(drawn.mesh.get(), &drawn.grid, &options, &made);
  const Mesh smooth = taken(status, made);
  watch.check(status);
  if (!smooth) {
    return;
  }
  demand(vertices_of(made) == vertices_of(drawn.mesh.get()));
  demand(triangles_of(made) == triangles_of(drawn.mesh.get()));
  if (options.kind == DIF_SMOOTHING_CONSTRAINED) {
    check_kept(drawn.mesh.get(), made, drawn.grid, options.tolerance);
  }
  demand(!drawn.usual || all_finite(made));
}

void call_fractions_from_mesh(Input& input) {
  dif_triangle_options options = prepared(dif_triangle_options_init);
  options.overlaps = input.choice(DIF_OVERLAPS_COUNT);
  options.flip = input.choice(1);
  options.check_edges = 1 - input.choice(1);
  options.tolerance = input.number_or_any(1e-9);
  options.threads = draw_threads(input);
  Watch watch(input);
  watch.attend(options);
  const DrawnMesh drawn(input);
  if (!drawn.mesh) {
    return;
  }
  std::vector<double> fractions(size(drawn.grid.dims[0] * drawn.grid.dims[1] * drawn.grid.dims[2]),
                                -9.0);
  dif_triangle_report report = prepared(dif_triangle_report_init);
  const dif_status status =
      dif_fractions_from_mesh(&drawn.grid, drawn.mesh.get(), &options, &report, fractions.data());
  demand_honest(status);
  watch.check(status);
  if (status != DIF_OK) {
    return;
  }
  const bool counts = options.overlaps == DIF_OVERLAPS_COUNT;
  demand(std::ranges::all_of(fractions, [counts](double value) {
    return counts ? std::isfinite(value) : value >= 0.0 && value <= 1.0;
  }));
  demand(report.cells_touched <= static_cast<std::int64_t>(fractions.size()));
}

void call_distance(Input& input) {
  dif_distance_options options = prepared(dif_distance_options_init);
  options.with_sign = input.choice(1);
  options.facet_spacing = input.rarely() ? -1.0 : 0.0;
  options.threads = draw_threads(input);
  const DrawnMesh drawn(input);
  const DrawnMesh reference(input);
  if (!drawn.mesh || !reference.mesh) {
    return;
  }
  dif_distance there = prepared(dif_distance_init);
  dif_distance back = prepared(dif_distance_init);
  const dif_status status =
      dif_distance_to_mesh(drawn.mesh.get(), reference.mesh.get(), &options, &there, &back);
  if (dif_has(DIF_PART_DISTANCE) == 0) {
    demand(status == DIF_ERROR_UNSUPPORTED);
    return;
  }
  demand_honest(status);
  demand(status != DIF_OK || !drawn.usual || !reference.usual ||
         (there.vertices.maximum >= 0.0 && back.vertices.maximum >= 0.0));
}

}  // namespace difmesh::fuzz
