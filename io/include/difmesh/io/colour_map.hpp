#pragma once
/// \file colour_map.hpp
/// Colours for scalar values.

#include <array>
#include <cstdint>

namespace difmesh {

enum class ColourMap : std::uint8_t {
  /// From dark blue over green to yellow; equal steps look equal and get lighter, in print and to
  /// the colour-blind too. Source: S. van der Walt, N. Smith, 2015 (public domain, CC0).
  viridis,
  /// Diverging, from blue over light grey to red: for values on both sides of 0. Source: K.
  /// Moreland, Diverging Color Maps for Scientific Visualization, ISVC 2009.
  cool_warm,
};

/// Red, green and blue in [0,1], as screens take them (sRGB).
using Colour = std::array<double, 3>;

/// The colour of a share, which is clamped to [0,1]; NaN counts as 0.
/// Cost: constant. Thread safety: pure function.
[[nodiscard]] Colour colour_of(ColourMap map, double share) noexcept;

/// The same colour in linear light, as glTF and shaders take it. Source: IEC 61966-2-1.
[[nodiscard]] Colour to_linear(const Colour& colour) noexcept;

}  // namespace difmesh
