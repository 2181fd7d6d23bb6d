#pragma once
/// \file grids.hpp
/// Grids with stretched axes, and tilted planes on grids of any kind.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "difmesh/edge_id.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/plane.hpp"
#include "support/fields.hpp"
#include "support/vec3.hpp"

namespace difmesh::test {

/// Widths that grow by a factor per cell, from the first one.
inline std::vector<double> growing(std::int64_t cells, double first, double factor, double from) {
  std::vector<double> faces{from};
  for (double width = first; static_cast<std::int64_t>(faces.size()) <= cells; width *= factor) {
    faces.push_back(faces.back() + width);
  }
  return faces;
}

/// Widths that grow by a fifth per cell, four times, and shrink again, between two ends.
inline std::vector<double> waving(std::int64_t cells, double low, double high) {
  std::vector<double> faces{0.0};
  for (std::int64_t n = 0; n < cells; ++n) {
    const std::int64_t place = n % 8;
    faces.push_back(faces.back() +
                    std::pow(1.2, static_cast<double>(place < 4 ? place : 8 - place)));
  }
  const double length = faces.back();
  for (double& face : faces) {
    face = low + (high - low) * (face / length);
  }
  return faces;
}

inline Grid grid_of(std::vector<double> x, std::vector<double> y, std::vector<double> z) {
  Grid grid;
  grid.faces = {std::move(x), std::move(y), std::move(z)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.dims[axis] = static_cast<std::int64_t>(grid.faces[axis].size()) - 1;
  }
  return grid;
}

template <class Action>
void for_each_cell(const Grid& grid, const Action& action) {
  for (std::int64_t k = 0; k < grid.dims[2]; ++k) {
    for (std::int64_t j = 0; j < grid.dims[1]; ++j) {
      for (std::int64_t i = 0; i < grid.dims[0]; ++i) {
        action(Index3{i, j, k});
      }
    }
  }
}

struct TiltedPlane {
  Vec3 normal;
  double offset;

  [[nodiscard]] OwnedField fractions(const Grid& grid) const {
    OwnedField field(grid.dims);
    for_each_cell(grid, [&](const Index3& cell) {
      field.at(cell[0], cell[1], cell[2]) = plane_fraction(
          normal, grid.cell_size(cell), offset - dot(normal, grid.cell_centre(cell)));
    });
    return field;
  }
};

inline Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vec3 v{normal(random), normal(random), normal(random)};
  return unit(v);
}

/// Whether a cell at an end of the edge has so little material, or lacks so little, that rounding
/// tells where its plane lies.
inline bool ends_in_sliver(const OwnedField& field, const DualEdgeName& edge) {
  for (const std::int64_t step : {0, 1}) {
    Index3 cell = edge.lower;
    cell[static_cast<std::size_t>(edge.axis)] += step;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell[axis] = std::clamp<std::int64_t>(cell[axis], 0, field.dims[axis] - 1);
    }
    const double fraction = field.at_cell(cell);
    const double lacking = std::min(fraction, 1.0 - fraction);
    if (lacking > 0.0 && lacking < 1e-8) {
      return true;
    }
  }
  return false;
}

}  // namespace difmesh::test
