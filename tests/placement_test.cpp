// Where placements from fractions put vertices.

#include "placement/placement.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "placement/manson.hpp"

using namespace difmesh;

namespace {

// Share of the unit square about (centre, 0) that lies to the right of x = foot + lean y.
double share_right_of(double foot, double lean, double centre) {
  const auto integral = [](double u) {  // of u clamped to [0,1]
    return u <= 0.0 ? 0.0 : (u < 1.0 ? u * u / 2.0 : u - 0.5);
  };
  const double reach = centre + 0.5 - foot;
  return (integral(reach + lean / 2.0) - integral(reach - lean / 2.0)) / lean;
}

}  // namespace

TEST_CASE("placement: manson is exact for straight lines that cross the edge, however they lean") {
  int in_case[4] = {};
  for (int n = 1; n < 100; ++n) {
    for (const double size : {1e-3, 0.1, 0.4, 0.7, 1.0, 1.3, 1.7, 2.2, 3.0, 5.0}) {
      for (const double lean : {-size, size}) {
        const double foot = 0.01 * n;
        const double outer = share_right_of(foot, lean, 0.0);
        const double inner = share_right_of(foot, lean, 1.0);
        REQUIRE(outer < 0.5);
        REQUIRE(inner > 0.5);
        CAPTURE(foot);
        CAPTURE(lean);
        CHECK(std::abs(detail::manson_position(outer, inner) - foot) < 1e-12);
        ++in_case[(outer > 0.0 ? 1 : 0) + (inner < 1.0 ? 2 : 0)];
      }
    }
  }
  // Cut at a corner of the one cell or of the other, or through both.
  for (const int n : {1, 2, 3}) {
    CHECK(in_case[n] > 100);
  }
}

TEST_CASE("placement: batches of any length give each edge what it gets alone") {
  for (const Placement placement : {Placement::midpoint, Placement::linear, Placement::manson}) {
    const detail::PlacementPart& part = detail::placement_part(placement);
    REQUIRE(!part.by_planes);
    double outer[37];
    double inner[37];
    double together[38];
    for (int n = 0; n < 37; ++n) {
      outer[n] = 0.4999 * ((n * 7) % 37) / 36.0;
      inner[n] = 0.5 + 0.5 * ((n * 5) % 37) / 36.0;
    }
    together[37] = -1.0;
    part.place({outer, inner, together, 37});
    CHECK(together[37] == -1.0);
    for (int n = 0; n < 37; ++n) {
      double alone = 0.0;
      part.place({outer + n, inner + n, &alone, 1});
      CHECK(alone == together[n]);
      CHECK(alone >= 0.0);
      CHECK(alone <= 1.0);
    }
  }
}
