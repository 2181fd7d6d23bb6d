#include <algorithm>
#include <cmath>
#include <string>

#include "boundary.hpp"
#include "cell_lists.hpp"
#include "convert.hpp"
#include "difmesh/cell_planes.hpp"
#include "difmesh/plane.hpp"

namespace capi = difmesh::capi;

namespace {

using difmesh::CellPlane;
using difmesh::Index3;
using difmesh::NormalSource;
using difmesh::Vec3;

// Cells of which planes are computed before they are written out; bounds the extra memory.
constexpr std::size_t kCellsAtOnce = std::size_t{1} << 20;
// Of dif_field_planes(): share of the time that finding the cells takes.
constexpr double kShareOfListing = 0.3;

Vec3 checked_spacing(const double* spacing) {
  capi::required(spacing, "spacing");
  const difmesh::Grid cell{.dims = {1, 1, 1}, .spacing = {spacing[0], spacing[1], spacing[2]}};
  validate(cell);
  return cell.spacing;
}

void check_plane(std::size_t index, const Vec3& normal, double other, const char* name) {
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (!std::isfinite(length) || length == 0.0) {
    capi::fail_argument("normal " + std::to_string(index) + " is 0 or not finite");
  }
  if (!std::isfinite(other)) {
    capi::fail_argument(std::string(name) + " " + std::to_string(index) + " is not finite");
  }
}

constexpr std::int32_t to_source(NormalSource source) {
  return static_cast<std::int32_t>(source);
}
static_assert(to_source(NormalSource::none) == DIF_SOURCE_NONE &&
              to_source(NormalSource::youngs) == DIF_SOURCE_YOUNGS &&
              to_source(NormalSource::centred_columns) == DIF_SOURCE_CENTRED_COLUMNS &&
              to_source(NormalSource::height_function) == DIF_SOURCE_HEIGHT_FUNCTION &&
              to_source(NormalSource::least_squares) == DIF_SOURCE_LEAST_SQUARES);

/// Runs cell_planes() over a list, and hands each portion over with the index of its first cell.
template <class Consume>
void for_planes(const capi::Field& field, const capi::CellWork& work,
                const difmesh::Options& options, const Consume& consume) {
  capi::for_portions<CellPlane>(
      work, options,
      [&](std::span<const Index3> cells, const difmesh::Options& given,
          std::span<CellPlane> planes) {
        cell_planes(field.view, field.grid, cells, given, planes);
      },
      consume);
}

struct PlaneArrays {
  std::array<double*, 4> numbers;  ///< normal in x, y, z, and offset
  std::int32_t* source;
  Index3 strides;

  void set(const Index3& cell, const CellPlane& plane) const {
    const std::int64_t at = cell[0] * strides[0] + cell[1] * strides[1] + cell[2] * strides[2];
    const std::array<double, 4> values{plane.plane.normal[0], plane.plane.normal[1],
                                       plane.plane.normal[2], plane.plane.offset};
    for (std::size_t n = 0; n < 4; ++n) {
      if (numbers[n] != nullptr) {
        numbers[n][at] = values[n];
      }
    }
    if (source != nullptr) {
      source[at] = to_source(plane.source);
    }
  }
  void clear(const Index3& dims) const {
    for (std::int64_t k = 0; k < dims[2]; ++k) {
      for (std::int64_t j = 0; j < dims[1]; ++j) {
        for (std::int64_t i = 0; i < dims[0]; ++i) {
          set({i, j, k}, {});
        }
      }
    }
  }
};

PlaneArrays to_arrays(const dif_plane_arrays* arrays, const Index3& dims) {
  capi::required(arrays, "arrays");
  const dif_plane_arrays given = capi::read_struct(arrays, dif_plane_arrays{}, "arrays");
  const PlaneArrays result{{given.normal_x, given.normal_y, given.normal_z, given.offset},
                           given.source,
                           capi::to_index(given.strides)};
  capi::check_result_strides(dims, result.strides, sizeof(double), "arrays");
  return result;
}

}  // namespace

