#include "support/algorithm1.hpp"

#include <algorithm>
#include <cmath>

#include "support/box_clip.hpp"
#include "support/vec3.hpp"

namespace difmesh::test {
namespace {

/// The part of the window centred at mu that lies in a cell, relative to that cell's centre. The
/// outer cell's centre is at 0, the inner one's at 1; a cell spans ½ to both sides.
Box part_of_window(const CrossedEdge& edge, double mu, bool inner) {
  const double cell = inner ? 1.0 : 0.0;
  const double low = std::max(mu - 0.5, cell - 0.5) - cell;
  const double high = std::min(mu + 0.5, cell + 0.5) - cell;
  Box box{scaled(edge.spacing, -0.5), scaled(edge.spacing, 0.5)};
  const auto axis = static_cast<std::size_t>(edge.axis);
  const double reach = edge.direction * edge.spacing[axis];
  box.low[axis] = std::min(reach * low, reach * high);
  box.high[axis] = std::max(reach * low, reach * high);
  return box;
}

long double filled_volume(const CrossedEdge& edge, double mu, bool inner) {
  const double fraction = inner ? edge.inner_fraction : edge.outer_fraction;
  const Plane& plane = inner ? edge.inner_plane : edge.outer_plane;
  const Box box = part_of_window(edge, mu, inner);
  const Vec3 size = subtract(box.high, box.low);
  const long double all = static_cast<long double>(size[0]) * size[1] * size[2];
  if (!(all > 0.0L) || fraction <= 0.0) {
    return 0.0L;
  }
  return fraction >= 1.0 ? all : all * clipped_share(box, plane.normal, plane.offset);
}

/// Offset of the plane that fills the given share of the cuboid: regula falsi on the clipped share
/// with the Illinois weights.
double offset_by_bracketing(const Vec3& spacing, const Vec3& normal, double share) {
  const double reach = 0.5 * (std::abs(normal[0]) * spacing[0] + std::abs(normal[1]) * spacing[1] +
                              std::abs(normal[2]) * spacing[2]);
  long double low = -reach;
  long double high = reach;
  long double f_low = -share;
  long double f_high = 1.0L - share;
  int last_side = 0;
  for (int step = 0; step < 200 && high - low > 1e-17L * reach; ++step) {
    const long double x = (low * f_high - high * f_low) / (f_high - f_low);
    const long double f = clipped_share(spacing, normal, static_cast<double>(x)) - share;
    if (std::abs(f) <= 1e-17L) {
      return static_cast<double>(x);
    }
    const int side = f > 0.0L ? 1 : -1;
    (side > 0 ? high : low) = x;
    (side > 0 ? f_high : f_low) = f;
    if (side == last_side) {
      (side > 0 ? f_low : f_high) *= 0.5L;
    }
    last_side = side;
  }
  return static_cast<double>(0.5L * (low + high));
}

/// Manson's case of a corner cut in the outer cell: holds for `holds`, at `mu`.
struct CornerCut {
  bool holds = false;
  double mu = 0.0;
};
CornerCut corner_cut(double outer, double inner) {
  if (outer <= 0.0) {
    return {};
  }
  const double a = 1.0 / (std::sqrt(1.0 + inner / outer) - 1.0);
  const double b = 2.0 * outer / a;
  const double divisor = 8.0 * outer + 4.0 * inner - 8.0 * std::sqrt(outer * (outer + inner));
  return {a <= 1.0 && b * (1.0 + 1.0 / a) <= 1.0, 1.0 - (2.0 * inner - 1.0) / divisor};
}

double manson(double outer, double inner) {
  const double outer_void = 1.0 - outer;
  const double inner_void = 1.0 - inner;
  if (inner <= 3.0 * outer && outer_void <= 3.0 * inner_void) {
    return (0.5 - outer) / (inner - outer);
  }
  if (const CornerCut cut = corner_cut(outer, inner); cut.holds) {
    return cut.mu;
  }
  if (const CornerCut cut = corner_cut(inner_void, outer_void); cut.holds) {
    return 1.0 - cut.mu;
  }
  return 1.5 - outer - inner;
}

}  // namespace

double initial_guess(Guess guess, double outer_fraction, double inner_fraction) {
  double mu = 0.5;
  if (guess == Guess::linear) {
    mu = (0.5 - outer_fraction) / (inner_fraction - outer_fraction);
  } else if (guess == Guess::manson) {
    mu = manson(outer_fraction, inner_fraction);
  }
  return std::clamp(mu, 0.0, 1.0);
}

double window_fraction(const CrossedEdge& edge, double mu) {
  const long double whole =
      static_cast<long double>(edge.spacing[0]) * edge.spacing[1] * edge.spacing[2];
  return static_cast<double>((filled_volume(edge, mu, false) + filled_volume(edge, mu, true)) /
                             whole);
}

Algorithm1Result algorithm1(const CrossedEdge& edge, double start, double tolerance, int cap) {
  const auto axis = static_cast<std::size_t>(edge.axis);
  Algorithm1Result result;
  result.mu = start;
  bool settled = false;
  while (result.steps < cap) {
    const Vec3 normal = add(scaled(edge.outer_plane.normal, 1.0 - result.mu),
                            scaled(edge.inner_plane.normal, result.mu));
    const double along = edge.direction * edge.spacing[axis] * normal[axis];
    const double share = window_fraction(edge, result.mu);
    const double offset = offset_by_bracketing(edge.spacing, normal, share);
    const double next = std::clamp(result.mu + offset / along, 0.0, 1.0);
    settled = std::abs(next - result.mu) < tolerance;
    result.mu = next;
    ++result.steps;
    if (settled || std::isnan(next)) {
      break;
    }
  }
  result.converged = settled && std::abs(window_fraction(edge, result.mu) - 0.5) < 10.0 * tolerance;
  return result;
}

}  // namespace difmesh::test
