#include "planes/window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "planes/cube_fraction.hpp"

namespace difmesh::detail::window {
namespace {

using baseline::filling;

// A plane and the size of its cell along the edge, where the cells differ in it; see window.hpp.
struct SizedPlane {
  Plane plane;
  double size;  // those of both cells add up to 2
};

// Of the mean size of the cells, what is filled less a half, and its derivative.
baseline::Filling<double> filling(const SizedPlane& outer, const SizedPlane& inner, double mu) {
  const double in_outer = baseline::slab(outer.plane, mu * 0.5, 1.0 - mu) - 0.5 * (1.0 - mu);
  const double in_inner = baseline::slab(inner.plane, (mu - 1.0) * 0.5, mu) - 0.5 * mu;
  return {outer.size * in_outer + inner.size * in_inner,
          outer.size * (0.5 - baseline::section(outer.plane, mu - 0.5)) +
              inner.size * (baseline::section(inner.plane, mu - 0.5) - 0.5)};
}

double plane_crossing(const SizedPlane& outer, const SizedPlane& inner) {
  return baseline::plane_crossing(outer.plane, inner.plane);
}
double plane_crossing(const Plane& outer, const Plane& inner) {
  return baseline::plane_crossing(outer, inner);
}

// Both planes of an edge as what the solvers below take.
template <class P>
struct Both;
template <>
struct Both<Plane> {
  Plane outer;
  Plane inner;
  Both(const EdgePlane& at_outer, const EdgePlane& at_inner)
      : outer(prepared(at_outer)), inner(prepared(at_inner)) {}
  [[nodiscard]] static double window_size(double) { return 1.0; }
  [[nodiscard]] static double outer_size() { return 1.0; }
  [[nodiscard]] static double inner_size() { return 1.0; }
};
template <>
struct Both<SizedPlane> {
  SizedPlane outer;
  SizedPlane inner;
  Both(const EdgePlane& at_outer, const EdgePlane& at_inner)
      : outer{prepared(at_outer), 2.0 * (at_outer.size / (at_outer.size + at_inner.size))},
        inner{prepared(at_inner), 2.0 * (at_inner.size / (at_outer.size + at_inner.size))} {}
  // Of the window, over the mean of the cells' sizes, which is the length of the edge.
  [[nodiscard]] double window_size(double mu) const {
    return (1.0 - mu) * outer.size + mu * inner.size;
  }
  [[nodiscard]] double outer_size() const { return outer.size; }
  [[nodiscard]] double inner_size() const { return inner.size; }
};

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

template <class P>
Turns turning_points(const P& outer, const P& inner, const std::array<double, 10>& ends) {
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
template <class P>
double iterate(const EdgePlane& outer, const EdgePlane& inner, const Algorithm1Start& start) {
  constexpr int kMost = 200;
  const Both<P> planes(outer, inner);
  double mu = start.mu;
  for (int step = 0; step < kMost; ++step) {
    const double size = planes.window_size(mu);
    const double share = filling(planes.outer, planes.inner, mu).excess / size + 0.5;
    const double w0 = (1.0 - mu) * start.outer_weight;
    const double w1 = mu * start.inner_weight;
    const double along = w0 * outer.along * (size / planes.outer_size()) +
                         w1 * inner.along * (size / planes.inner_size());
    const double across0 = w0 * outer.across0 + w1 * inner.across0;
    const double across1 = w0 * outer.across1 + w1 * inner.across1;
    if (along == 0.0) {
      return mu;
    }
    const double slide = cube_offset(along, across0, across1, share) / along * size;
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

template <class P>
Bracket examine(const EdgePlane& outer, const EdgePlane& inner, const Algorithm1Start& start) {
  const Both<P> planes(outer, inner);
  const Turns turns = turning_points(planes.outer, planes.inner, pieces(outer, inner));
  Bracket bracket;
  double reached = -1.0;
  double distance = 2.0;
  double before = filling(planes.outer, planes.inner, 0.0).excess;
  for (std::size_t n = 1; n < turns.count; ++n) {
    const double after = filling(planes.outer, planes.inner, turns.at[n]).excess;
    bracket.non_monotone = bracket.non_monotone || after < before - kRounding;
    if (before < 0.0 && after >= 0.0) {
      ++bracket.roots;
      if (bracket.roots == 2) {
        reached = iterate<P>(outer, inner, start);
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

template <class P>
WindowRoot newton(const P& outer, const P& inner, double low, double high) {
  const baseline::NewtonRoot<double> root =
      baseline::newton(outer, inner, low, high, plane_crossing(outer, inner));
  return {root.mu, static_cast<int>(root.steps), false};
}

template <class P>
WindowRoot solve(const EdgePlane& outer, const EdgePlane& inner, const Algorithm1Start& start) {
  const Bracket bracket = examine<P>(outer, inner, start);
  const Both<P> planes(outer, inner);
  WindowRoot root = newton(planes.outer, planes.inner, bracket.low, bracket.high);
  root.non_monotone = bracket.non_monotone;
  return root;
}

}  // namespace

WindowRoot solve_monotone(const Plane& outer, const Plane& inner) {
  return newton(outer, inner, 0.0, 1.0);
}

WindowRoot solve_examined(const EdgePlane& outer, const EdgePlane& inner,
                          const Algorithm1Start& start) {
  return solve<Plane>(outer, inner, start);
}

WindowRoot solve_sized(const EdgePlane& outer, const EdgePlane& inner,
                       const Algorithm1Start& start) {
  return solve<SizedPlane>(outer, inner, start);
}

}  // namespace difmesh::detail::window
