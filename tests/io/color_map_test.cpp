#include "difmesh/io/color_map.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace {

using difmesh::Color;
using difmesh::color_of;
using difmesh::ColorMap;

/// Lightness of CIE Lab.
double lightness(const Color& color) {
  const Color linear = difmesh::to_linear(color);
  const double y = 0.2126729 * linear[0] + 0.7151522 * linear[1] + 0.0721750 * linear[2];
  return 116.0 * std::cbrt(y) - 16.0;
}

}  // namespace

TEST_CASE("viridis gets lighter in even steps") {
  const double first = lightness(color_of(ColorMap::viridis, 0.0));
  const double last = lightness(color_of(ColorMap::viridis, 1.0));
  for (int i = 0; i <= 100; ++i) {
    const double share = i / 100.0;
    const double even = first + share * (last - first);
    CHECK(std::abs(lightness(color_of(ColorMap::viridis, share)) - even) < 2.0);
  }
}

TEST_CASE("cool_warm has the colors of its author's table") {
  // Moreland's published table of 33 colours, some of its rows.
  const std::array<std::pair<double, Color>, 5> rows{
      {{0.0, {0.2298057, 0.298717966, 0.753683153}},
       {0.03125, {0.26623388, 0.353094838, 0.801466763}},
       {0.125, {0.38301334, 0.50941904, 0.917387822}},
       {0.5, {0.865395197, 0.86541021, 0.865395561}},
       {1.0, {0.705673158, 0.01555616, 0.150232812}}}};
  for (const auto& [share, wanted] : rows) {
    CAPTURE(share);
    const Color found = color_of(ColorMap::cool_warm, share);
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(std::abs(found[c] - wanted[c]) < 2.0 / 255.0);
    }
  }
  // As light on one side as on the other.
  for (int i = 0; i <= 50; ++i) {
    CHECK(std::abs(lightness(color_of(ColorMap::cool_warm, 0.01 * i)) -
                   lightness(color_of(ColorMap::cool_warm, 1.0 - 0.01 * i))) < 8.0);
  }
}

TEST_CASE("shares beyond the ends get the colors of the ends") {
  for (const ColorMap map : {ColorMap::viridis, ColorMap::cool_warm}) {
    CHECK(color_of(map, -1.0) == color_of(map, 0.0));
    CHECK(color_of(map, 2.0) == color_of(map, 1.0));
    CHECK(color_of(map, std::numeric_limits<double>::infinity()) == color_of(map, 1.0));
    CHECK(color_of(map, std::numeric_limits<double>::quiet_NaN()) == color_of(map, 0.0));
  }
}