dif_status dif_plane_fraction(const double spacing[3], int64_t count, const double* normals,
                              const double* offsets, double* fractions) {
  return capi::guarded([&] {
    const Vec3 edges = checked_spacing(spacing);
    capi::required_array(offsets, count, "offsets");
    capi::required_array(fractions, count, "fractions");
    const auto vectors = capi::to_points(capi::required_array(normals, count, "normals"), count);
    for (std::size_t n = 0; n < vectors.size(); ++n) {
      check_plane(n, vectors[n], offsets[n], "offset");
      fractions[n] = difmesh::plane_fraction(vectors[n], edges, offsets[n]);
    }
  });
}

dif_status dif_plane_offset(const double spacing[3], int64_t count, const double* normals,
                            const double* fractions, double* offsets) {
  return capi::guarded([&] {
    const Vec3 edges = checked_spacing(spacing);
    capi::required_array(fractions, count, "fractions");
    capi::required_array(offsets, count, "offsets");
    const auto vectors = capi::to_points(capi::required_array(normals, count, "normals"), count);
    for (std::size_t n = 0; n < vectors.size(); ++n) {
      check_plane(n, vectors[n], fractions[n], "fraction");
      offsets[n] = difmesh::plane_offset(vectors[n], edges, fractions[n]);
    }
  });
}

dif_status dif_plane_arrays_init(dif_plane_arrays* arrays, uint64_t struct_size) {
  return capi::guarded(
      [&] { capi::write_struct(arrays, struct_size, dif_plane_arrays{}, "arrays"); });
}

dif_status dif_cell_planes(const dif_field* field, const dif_options* options, int64_t count,
                           const int64_t* cells, double* normals, double* offsets,
                           int32_t* sources) {
  return capi::guarded([&] {
    const capi::Field source = capi::to_field(field);
    const auto list = capi::to_cells(cells, count, source.grid.dims);
    for_planes(source, {list, kCellsAtOnce}, capi::to_options(options),
               [&](std::size_t begin, std::span<const CellPlane> planes) {
                 for (std::size_t n = 0; n < planes.size(); ++n) {
                   const auto& [plane, from] = planes[n];
                   if (normals != nullptr) {
                     std::copy_n(plane.normal.begin(), 3, normals + 3 * (begin + n));
                   }
                   if (offsets != nullptr) {
                     offsets[begin + n] = plane.offset;
                   }
                   if (sources != nullptr) {
                     sources[begin + n] = to_source(from);
                   }
                 }
               });
  });
}

dif_status dif_field_planes(const dif_field* field, const dif_options* options,
                            const dif_plane_arrays* arrays) {
  return capi::guarded([&] {
    const capi::Field source = capi::to_field(field);
    const PlaneArrays results = to_arrays(arrays, source.grid.dims);
    const difmesh::Options given = capi::to_options(options);
    const auto cells = capi::list_interfacial(source, given, kShareOfListing);
    results.clear(source.grid.dims);
    for_planes(source, {cells, kCellsAtOnce, kShareOfListing}, given,
               [&](std::size_t begin, std::span<const CellPlane> planes) {
                 for (std::size_t n = 0; n < planes.size(); ++n) {
                   results.set(cells[begin + n], planes[n]);
                 }
               });
  });
}

dif_status dif_interfacial_cells(const dif_field* field, const dif_options* options,
                                 int64_t capacity, int64_t* cells, int64_t* count) {
  return capi::guarded([&] {
    const capi::Field source = capi::to_field(field);
    capi::required(count, "count");
    capi::required_array(cells, capacity, "cells");
    const auto found = interfacial_cells(source.view, source.grid, capi::to_options(options));
    const std::size_t room = std::min(capi::to_size(capacity), found.size());
    for (std::size_t n = 0; n < room; ++n) {
      std::copy(found[n].begin(), found[n].end(), cells + 3 * n);
    }
    *count = static_cast<std::int64_t>(found.size());
    if (cells != nullptr && room < found.size()) {
      capi::fail_argument("there are " + std::to_string(found.size()) +
                          " interfacial cells, but capacity is " + std::to_string(capacity));
    }
  });
}
