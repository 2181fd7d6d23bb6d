#include "surface/curved_edge.hpp"

#include <algorithm>
#include <cmath>

#include "base/vector3.hpp"

namespace difmesh::detail {
namespace {

// How much the surfaces have to say next to a kink, beside the window.
constexpr double kKinkedShare = 0.5;

}  // namespace

CurvedEdge::CurvedEdge(const SurfaceTable& table, const DualGrid& grid, const DualEdge& edge)
    : axis_(edge.axis) {
  const BlockField& field = table.field();
  const NodePlace low = place_of(field, edge.lower);
  const NodePlace high = place_of(field, edge.upper);
  lower_ = end_at(table, low, grid.nodes().test(edge.lower));
  upper_ = end_at(table, high, grid.nodes().test(edge.upper));
  if (low.cell == high.cell) {
    // From the centre to a face, or between faces: the one cell's surface as it is.
    extent_ = high.from_centre[axis_] - low.from_centre[axis_];
    upper_.ownership = Ownership::pure;
  } else if (field.grid.is_uniform(axis_)) {
    extent_ = field.grid.spacing[axis_];
  } else {
    extent_ = grid.coordinate(axis_, edge.upper[axis_]) - grid.coordinate(axis_, edge.lower[axis_]);
  }
}

CurvedEdge::End CurvedEdge::end_at(const SurfaceTable& table, const NodePlace& place, bool inside) {
  const SurfaceAt there = table.at(place.cell);
  return {there.ownership, there.surface, place.from_centre, table.length(place.cell), inside};
}

// Of a point of the edge from the lower node, `along` it from this end.
Vec3 CurvedEdge::seen_from(const End& end, double along) const {
  Vec3 x = end.node;
  x[axis_] += along;
  return scaled(x, 1.0 / end.length);
}

double CurvedEdge::function_of(const End& end, double along) const {
  return end.surface.function(seen_from(end, along)) *
         (end.length == lower_.length ? 1.0 : end.length / lower_.length);
}

bool CurvedEdge::contradicts(const End& end) const {
  return end.owns() && (end.surface.function(seen_from(end, 0.0)) <= kOnNode) != end.inside;
}

double CurvedEdge::upper_weight(double share) const {
  if (!lower_.owns() || !upper_.owns()) {
    return lower_.owns() ? 0.0 : 1.0;
  }
  return blend(share);
}

double CurvedEdge::at(double share) const {
  const double weight = upper_weight(share);
  double value = 0.0;
  if (lower_.owns()) {
    value += (1.0 - weight) * function_of(lower_, share * extent_);
  }
  if (upper_.owns()) {
    value += weight * function_of(upper_, (share - 1.0) * extent_);
  }
  return value;
}

// Between 0 and 1, at which the function has the values `low` and `high` of different sign: by
// chords, of which none stays at one end.
double CurvedEdge::root(double low, double high) const {
  constexpr int kMostSteps = 60;
  constexpr double kSettled = 1e-14;
  double from = 0.0;
  double to = 1.0;
  double share = 0.5;
  int moved = 0;
  for (int step = 0; step < kMostSteps && to - from >= kSettled; ++step) {
    share = (from * high - to * low) / (high - low);
    const double value = at(share);
    if (!(std::abs(value) >= kSettled)) {
      break;
    }
    if ((value <= 0.0) == (low <= 0.0)) {
      from = share;
      low = value;
      high = moved == 1 ? 0.5 * high : high;
      moved = 1;
    } else {
      to = share;
      high = value;
      low = moved == -1 ? 0.5 * low : low;
      moved = -1;
    }
  }
  return share;
}

bool CurvedEdge::place(double window, double& share) const {
  if ((!lower_.owns() && !upper_.owns()) || contradicts(lower_) || contradicts(upper_)) {
    return false;
  }
  const double low = at(0.0);
  const double high = at(1.0);
  const bool is_low_right = (low <= kOnNode) == lower_.inside;
  const bool is_high_right = (high <= kOnNode) == upper_.inside;
  const bool owns_both = lower_.owns() && upper_.owns();
  if (is_low_right && is_high_right) {
    // Equal signs: one is within rounding of 0.
    share = (low <= 0.0) == (high <= 0.0) ? (lower_.inside ? 0.0 : 1.0) : root(low, high);
  } else if (owns_both && is_low_right != is_high_right) {
    share = is_high_right ? 0.0 : 1.0;
  } else {
    return false;
  }
  // A cell that should own a surface and does not: the other's is believed in its own half.
  const bool is_bare = lower_.ownership == Ownership::bare || upper_.ownership == Ownership::bare;
  if (is_bare && (lower_.owns() ? share > 0.5 : share < 0.5)) {
    return false;
  }
  if ((lower_.owns() && lower_.surface.is_kinked) || (upper_.owns() && upper_.surface.is_kinked)) {
    share = kKinkedShare * share + (1.0 - kKinkedShare) * window;
  }
  return true;
}

Vec3 CurvedEdge::normal(double share) const {
  const double weight = upper_weight(share);
  Vec3 sum{0.0, 0.0, 0.0};
  if (lower_.owns() && weight < 1.0) {
    const Vec3 gradient = lower_.surface.jet(seen_from(lower_, share * extent_)).gradient;
    sum = plus(sum, scaled(unit(gradient), 1.0 - weight));
  }
  if (upper_.owns() && weight > 0.0) {
    const Vec3 gradient = upper_.surface.jet(seen_from(upper_, (share - 1.0) * extent_)).gradient;
    sum = plus(sum, scaled(unit(gradient), weight));
  }
  const double size = length(sum);
  return size > 0.0 ? scaled(sum, 1.0 / size) : sum;
}

}  // namespace difmesh::detail
