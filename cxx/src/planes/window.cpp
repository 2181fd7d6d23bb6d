#include "planes/window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "planes/cube_fraction.hpp"

namespace difmesh::detail::window {
namespace {

using baseline::filling;

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
struct Turns {
  std::array<double, 28> at{0.0};
  std::size_t count = 1;

  void add(double mu) { at[count++] = mu; }
};

Turns turning_points(const Plane& outer, const Plane& inner, const std::array<double, 10>& ends) {
  Turns turns;
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
        turns.add(low + size * (0.5 + 0.5 * t));
      }
    }
    turns.add(ends[n]);
  }
  return turns;
}

double away(double mu, double low, double high) {
  return std::max({low - mu, mu - high, 0.0});
}

// Algorithm 1 of E19: window, fraction, blended normal, plane, slide, until it settles.
double iterate(const EdgePlane& outer, const EdgePlane& inner, const Algorithm1Start& start) {
  constexpr int kMost = 200;
  const Plane outer_plane = prepared(outer);
  const Plane inner_plane = prepared(inner);
  double mu = start.mu;
  for (int step = 0; step < kMost; ++step) {
    const double share = filling(outer_plane, inner_plane, mu).excess + 0.5;
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

// The bracket of the root to take, from all extrema of the share along the edge.
struct Bracket {
  double low = 0.0;
  double high = 1.0;
  bool non_monotone = false;
  int roots = 0;
};

Bracket examine(const EdgePlane& outer, const EdgePlane& inner, const Algorithm1Start& start) {
  const Plane outer_plane = prepared(outer);
  const Plane inner_plane = prepared(inner);
  const Turns turns = turning_points(outer_plane, inner_plane, pieces(outer, inner));
  Bracket bracket;
  double reached = -1.0;
  double distance = 2.0;
  double before = filling(outer_plane, inner_plane, 0.0).excess;
  for (std::size_t n = 1; n < turns.count; ++n) {
    const double after = filling(outer_plane, inner_plane, turns.at[n]).excess;
    bracket.non_monotone = bracket.non_monotone || after < before - kRounding;
    if (before < 0.0 && after >= 0.0) {
      ++bracket.roots;
      if (bracket.roots == 2) {
        reached = iterate(outer, inner, start);
        distance = away(reached, bracket.low, bracket.high);
      }
      if (bracket.roots == 1 || away(reached, turns.at[n - 1], turns.at[n]) < distance) {
        bracket.low = turns.at[n - 1];
        bracket.high = turns.at[n];
        distance = away(reached, bracket.low, bracket.high);
      }
    }
    before = after;
  }
  return bracket;
}

WindowRoot newton(const Plane& outer, const Plane& inner, double low, double high) {
  const baseline::NewtonRoot<double> root =
      baseline::newton(outer, inner, low, high, baseline::plane_crossing(outer, inner));
  return {root.mu, static_cast<int>(root.steps), false};
}

}  // namespace

WindowRoot solve_monotone(const Plane& outer, const Plane& inner) {
  return newton(outer, inner, 0.0, 1.0);
}

WindowRoot solve_examined(const EdgePlane& outer, const EdgePlane& inner,
                          const Algorithm1Start& start) {
  const Bracket bracket = examine(outer, inner, start);
  WindowRoot root = newton(prepared(outer), prepared(inner), bracket.low, bracket.high);
  root.non_monotone = bracket.non_monotone;
  return root;
}

}  // namespace difmesh::detail::window
