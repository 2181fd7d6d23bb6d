#pragma once
/// \file shape_fields.hpp
/// Fractions of built-in shapes, and errors against their closed forms.

#include <algorithm>
#include <cmath>

#include "difmesh/fractions_from_function.hpp"
#include "difmesh/shapes.hpp"
#include "support/fields.hpp"

namespace difmesh::test {

inline Shape ball(const Vec3& centre, double radius) {
  ShapeOptions options;
  options.kind = shape_kind("sphere");
  options.centre = centre;
  options.radius = radius;
  return make_shape(options);
}

inline OwnedField fractions_of(const Grid& grid, const Shape& shape, double tolerance) {
  FractionsFromFunctionOptions options;
  options.tolerance = tolerance;
  const FractionsFromFunction made = fractions_from_shape(grid, shape, options);
  OwnedField field(grid.dims);
  std::copy(made.fractions.begin(), made.fractions.end(), field.values.begin());
  return field;
}

/// Their root mean square and the largest.
struct ErrorSums {
  double squares = 0.0;
  double count = 0.0;
  double most = 0.0;

  void add(double error) {
    squares += error * error;
    count += 1.0;
    most = std::max(most, std::abs(error));
  }
  [[nodiscard]] double rms() const { return std::sqrt(squares / count); }
};

}  // namespace difmesh::test
