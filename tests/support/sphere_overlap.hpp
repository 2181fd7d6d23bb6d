#pragma once
/// \file sphere_overlap.hpp
/// Volume of the overlap of a ball and a box in closed form.
///
/// G(a,b,c), the volume of the ball of radius R about 0 inside [0,a] x [0,b] x [0,c], continued
/// oddly in each argument, gives the overlap with a box as the alternating sum over its corners. G
/// is the integral over z of the area of a quarter disc of radius r = √(R²-z²) inside [0,a] x
/// [0,b]: ab while the corner lies in the disc, else B(a) + B(b) - πr²/4 with B(a) the area left of
/// x = a. All of these have antiderivatives. In long double, as the corners' volumes cancel.

#include "support/box_clip.hpp"
#include "support/shapes.hpp"

namespace difmesh::test {

/// Share of the box inside the sphere; absolute error about 1e-18 (R / shortest side)³.
[[nodiscard]] double sphere_overlap(const Sphere& sphere, const Box& box);

}  // namespace difmesh::test
