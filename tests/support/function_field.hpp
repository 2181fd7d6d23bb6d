#pragma once
/// \file function_field.hpp
/// What the tests of fractions_from_function() share.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "difmesh/fractions_from_function.hpp"

namespace difmesh::test {

/// Calls check(cell, index) for all cells.
template <class Check>
void for_cells(const Grid& grid, const Check& check) {
  std::size_t index = 0;
  for (std::int64_t k = 0; k < grid.dims[2]; ++k) {
    for (std::int64_t j = 0; j < grid.dims[1]; ++j) {
      for (std::int64_t i = 0; i < grid.dims[0]; ++i) {
        check(Index3{i, j, k}, index++);
      }
    }
  }
}

/// [-half, half]^3.
[[nodiscard]] inline Grid cube_grid(std::int64_t cells, double half) {
  const double spacing = 2.0 * half / static_cast<double>(cells);
  return {{cells, cells, cells}, {-half, -half, -half}, {spacing, spacing, spacing}};
}

[[nodiscard]] inline double distance_between(const Vec3& p, const Vec3& c) {
  return std::sqrt((p[0] - c[0]) * (p[0] - c[0]) + (p[1] - c[1]) * (p[1] - c[1]) +
                   (p[2] - c[2]) * (p[2] - c[2]));
}

[[nodiscard]] inline FunctionBatch sphere_by_distance(const Vec3& c, double radius) {
  return batch_of([=](const Vec3& p) { return distance_between(p, c) - radius; });
}

[[nodiscard]] inline FunctionBatch sphere_by_square(const Vec3& c, double radius) {
  return batch_of([=](const Vec3& p) {
    const double d = distance_between(p, c);
    return d * d - radius * radius;
  });
}

}  // namespace difmesh::test
