#include "window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "unit_plane.hpp"

namespace difmesh::detail::window {
namespace {

// Wetted share of the cross-section of a cell at distance s from its centre along the edge.
double section(const EdgePlane& plane, double s) {
  return square_fraction(plane.across0, plane.across1, plane.a - plane.along * s);
}

// Wetted share of T that a cell contributes: its slab of the given width about s.
double slab(const EdgePlane& plane, double s, double width) {
  return width * cube_fraction(plane.along * width, plane.across0, plane.across1,
                               plane.a - plane.along * s);
}

// Shares and slopes below this are rounding.
constexpr double kRounding = 1e-13;

// Points between which the share is one cubic: where a plane passes an edge of its cell's column.
std::array<double, 10> pieces(const EdgePlane& outer, const EdgePlane& inner) {
  std::array<double, 10> at;
  std::size_t n = 0;
  at[n++] = 0.0;
  for (const EdgePlane* plane : {&outer, &inner}) {
    for (const double sign0 : {-0.5, 0.5}) {
      for (const double sign1 : {-0.5, 0.5}) {
        const double rest = plane->a - sign0 * plane->across0 - sign1 * plane->across1;
        const double mu = rest / plane->along + 0.5;
        at[n++] = mu > 0.0 && mu < 1.0 ? mu : 0.0;
      }
    }
  }
  at[n++] = 1.0;
  std::sort(at.begin(), at.end());
  return at;
}

// Points between which the share is monotone: the pieces, cut where their slope is 0.
std::vector<double> turning_points(const EdgePlane& outer, const EdgePlane& inner) {
  const std::array<double, 10> ends = pieces(outer, inner);
  std::vector<double> turns{0.0};
  for (std::size_t n = 1; n < ends.size(); ++n) {
    const double low = ends[n - 1];
    const double size = ends[n] - low;
    if (size <= 0.0) {
      continue;
    }
    // The slope is quadratic within the piece and may jump at its ends: c0 + c1 t + c2 t², t in
    // [-1,1], from three points inside.
    const auto slope = [&](double t) {
      return filling(outer, inner, low + size * (0.5 + 0.5 * t)).slope;
    };
    const double middle = slope(0.0);
    const double left = slope(-0.5);
    const double right = slope(0.5);
    const double c1 = right - left;
    const double c2 = 2.0 * (left + right - 2.0 * middle);
    const double root = std::sqrt(std::max(c1 * c1 - 4.0 * c2 * middle, 0.0));
    const double q = -0.5 * (c1 + std::copysign(root, c1));
    const double zeros[2] = {q / c2, middle / q};  // no numbers where the slope is constant
    const bool ascending = zeros[0] <= zeros[1];
    for (const double t : {zeros[ascending ? 0 : 1], zeros[ascending ? 1 : 0]}) {
      if (t > -1.0 && t < 1.0) {
        turns.push_back(low + size * (0.5 + 0.5 * t));
      }
    }
    turns.push_back(ends[n]);
  }
  return turns;
}

double away(double mu, double low, double high) {
  return std::max({low - mu, mu - high, 0.0});
}

// Algorithm 1 of E19: window, fraction, blended normal, plane, slide, until it settles.
double iterate(const EdgePlane& outer, const EdgePlane& inner, const Algorithm1Start& start) {
  constexpr int kMost = 200;
  double mu = start.mu;
  for (int step = 0; step < kMost; ++step) {
    const double share = filling(outer, inner, mu).excess + 0.5;
    const double w0 = (1.0 - mu) * start.outer_weight;
    const double w1 = mu * start.inner_weight;
    const double along = w0 * outer.along + w1 * inner.along;
    const double across0 = w0 * outer.across0 + w1 * inner.across0;
    const double across1 = w0 * outer.across1 + w1 * inner.across1;
    if (along == 0.0) {
      return mu;
    }
    const double slide = cube_offset(along, across0, across1, share) / along;
    const double next = std::clamp(mu + slide, 0.0, 1.0);
    if (std::abs(next - mu) < 1e-12) {
      return next;
    }
    mu = next;
  }
  return mu;
}

}  // namespace

Filling filling(const EdgePlane& outer, const EdgePlane& inner, double mu) {
  const double in_outer = slab(outer, mu / 2.0, 1.0 - mu);
  const double in_inner = slab(inner, (mu - 1.0) / 2.0, mu);
  return {in_outer + in_inner - 0.5, section(inner, mu - 0.5) - section(outer, mu - 0.5)};
}

bool surely_monotone(const EdgePlane& outer, const EdgePlane& inner) {
  // With both normals towards K0 the sections grow along the edge, so comparing the least of one
  // half of K1 with the most of the same half of K0 bounds the slope.
  return outer.along <= 0.0 && inner.along <= 0.0 && section(inner, -0.5) >= section(outer, 0.0) &&
         section(inner, 0.0) >= section(outer, 0.5);
}

WindowRoot newton(const EdgePlane& outer, const EdgePlane& inner, double low, double high,
                  double start) {
  constexpr int kMost = 100;
  WindowRoot root;
  root.mu = start > low && start < high ? start : low + (high - low) / 2.0;
  while (root.steps < kMost) {
    const Filling here = filling(outer, inner, root.mu);
    ++root.steps;
    if (std::abs(here.excess) <= 0x1p-53) {
      return root;
    }
    (here.excess < 0.0 ? low : high) = root.mu;
    double next = root.mu - here.excess / here.slope;
    if (!(next >= low && next <= high)) {
      next = low + (high - low) / 2.0;
    }
    const double step = std::abs(next - root.mu);
    root.mu = next;
    if (step <= 1e-12) {
      return root;
    }
  }
  return root;
}

double plane_crossing(const EdgePlane& outer, const EdgePlane& inner) {
  const double from_outer = outer.a / outer.along;
  const double from_inner = 1.0 + inner.a / inner.along;
  const bool outer_serves = from_outer > 0.0 && from_outer < 1.0;
  const bool inner_serves = from_inner > 0.0 && from_inner < 1.0;
  if (outer_serves && inner_serves) {
    return 0.5 * (from_outer + from_inner);
  }
  return outer_serves ? from_outer : (inner_serves ? from_inner : 0.5);
}

Bracket examine(const EdgePlane& outer, const EdgePlane& inner, const Algorithm1Start& start) {
  const std::vector<double> turns = turning_points(outer, inner);
  Bracket bracket{0.0, 1.0, false, 0};
  double reached = -1.0;
  double distance = 2.0;
  double before = filling(outer, inner, turns.front()).excess;
  for (std::size_t n = 1; n < turns.size(); ++n) {
    const double after = filling(outer, inner, turns[n]).excess;
    bracket.non_monotone = bracket.non_monotone || after < before - kRounding;
    if (before < 0.0 && after >= 0.0) {
      ++bracket.roots;
      if (bracket.roots == 2) {
        reached = iterate(outer, inner, start);
        distance = away(reached, bracket.low, bracket.high);
      }
      if (bracket.roots == 1 || away(reached, turns[n - 1], turns[n]) < distance) {
        bracket.low = turns[n - 1];
        bracket.high = turns[n];
        distance = away(reached, bracket.low, bracket.high);
      }
    }
    before = after;
  }
  return bracket;
}

}  // namespace difmesh::detail::window
