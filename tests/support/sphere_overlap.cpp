#include "support/sphere_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace difmesh::test {
namespace {

using Real = long double;
constexpr Real kQuarterPi = std::numbers::pi_v<Real> / 4.0L;

/// ∫0^z π r²/4 dz, r² = R² - z².
Real quarter_discs(Real R, Real z) {
  return kQuarterPi * z * (R * R - z * z / 3.0L);
}

/// ∫0^z B(a) dz with B(a) = ½ (a √(r²-a²) + r² asin(a/r)) for a < r, πr²/4 beyond.
Real left_of(Real R, Real a, Real z) {
  if (a >= R) {
    return quarter_discs(R, z);
  }
  const Real rho = std::sqrt(R * R - a * a);
  if (z > rho) {
    return left_of(R, a, rho) + quarter_discs(R, z) - quarter_discs(R, rho);
  }
  // Angles by atan2 of the one root: asin() near 1 would keep half of the digits only.
  const Real root = std::sqrt(std::max(0.0L, (rho - z) * (rho + z)));
  const Real turn = std::atan2(z, root);
  const Real roots = a * 0.5L * (z * root + rho * rho * turn);  // ∫ a √(r²-a²)
  const Real sectors =                                          // ∫ r² asin(a/r), by parts
      z * (R * R - z * z / 3.0L) * std::atan2(a, root) -
      a * ((rho * rho * turn - z * root) / 6.0L - 2.0L / 3.0L * R * R * turn) -
      2.0L / 3.0L * R * R * R * std::atan2(a * z, R * root);
  return 0.5L * (roots + sectors);
}

/// G for arguments >= 0.
Real octant(Real R, Real a, Real b, Real c) {
  a = std::min(a, R);
  b = std::min(b, R);
  c = std::min(c, R);
  if (a == 0.0L || b == 0.0L || c == 0.0L) {
    return 0.0L;
  }
  const Real corner_in = std::min(c, std::sqrt(std::max(0.0L, R * R - a * a - b * b)));
  const auto beyond = [&](Real z) {
    return left_of(R, a, z) + left_of(R, b, z) - quarter_discs(R, z);
  };
  return a * b * corner_in + beyond(c) - beyond(corner_in);
}

}  // namespace

double sphere_overlap(const Sphere& sphere, const Box& box) {
  const Real R = sphere.radius;
  Real sum = 0.0L;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Real sign = 1.0L;
    std::array<Real, 3> x{};
    for (unsigned a = 0; a < 3; ++a) {
      const bool high = ((corner >> a) & 1U) != 0;
      x[a] = static_cast<Real>(high ? box.high[a] : box.low[a]) - sphere.centre[a];
      sign *= (high ? 1.0L : -1.0L) * (x[a] < 0.0L ? -1.0L : 1.0L);
    }
    sum += sign * octant(R, std::abs(x[0]), std::abs(x[1]), std::abs(x[2]));
  }
  const Real volume = (static_cast<Real>(box.high[0]) - box.low[0]) *
                      (static_cast<Real>(box.high[1]) - box.low[1]) *
                      (static_cast<Real>(box.high[2]) - box.low[2]);
  return static_cast<double>(std::clamp(sum / volume, 0.0L, 1.0L));
}

}  // namespace difmesh::test
