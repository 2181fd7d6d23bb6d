#pragma once
// Planes in the unit cell, m·u = a: see plane_math.hpp.

#include "planes/plane_math.hpp"

namespace difmesh::detail {

/// Share of the unit cube where m·u <= a. m = 0: all or nothing, by the sign of a.
inline double cube_fraction(double m0, double m1, double m2, double a) {
  return baseline::cube_share(baseline::sorted(m0, m1, m2), a);
}

/// a at which cube_fraction(m, a) is the fraction, clamped to [0,1].
double cube_offset(double m0, double m1, double m2, double fraction);

}  // namespace difmesh::detail
