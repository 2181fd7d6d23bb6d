#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/fractions_from_function.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

using difmesh::Error;
using difmesh::ErrorCode;
using difmesh::Vec3;

difmesh::FunctionBatch to_function(dif_function f, void* user) {
  return capi::with_callers_settings([f, user](std::span<const Vec3> points,
                                               std::span<double> values) {
    if (f(user, static_cast<std::int64_t>(points.size()), points[0].data(), values.data()) != 0) {
      throw Error(ErrorCode::cancelled, "cancelled by the function");
    }
  });
}

difmesh::GradientBatch to_gradient(dif_gradient gradient, void* user) {
  if (gradient == nullptr) {
    return {};
  }
  return capi::with_callers_settings(
      [gradient, user](std::span<const Vec3> points, std::span<Vec3> gradients) {
        if (gradient(user, static_cast<std::int64_t>(points.size()), points[0].data(),
                     gradients[0].data()) != 0) {
          throw Error(ErrorCode::cancelled, "cancelled by the gradient");
        }
      });
}

difmesh::FractionsFromFunctionOptions to_options(const dif_function_options* options) {
  dif_function_options defaults{};
  dif_function_options_init(&defaults, sizeof defaults);
  const dif_function_options given = capi::read_struct(options, defaults, "options");
  capi::require_zero(given.reserved, "options");
  difmesh::FractionsFromFunctionOptions result;
  result.tolerance = given.tolerance;
  result.kink_tolerance = given.kink_tolerance;
  result.max_calls_per_cell = given.max_calls_per_cell;
  result.gradient = to_gradient(given.gradient, given.gradient_user);
  result.threads = given.threads;
  result.progress = capi::to_progress(given.progress, given.progress_user);
  return result;
}

dif_function_report to_report(const difmesh::FractionsFromFunctionReport& report) {
  dif_function_report result{};
  result.interfacial_cells = report.interfacial_cells;
  result.sampled_cells = report.sampled_cells;
  result.subdivided_cells = report.subdivided_cells;
  result.unresolved_cells = report.unresolved_cells;
  result.largest_error_estimate = report.largest_error_estimate;
  result.function_calls = report.function_calls;
  result.lattice_calls = report.lattice_calls;
  result.gradient_calls = report.gradient_calls;
  result.fraction_volume = report.fraction_volume;
  result.seconds = report.seconds.total;
  return result;
}

difmesh::FractionsFromMeshOptions to_options(const dif_triangle_options* options) {
  dif_triangle_options defaults{};
  dif_triangle_options_init(&defaults, sizeof defaults);
  const dif_triangle_options given = capi::read_struct(options, defaults, "options");
  difmesh::FractionsFromMeshOptions result;
  result.overlaps =
      capi::to_choice(given.overlaps, difmesh::Overlaps::unite, difmesh::kOverlaps, "overlaps");
  result.tolerance = given.tolerance;
  result.flip = capi::to_bool(given.flip, "flip");
  result.check_edges = capi::to_bool(given.check_edges, "check_edges");
  result.threads = given.threads;
  result.progress = capi::to_progress(given.progress, given.progress_user);
  return result;
}

dif_triangle_report to_report(const difmesh::FractionsFromMeshReport& report) {
  dif_triangle_report result{};
  result.pieces = report.pieces;
  result.cells_touched = report.cells_touched;
  result.lowest_raw = report.lowest_raw;
  result.highest_raw = report.highest_raw;
  result.largest_gap = report.largest_gap;
  result.fraction_volume = report.fraction_volume;
  result.mesh_volume = report.mesh_volume;
  result.seconds = report.seconds.total;
  result.overlap_volume = report.overlap.volume;
  result.overlap_cells = report.overlap.cells;
  result.largest_overlap = report.overlap.largest;
  std::copy_n(report.overlap.cell.data(), 3, result.overlap_cell);
  std::copy_n(report.overlap.low.data(), 3, result.overlap_low);
  std::copy_n(report.overlap.high.data(), 3, result.overlap_high);
  result.inverted_volume = report.inverted.volume;
  result.inverted_cells = report.inverted.cells;
  result.undecided_volume = report.undecided.volume;
  result.undecided_cells = report.undecided.cells;
  result.largest_undecided = report.undecided.largest;
  std::copy_n(report.undecided.cell.data(), 3, result.undecided_cell);
  return result;
}

