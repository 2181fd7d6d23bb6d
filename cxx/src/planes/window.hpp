#pragma once
// The vertex of E19 as the root of a scalar equation: the half-full window.
//
// A window T of a cell's size slides along the dual edge from the centre of the outer cell K0 (s =
// 0) to that of the inner cell K1 (s = 1). The vertex is where the planes of K0 and K1, each within
// its own cell, fill half of T.
//
// On stretched axes the cells have sizes h0 and h1 along the edge, and T = [lo0 + μ h0, hi0 + μ h1]
// with [lo0, hi0] the extent of K0: it starts as K0, ends as K1, and its centre is (1 - μ) x0 +
// μ x1. In the unit of each cell T covers the same part of it as before, [μ - 1/2, 1/2] of K0 and
// [-1/2, μ - 1/2] of K1, so what changes is the weight of the parts alone: half full is where
// h0 (V0 - (1 - μ)/2) + h1 (V1 - μ/2) = 0, V0 and V1 the shares filled of the unit cells. A plane
// through the centre of T halves it, so planes stay exact.

#include "difmesh/grid.hpp"
#include "planes/window_math.hpp"

namespace difmesh::detail {

/// A cell's plane seen from an edge: `along` is the component of m in the direction from K0 to K1.
struct EdgePlane {
  double along = 0.0;
  double across0 = 0.0;
  double across1 = 0.0;
  double a = 0.0;
  bool is_pure = true;  ///< full or empty: the other three are 0
  double size = 1.0;    ///< of its cell along the edge, in any unit that both planes share
};

/// What Algorithm 1 of E19 needs beside the planes: where it starts, and the factors that make each
/// m of unit length in physical space (0 for a pure cell), for it blends unit normals.
struct Algorithm1Start {
  double mu = 0.5;
  double outer_weight = 0.0;
  double inner_weight = 0.0;
};

struct WindowRoot {
  double mu = 0.5;  ///< position from K0 to K1, in [0,1]
  int steps = 0;    ///< of Newton's method
  bool non_monotone = false;
};

/// Solves for the half-full window. Where the share filled is not monotone along the edge and has
/// several roots, takes the rising one nearest to where Algorithm 1 of E19 ends from start(), an
/// Algorithm1Start made only on suspicion.
/// \pre the window is at most half full at s = 0 and at least half full at s = 1
template <class Start>
[[nodiscard]] WindowRoot solve_window(const EdgePlane& outer, const EdgePlane& inner,
                                      const Start& start);

namespace window {

using Plane = baseline::WindowPlane<double>;

[[nodiscard]] inline Plane prepared(const EdgePlane& plane) {
  return baseline::window_plane(plane.along, plane.across0, plane.across1, plane.a);
}

/// Newton's method where the share is monotone along the edge.
[[nodiscard]] WindowRoot solve_monotone(const Plane& outer, const Plane& inner);

/// Between cells of different sizes along the edge.
[[nodiscard]] WindowRoot solve_sized(const EdgePlane& outer, const EdgePlane& inner,
                                     const Algorithm1Start& start);

/// The root to take from all extrema of the share along the edge. \pre the cells have one size
[[nodiscard]] WindowRoot solve_examined(const EdgePlane& outer, const EdgePlane& inner,
                                        const Algorithm1Start& start);

}  // namespace window

template <class Start>
WindowRoot solve_window(const EdgePlane& outer, const EdgePlane& inner, const Start& start) {
  if (outer.size != inner.size) {
    return window::solve_sized(outer, inner, start());
  }
  const window::Plane outer_plane = window::prepared(outer);
  const window::Plane inner_plane = window::prepared(inner);
  if (outer.is_pure || inner.is_pure || baseline::surely_monotone(outer_plane, inner_plane)) {
    return window::solve_monotone(outer_plane, inner_plane);
  }
  return window::solve_examined(outer, inner, start());
}

}  // namespace difmesh::detail
