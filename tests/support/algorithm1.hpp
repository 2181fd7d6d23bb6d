#pragma once
/// \file algorithm1.hpp
/// Algorithm 1 of Evrard, Denner, van Wachem (IEEE TVCG 2019), as printed, on one dual edge: the
/// oracle of the library's vertices. Volumes come from clipping boxes, the inverse problem from
/// bracketing them; of the library only the planes of the two cells are taken.

#include "difmesh/plane.hpp"

namespace difmesh::test {

/// A crossed dual edge. Positions along it run from the centre of the outer cell (fraction < 1/2)
/// at 0 to that of the inner one (fraction >= 1/2) at 1.
struct CrossedEdge {
  Vec3 spacing{1.0, 1.0, 1.0};
  int axis = 0;            ///< of the edge
  double direction = 1.0;  ///< +1 where the inner cell lies on the higher side, else -1
  double outer_fraction = 0.0;
  double inner_fraction = 1.0;
  Plane outer_plane;  ///< relative to the outer cell's centre; unused where the cell is empty
  Plane inner_plane;  ///< relative to the inner cell's centre; unused where the cell is full
};

enum class Guess { mid_edge, linear, manson };

/// Where the iteration starts. Linear: where the fractions, interpolated, are ½. Manson et al.
/// (2011): its four planar cases.
[[nodiscard]] double initial_guess(Guess guess, double outer_fraction, double inner_fraction);

/// Share of the window T, a cuboid of a cell's size centred on the edge at mu, that the two planes
/// fill, each over its own cell.
[[nodiscard]] double window_fraction(const CrossedEdge& edge, double mu);

struct Algorithm1Result {
  double mu = 0.5;
  int steps = 0;
  bool converged = false;  ///< to a half-full window, not to an end of the edge
};

/// Repeats "fill T, blend the normals, put a plane into T, slide to it" until a step is shorter
/// than `tolerance` edge lengths or `cap` steps are done.
[[nodiscard]] Algorithm1Result algorithm1(const CrossedEdge& edge, double start,
                                          double tolerance = 1e-12, int cap = 200);

}  // namespace difmesh::test
