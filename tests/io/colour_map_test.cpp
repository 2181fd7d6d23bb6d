#include "difmesh/io/colour_map.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace {

using difmesh::Colour;
using difmesh::colour_of;
using difmesh::ColourMap;

/// Lightness of CIE Lab.
double lightness(const Colour& colour) {
  const Colour linear = difmesh::to_linear(colour);
  const double y = 0.2126729 * linear[0] + 0.7151522 * linear[1] + 0.0721750 * linear[2];
  return 116.0 * std::cbrt(y) - 16.0;
}

}  // namespace

TEST_CASE("viridis gets lighter in even steps") {
  const double first = lightness(colour_of(ColourMap::viridis, 0.0));
  const double last = lightness(colour_of(ColourMap::viridis, 1.0));
  for (int i = 0; i <= 100; ++i) {
    const double share = i / 100.0;
    const double even = first + share * (last - first);
    CHECK(std::abs(lightness(colour_of(ColourMap::viridis, share)) - even) < 2.0);
  }
}

TEST_CASE("cool_warm has the colours of its author's table") {
  // Moreland's published table of 33 colours, some of its rows.
  const std::array<std::pair<double, Colour>, 5> rows{
      {{0.0, {0.2298057, 0.298717966, 0.753683153}},
       {0.03125, {0.26623388, 0.353094838, 0.801466763}},
       {0.125, {0.38301334, 0.50941904, 0.917387822}},
       {0.5, {0.865395197, 0.86541021, 0.865395561}},
       {1.0, {0.705673158, 0.01555616, 0.150232812}}}};
  for (const auto& [share, wanted] : rows) {
    CAPTURE(share);
    const Colour found = colour_of(ColourMap::cool_warm, share);
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(std::abs(found[c] - wanted[c]) < 2.0 / 255.0);
    }
  }
  // As light on one side as on the other.
  for (int i = 0; i <= 50; ++i) {
    CHECK(std::abs(lightness(colour_of(ColourMap::cool_warm, 0.01 * i)) -
                   lightness(colour_of(ColourMap::cool_warm, 1.0 - 0.01 * i))) < 8.0);
  }
}

TEST_CASE("shares beyond the ends get the colours of the ends") {
  for (const ColourMap map : {ColourMap::viridis, ColourMap::cool_warm}) {
    CHECK(colour_of(map, -1.0) == colour_of(map, 0.0));
    CHECK(colour_of(map, 2.0) == colour_of(map, 1.0));
    CHECK(colour_of(map, std::numeric_limits<double>::infinity()) == colour_of(map, 1.0));
    CHECK(colour_of(map, std::numeric_limits<double>::quiet_NaN()) == colour_of(map, 0.0));
  }
}