/// Gives the caller what was computed; the report first, for it may be refused.
template <class Result, class CReport>
void hand_over(const Result& result, CReport* report, double* fractions) {
  if (report != nullptr) {
    capi::write_output(report, to_report(result.report), "report");
  }
  std::copy(result.fractions.begin(), result.fractions.end(), fractions);
}

/// A report that cannot be written is refused before the work.
template <class CReport>
void check_report(const CReport* report) {
  if (report != nullptr) {
    capi::check_output(report, "report");
  }
}

}  // namespace

dif_status dif_grid_init(dif_grid* grid, uint64_t struct_size, const int64_t dims[3]) {
  return capi::guarded([&] {
    capi::required(dims, "dims");
    validate(difmesh::Grid{.dims = {dims[0], dims[1], dims[2]}});
    dif_grid value{};
    std::copy_n(dims, 3, value.dims);
    std::fill_n(value.spacing, 3, 1.0);
    capi::write_struct(grid, struct_size, value, "grid");
  });
}

dif_status dif_function_options_init(dif_function_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    const difmesh::FractionsFromFunctionOptions defaults;
    dif_function_options value{};
    value.tolerance = defaults.tolerance;
    value.kink_tolerance = defaults.kink_tolerance;
    value.max_calls_per_cell = defaults.max_calls_per_cell;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_function_report_init(dif_function_report* report, uint64_t struct_size) {
  return capi::guarded(
      [&] { capi::write_struct(report, struct_size, dif_function_report{}, "report"); });
}

dif_status dif_triangle_options_init(dif_triangle_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    const difmesh::FractionsFromMeshOptions defaults;
    dif_triangle_options value{};
    value.tolerance = defaults.tolerance;
    value.flip = defaults.flip ? 1 : 0;
    value.check_edges = defaults.check_edges ? 1 : 0;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_triangle_report_init(dif_triangle_report* report, uint64_t struct_size) {
  return capi::guarded(
      [&] { capi::write_struct(report, struct_size, dif_triangle_report{}, "report"); });
}

dif_status dif_fractions_from_function(const dif_grid* grid, dif_function f, void* user,
                                       const dif_function_options* options,
                                       dif_function_report* report, double* fractions) {
  return capi::guarded([&] {
    const difmesh::Grid cells = capi::to_grid(grid);
    if (f == nullptr) {
      capi::fail_argument("argument 'f' is NULL");
    }
    capi::required(fractions, "fractions");
    check_report(report);
    hand_over(fractions_from_function(cells, to_function(f, user), to_options(options)), report,
              fractions);
  });
}

dif_status dif_fractions_from_shape(const dif_grid* grid, const dif_shape* shape,
                                    const dif_function_options* options,
                                    dif_function_report* report, double* fractions) {
  return capi::guarded([&] {
    const difmesh::Grid cells = capi::to_grid(grid);
    const difmesh::Shape& body = capi::required(shape, "shape").shape;
    capi::required(fractions, "fractions");
    check_report(report);
    difmesh::FractionsFromFunctionOptions given = to_options(options);
    if (given.gradient) {
      capi::fail_argument("options: gradient must be NULL, shapes have their own");
    }
    hand_over(fractions_from_shape(cells, body, given), report, fractions);
  });
}

dif_status dif_fractions_from_mesh(const dif_grid* grid, const dif_mesh* mesh,
                                   const dif_triangle_options* options, dif_triangle_report* report,
                                   double* fractions) {
  return capi::guarded([&] {
    const difmesh::Grid cells = capi::to_grid(grid);
    const difmesh::Mesh& body = capi::required(mesh, "mesh").mesh;
    capi::required(fractions, "fractions");
    check_report(report);
    hand_over(fractions_from_mesh(cells, body.positions, body.triangles, to_options(options)),
              report, fractions);
  });
}
