#pragma once
// The half-full window of window.hpp, for one dual edge or eight (lanes.hpp).

#include "planes/plane_math.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

/// A cell's plane seen from an edge. Only `along`, the component of m in the direction from K0 to
/// K1, changes its weight as the window slides; the others are sorted once.
template <class R>
struct WindowPlane {
  R along, a;
  R inverse_along;         ///< no finite number where the plane is parallel to the edge
  R steep, inverse_steep;  ///< |along|
  R small, large;          ///< sizes of the components across
  R inverse_small, inverse_large;
};

template <class R>
[[gnu::always_inline]] inline WindowPlane<R> window_plane(const R& along, const R& across0,
                                                          const R& across1, const R& a) {
  WindowPlane<R> plane;
  plane.along = along;
  plane.a = a;
  plane.inverse_along = 1.0 / along;
  plane.steep = magnitude(along);
  plane.inverse_steep = smaller(magnitude(plane.inverse_along), constant<R>(1e300));
  const R size0 = magnitude(across0);
  const R size1 = magnitude(across1);
  plane.small = smaller(size0, size1);
  plane.large = larger(size0, size1);
  plane.inverse_small = tame_inverse(plane.small);
  plane.inverse_large = tame_inverse(plane.large);
  return plane;
}

/// Wetted share of the cross-section of a cell at distance s from its centre along the edge.
template <class R>
[[gnu::always_inline]] inline R section(const WindowPlane<R>& plane, const R& s) {
  const R zero = constant<R>(0.0);
  const R one = constant<R>(1.0);
  const R a = plane.a - plane.along * s;
  const R alpha = (plane.small + plane.large) * 0.5 - magnitude(a);
  const R corner = alpha * plane.inverse_small * (alpha * plane.inverse_large) * 0.5;
  const R share =
      select(alpha < plane.small, corner, (alpha - plane.small * 0.5) * plane.inverse_large);
  return select(alpha <= zero, select(a >= zero, one, zero), select(a > zero, 1.0 - share, share));
}

/// Wetted share of T that a cell contributes: its slab of the given width about s.
template <class R>
[[gnu::always_inline]] inline R slab(const WindowPlane<R>& plane, const R& s, const R& width) {
  const R size = plane.steep * width;
  const R inverse = smaller(plane.inverse_steep * tame_inverse(width), constant<R>(1e300));
  const Mask<R> least = size < plane.small;
  const Mask<R> most = plane.large < size;
  Sorted<R> m;
  m.small = select(least, size, plane.small);
  m.inverse_small = select(least, inverse, plane.inverse_small);
  m.large = select(most, size, plane.large);
  m.inverse_large = select(most, inverse, plane.inverse_large);
  m.middle = select(least, plane.small, select(most, plane.large, size));
  m.inverse_middle = select(least, plane.inverse_small, select(most, plane.inverse_large, inverse));
  return width * cube_share(m, plane.a - plane.along * s);
}

/// Share of T filled, less 1/2, and its derivative.
template <class R>
struct Filling {
  R excess;
  R slope;
};

template <class R>
[[gnu::always_inline]] inline Filling<R> filling(const WindowPlane<R>& outer,
                                                 const WindowPlane<R>& inner, const R& mu) {
  const R in_outer = slab(outer, mu * 0.5, 1.0 - mu);
  const R in_inner = slab(inner, (mu - 1.0) * 0.5, mu);
  return {in_outer + in_inner - 0.5, section(inner, mu - 0.5) - section(outer, mu - 0.5)};
}

/// Cheap proof that the share grows all along the edge; false where it does not go through.
template <class R>
[[gnu::always_inline]] inline Mask<R> surely_monotone(const WindowPlane<R>& outer,
                                                      const WindowPlane<R>& inner) {
  // With both normals towards K0 the sections grow along the edge, so comparing the least of one
  // half of K1 with the most of the same half of K0 bounds the slope.
  const R zero = constant<R>(0.0);
  const R half = constant<R>(0.5);
  return (outer.along <= zero) & (inner.along <= zero) &
         (section(inner, -half) >= section(outer, zero)) &
         (section(inner, zero) >= section(outer, half));
}

/// Start for Newton's method: where the planes themselves meet the edge.
template <class R>
[[gnu::always_inline]] inline R plane_crossing(const WindowPlane<R>& outer,
                                               const WindowPlane<R>& inner) {
  const R zero = constant<R>(0.0);
  const R one = constant<R>(1.0);
  const R from_outer = outer.a * outer.inverse_along;
  const R from_inner = 1.0 + inner.a * inner.inverse_along;
  const Mask<R> outer_serves = (from_outer > zero) & (from_outer < one);
  const Mask<R> inner_serves = (from_inner > zero) & (from_inner < one);
  const R alone = select(outer_serves, from_outer, select(inner_serves, from_inner, 0.5 * one));
  return select(outer_serves & inner_serves, 0.5 * (from_outer + from_inner), alone);
}

template <class R>
struct NewtonRoot {
  R mu;
  R steps;
};

/// Newton's method from `start`, kept within [low, high] by bisection.
template <class R, class Plane>
[[gnu::always_inline]] inline NewtonRoot<R> newton(const Plane& outer, const Plane& inner, R low,
                                                   R high, const R& start) {
  constexpr int kMost = 100;
  const R zero = constant<R>(0.0);
  NewtonRoot<R> root{select((start > low) & (start < high), start, low + (high - low) * 0.5), zero};
  Mask<R> done = zero > zero;
  for (int step = 0; step < kMost && any(opposite(done)); ++step) {
    const Filling<R> here = filling(outer, inner, root.mu);
    root.steps = select(done, root.steps, root.steps + 1.0);
    done = done | (magnitude(here.excess) <= constant<R>(0x1p-53));
    const Mask<R> below = here.excess < zero;
    low = select(below, root.mu, low);
    high = select(below, high, root.mu);
    const R straight = root.mu - here.excess / here.slope;
    const R next =
        select((straight >= low) & (straight <= high), straight, low + (high - low) * 0.5);
    const R moved = magnitude(next - root.mu);
    root.mu = select(done, root.mu, next);
    // The next step would be about its square over the slope: lost in rounding.
    done = done | (moved <= constant<R>(1e-12)) | (moved <= here.slope * 1e-8);
  }
  return root;
}

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
