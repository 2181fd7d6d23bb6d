#include "placement/manson.hpp"

#include <cmath>
#include <optional>

#include "placement/linear.hpp"
#include "placement/placement.hpp"

namespace difmesh::detail {
namespace {

// The line cuts a corner off the cell with fraction `cut` <= 1/2; `other` >= 1/2 is its
// neighbour's. Position from the cut cell, or nothing where the line does not run that way. The
// denominator is 4 (√(cut + other) - √cut)² and least for halves: 4 (1 - √½)² = 0.34.
std::optional<double> corner_cut(double cut, double other) {
  if (!(cut > 0.0)) {
    return std::nullopt;
  }
  const double s = std::sqrt(1.0 + other / cut) - 1.0;
  const double b = 2.0 * cut * s;
  if (s < 1.0 || b * (1.0 + s) > 1.0) {
    return std::nullopt;
  }
  return 1.0 -
         (2.0 * other - 1.0) / (8.0 * cut + 4.0 * other - 8.0 * std::sqrt(cut * (cut + other)));
}

}  // namespace

double manson_position(double outer, double inner) {
  const double outer_rest = 1.0 - outer;
  const double inner_rest = 1.0 - inner;
  if (inner <= 3.0 * outer && outer_rest <= 3.0 * inner_rest) {
    return linear_position(outer, inner);
  }
  if (const auto position = corner_cut(outer, inner)) {
    return *position;
  }
  // The complement is cut in the inner cell: the same seen from the other side.
  if (const auto position = corner_cut(inner_rest, outer_rest)) {
    return 1.0 - *position;
  }
  return 1.5 - outer - inner;
}

const PlacementPart kManson{false, false, 1, place_each<manson_position>};

}  // namespace difmesh::detail
