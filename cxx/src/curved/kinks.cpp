#include "curved/kinks.hpp"

#include <algorithm>
#include <cmath>

namespace difmesh::detail {
namespace {

constexpr double kNear = 1.6;         // cells
constexpr double kLeastApart = 0.02;  // distances that are no kink, in the unit of the cell,
constexpr double kApartByBend = 0.6;  // or up to this times the square of the bend
constexpr double kFlat = 0.4;         // bends at which each cell should own a surface

}  // namespace

bool is_kinked(const SurfaceTable& table, const Index3& cell, const OwnedSurface& surface) {
  const BlockField& field = table.field();
  const double own_length = table.length(cell);
  const Vec3 size = field.cell_size(cell);
  const Vec3 foot = scaled(foot_of(surface), own_length);
  double apart = 0.0;
  double bend = 0.0;
  bool is_bare = false;
  for (int n = 0; n < 27; ++n) {
    const Index3 steps{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    const Index3 other{cell[0] + steps[0], cell[1] + steps[1], cell[2] + steps[2]};
    const SurfaceAt there = table.at(other);
    if (there.ownership != Ownership::bare && there.ownership != Ownership::owned) {
      continue;
    }
    Vec3 seen;  // the foot from the other cell's centre
    double square = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      seen[axis] = foot[axis] - centre_distance(field, axis, cell[axis], steps[axis]);
      square += seen[axis] * seen[axis] / (size[axis] * size[axis]);
    }
    if (square > kNear * kNear) {
      continue;
    }
    if (there.ownership == Ownership::bare) {
      is_bare = true;
      continue;
    }
    const double length = table.length(other);
    apart = std::max(apart, std::abs(there.surface.function(scaled(seen, 1.0 / length))) *
                                (length / own_length));
    bend = std::max(bend, there.surface.bend);
  }
  return apart > std::max(kLeastApart, kApartByBend * bend * bend) || (is_bare && bend < kFlat);
}

}  // namespace difmesh::detail
