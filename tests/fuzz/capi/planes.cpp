// dif_cell_planes(), dif_plane_fraction() and dif_plane_offset(): planes alone. And the curved
// surfaces of the same cells.

#include <algorithm>
#include <cmath>

#include "calls.hpp"
#include "drawn.hpp"

namespace difmesh::fuzz {
namespace {

/// The planes of a few cells, each element of which the call must write.
struct Planes {
  std::vector<double> normals;
  std::vector<double> offsets;
  std::vector<std::int32_t> sources;

  explicit Planes(std::size_t count)
      : normals(3 * count, -9.0), offsets(count, -9.0), sources(count, -9) {}
};

void check_plane(const double* normal, double offset, std::int32_t source) {
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  demand(source >= DIF_SOURCE_NONE && source <= DIF_SOURCE_LEAST_SQUARES);
  demand(source == DIF_SOURCE_NONE ? length == 0.0 : std::abs(length - 1.0) < 1e-12);
  demand(std::isfinite(offset));
}

std::vector<std::int64_t> draw_cells(Input& input, const std::int64_t (&dims)[3]) {
  std::vector<std::int64_t> cells(static_cast<std::size_t>(3 * (1 + input.number(8))));
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const std::int64_t count = dims[n % 3];
    const std::uint8_t value = input.byte();
    cells[n] = value == 255   ? static_cast<std::int64_t>(input.word())
               : value == 254 ? count
                              : value % count;
  }
  return cells;
}

bool all_inside(const std::vector<std::int64_t>& cells, const std::int64_t (&dims)[3]) {
  for (std::size_t n = 0; n < cells.size(); ++n) {
    if (cells[n] < 0 || cells[n] >= dims[n % 3]) {
      return false;
    }
  }
  return true;
}

/// dif_field_planes() gives interfacial cells the same planes.
void compare_with_field(const Field& field, const dif_options& options,
                        const std::vector<std::int64_t>& cells, const Planes& planes) {
  const std::int64_t(&dims)[3] = field.c().dims;
  Planes all(static_cast<std::size_t>(field.cells()));
  dif_plane_arrays arrays = prepared(dif_plane_arrays_init);
  arrays.offset = all.offsets.data();
  arrays.source = all.sources.data();
  arrays.strides[0] = 1;
  arrays.strides[1] = dims[0];
  arrays.strides[2] = dims[0] * dims[1];
  if (dif_field_planes(&field.c(), &options, &arrays) != DIF_OK) {
    return;  // a bad value anywhere
  }
  for (std::size_t n = 0; n < planes.offsets.size(); ++n) {
    const auto at = static_cast<std::size_t>(
        (cells[3 * n + 2] * dims[1] + cells[3 * n + 1]) * dims[0] + cells[3 * n]);
    if (all.sources[at] != DIF_SOURCE_NONE) {
      demand(all.sources[at] == planes.sources[n] && all.offsets[at] == planes.offsets[n]);
    }
  }
}

/// A unit normal and ordered curvatures, or no surface; dif_cell_curvature() says the same.
void check_surfaces(const Field& field, const dif_options& options,
                    const std::vector<std::int64_t>& cells) {
  const std::size_t count = cells.size() / 3;
  std::vector<std::int32_t> sources(count, -9);
  std::vector<double> normals(3 * count, -9.0);
  std::vector<double> mean(count, -9.0);
  std::vector<double> largest(count, -9.0);
  std::vector<double> smallest(count, -9.0);
  dif_surface_arrays arrays = prepared(dif_surface_arrays_init);
  arrays.source = sources.data();
  arrays.normal = normals.data();
  arrays.mean = mean.data();
  arrays.largest = largest.data();
  arrays.smallest = smallest.data();
  demand(dif_cell_surfaces(&field.c(), &options, DIF_SURFACES_FOR_CURVATURE,
                           static_cast<std::int64_t>(count), cells.data(), &arrays) == DIF_OK);
  std::vector<double> all(static_cast<std::size_t>(field.cells()), -9.0);
  const bool is_good = dif_cell_curvature(&field.c(), &options, all.data(), nullptr) == DIF_OK;
  const std::int64_t(&dims)[3] = field.c().dims;
  for (std::size_t n = 0; n < count; ++n) {
    const bool is_there = sources[n] != DIF_SURFACE_NONE;
    const double* const normal = &normals[3 * n];
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    demand(sources[n] >= DIF_SURFACE_NONE && sources[n] <= DIF_SURFACE_QUARTIC_FIT);
    demand(is_there ? std::abs(length - 1.0) < 1e-12 : length == 0.0);
    demand(is_there ? largest[n] >= smallest[n] : std::isnan(mean[n]));
    const double one = all[static_cast<std::size_t>(
        (cells[3 * n + 2] * dims[1] + cells[3 * n + 1]) * dims[0] + cells[3 * n])];
    demand(!is_good || one == (is_there ? mean[n] : 0.0) || (!is_there && std::isnan(one)));
  }
}

}  // namespace

void call_cell_planes(Input& input) {
  Field field(input, 64);
  dif_options options = draw_options(input, field);
  const std::vector<std::int64_t> cells = draw_cells(input, field.c().dims);
  Watch watch(input);
  field.fill(input);
  Planes planes(cells.size() / 3);
  dif_options watched = options;
  watch.attend(watched);
  const dif_status status = dif_cell_planes(
      &field.c(), &watched, static_cast<std::int64_t>(planes.offsets.size()), cells.data(),
      planes.normals.data(), planes.offsets.data(), planes.sources.data());
  demand_honest(status);
  watch.check(status);
  if (status != DIF_OK) {
    return;
  }
  demand(all_inside(cells, field.c().dims));
  for (std::size_t n = 0; n < planes.offsets.size(); ++n) {
    check_plane(&planes.normals[3 * n], planes.offsets[n], planes.sources[n]);
  }
  compare_with_field(field, options, cells, planes);
  check_surfaces(field, options, cells);
}

void call_plane_numbers(Input& input) {
  const auto count = static_cast<std::size_t>(1 + input.number(6));
  const double spacing[3] = {input.number_or_any(1.0), input.number_or_any(2.0),
                             input.number_or_any(0.5)};
  const bool usual = spacing[0] == 1.0 && spacing[1] == 2.0 && spacing[2] == 0.5;
  std::vector<double> normals(3 * count);
  std::vector<double> given(count);
  for (double& number : normals) {
    number = input.number_or_any((input.byte() - 128) / 64.0);
  }
  for (double& number : given) {
    number = input.number_or_any(input.fraction());
  }
  std::vector<double> results(count, -9.0);
  std::vector<double> again(count, -9.0);
  const auto n = static_cast<std::int64_t>(count);
  const dif_status offsets =
      dif_plane_offset(spacing, n, normals.data(), given.data(), results.data());
  demand_honest(offsets);
  const dif_status fractions =
      dif_plane_fraction(spacing, n, normals.data(), results.data(), again.data());
  demand_honest(fractions);
  if (offsets != DIF_OK || fractions != DIF_OK) {
    return;
  }
  for (std::size_t at = 0; at < count; ++at) {
    demand(again[at] >= 0.0 && again[at] <= 1.0);
    const double length = std::hypot(normals[3 * at], normals[3 * at + 1], normals[3 * at + 2]);
    if (usual && length > 1e-100 && length < 1e100) {
      demand(std::abs(again[at] - std::clamp(given[at], 0.0, 1.0)) <= 1e-14);
    }
  }
}

}  // namespace difmesh::fuzz
