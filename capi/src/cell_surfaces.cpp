#include "difmesh/cell_surfaces.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "boundary.hpp"
#include "cell_lists.hpp"
#include "convert.hpp"

namespace capi = difmesh::capi;

namespace {

using difmesh::CellSurface;
using difmesh::CellSurfaceKind;
using difmesh::CellSurfaceSource;
using difmesh::Index3;

constexpr std::size_t kCellsAtOnce = std::size_t{1} << 16;  // of 400 bytes each
// Of dif_cell_curvature(): share of the time that finding the cells takes.
constexpr double kShareOfListing = 0.1;

constexpr std::int32_t to_source(CellSurfaceSource source) {
  return static_cast<std::int32_t>(source);
}
static_assert(to_source(CellSurfaceSource::none) == DIF_SURFACE_NONE &&
              to_source(CellSurfaceSource::heights_13) == DIF_SURFACE_HEIGHTS_13 &&
              to_source(CellSurfaceSource::heights_25) == DIF_SURFACE_HEIGHTS_25 &&
              to_source(CellSurfaceSource::quadratic_fit) == DIF_SURFACE_QUADRATIC_FIT &&
              to_source(CellSurfaceSource::quartic_fit) == DIF_SURFACE_QUARTIC_FIT);

CellSurfaceKind to_kind(std::int32_t kind) {
  switch (kind) {
    case DIF_SURFACES_FOR_POSITION:
      return CellSurfaceKind::position;
    case DIF_SURFACES_FOR_CURVATURE:
      return CellSurfaceKind::curvature;
    default:
      capi::fail_argument("kind is " + std::to_string(kind) + "; 0 and 1 are possible");
  }
}

template <class T>
void put(T* array, std::size_t cell, T value) {
  if (array != nullptr) {
    array[cell] = value;
  }
}

template <std::size_t count>
void put(double* array, std::size_t cell, const std::array<double, count>& values) {
  if (array != nullptr) {
    std::copy(values.begin(), values.end(), array + count * cell);
  }
}

void put(const dif_surface_arrays& arrays, std::size_t cell, const CellSurface& surface) {
  put(arrays.source, cell, to_source(surface.source));
  put(arrays.axis, cell, std::int32_t{surface.axis});
  put(arrays.foot, cell, surface.foot);
  put(arrays.normal, cell, surface.normal);
  put(arrays.mean, cell, surface.mean);
  put(arrays.gaussian, cell, surface.gaussian);
  put(arrays.largest, cell, surface.largest);
  put(arrays.smallest, cell, surface.smallest);
  put(arrays.residual, cell, surface.residual);
  put(arrays.length, cell, surface.length);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(arrays.frame, 3 * cell + axis, surface.frame[axis]);
  }
  put(arrays.coefficients, cell, surface.coefficients);
}

void clear(double* array, const Index3& dims, const Index3& strides) {
  for (std::int64_t k = 0; k < dims[2]; ++k) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t i = 0; i < dims[0]; ++i) {
        array[i * strides[0] + j * strides[1] + k * strides[2]] = 0.0;
      }
    }
  }
}

/// \throw Error invalid_argument
Index3 to_strides(const std::int64_t* strides, const Index3& dims) {
  const Index3 result = strides == nullptr ? Index3{1, dims[0], dims[0] * dims[1]}
                                           : Index3{strides[0], strides[1], strides[2]};
  capi::check_result_strides(dims, result, sizeof(double), "strides");
  return result;
}

}  // namespace

dif_status dif_surface_arrays_init(dif_surface_arrays* arrays, uint64_t struct_size) {
  return capi::guarded(
      [&] { capi::write_struct(arrays, struct_size, dif_surface_arrays{}, "arrays"); });
}

dif_status dif_cell_surfaces(const dif_field* field, const dif_options* options, int32_t kind,
                             int64_t count, const int64_t* cells,
                             const dif_surface_arrays* arrays) {
  return capi::guarded([&] {
    const capi::Field source = capi::to_field(field);
    const CellSurfaceKind purpose = to_kind(kind);
    capi::required(arrays, "arrays");
    const dif_surface_arrays results = capi::read_struct(arrays, dif_surface_arrays{}, "arrays");
    const auto list = capi::to_cells(cells, count, source.grid.dims);
    capi::for_portions<CellSurface>(
        {list, kCellsAtOnce}, capi::to_options(options),
        [&](std::span<const Index3> part, const difmesh::Options& given,
            std::span<CellSurface> surfaces) {
          cell_surfaces(source.view, source.grid, part, purpose, given, surfaces);
        },
        [&](std::size_t begin, std::span<const CellSurface> surfaces) {
          for (std::size_t n = 0; n < surfaces.size(); ++n) {
            put(results, begin + n, surfaces[n]);
          }
        });
  });
}

dif_status dif_cell_curvature(const dif_field* field, const dif_options* options, double* mean,
                              const int64_t* strides) {
  return capi::guarded([&] {
    const capi::Field source = capi::to_field(field);
    capi::required(mean, "mean");
    const Index3 step = to_strides(strides, source.grid.dims);
    const difmesh::Options given = capi::to_options(options);
    const auto cells = capi::list_interfacial(source, given, kShareOfListing);
    clear(mean, source.grid.dims, step);
    capi::for_portions<CellSurface>(
        {cells, kCellsAtOnce, kShareOfListing}, given,
        [&](std::span<const Index3> part, const difmesh::Options& portion,
            std::span<CellSurface> surfaces) {
          cell_surfaces(source.view, source.grid, part, CellSurfaceKind::curvature, portion,
                        surfaces);
        },
        [&](std::size_t begin, std::span<const CellSurface> surfaces) {
          for (std::size_t n = 0; n < surfaces.size(); ++n) {
            const auto& [i, j, k] = cells[begin + n];
            mean[i * step[0] + j * step[1] + k * step[2]] = surfaces[n].mean;
          }
        });
  });
}
