#pragma once
// The vertex of E19 as the root of a scalar equation: the half-full window.
//
// A window T of a cell's size slides along the dual edge from the centre of the outer cell K0 (s =
// 0) to that of the inner cell K1 (s = 1). The vertex is where the planes of K0 and K1, each within
// its own cell, fill half of T.

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// A cell's plane seen from an edge: `along` is the component of m in the direction from K0 to K1.
struct EdgePlane {
  double along = 0.0;
  double across0 = 0.0;
  double across1 = 0.0;
  double a = 0.0;
  bool is_pure = true;  ///< full or empty: the other three are 0
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

/// Share of T filled, less 1/2, and its derivative.
struct Filling {
  double excess;
  double slope;
};
[[nodiscard]] Filling filling(const EdgePlane& outer, const EdgePlane& inner, double mu);

/// Cheap proof that the share grows all along the edge; false where it does not go through.
[[nodiscard]] bool surely_monotone(const EdgePlane& outer, const EdgePlane& inner);

/// Newton's method from `start`, kept within [low, high] by bisection.
[[nodiscard]] WindowRoot newton(const EdgePlane& outer, const EdgePlane& inner, double low,
                                double high, double start);

/// Start for Newton's method: where the planes themselves meet the edge.
[[nodiscard]] double plane_crossing(const EdgePlane& outer, const EdgePlane& inner);

/// The bracket of the root to take, from all extrema of the share along the edge.
struct Bracket {
  double low;
  double high;
  bool non_monotone;
  int roots;
};
[[nodiscard]] Bracket examine(const EdgePlane& outer, const EdgePlane& inner,
                              const Algorithm1Start& start);

}  // namespace window

template <class Start>
WindowRoot solve_window(const EdgePlane& outer, const EdgePlane& inner, const Start& start) {
  if (outer.is_pure || inner.is_pure || window::surely_monotone(outer, inner)) {
    return window::newton(outer, inner, 0.0, 1.0, window::plane_crossing(outer, inner));
  }
  const window::Bracket bracket = window::examine(outer, inner, start());
  WindowRoot root =
      window::newton(outer, inner, bracket.low, bracket.high, window::plane_crossing(outer, inner));
  root.non_monotone = bracket.non_monotone;
  return root;
}

}  // namespace difmesh::detail
