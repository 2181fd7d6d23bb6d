#pragma once
/// \file color_map.hpp
/// Colours for scalar values.

#include <array>
#include <cstdint>

namespace difmesh {

enum class ColorMap : std::uint8_t {
  /// From dark blue over green to yellow; equal steps look equal and get lighter, in print and to
  /// the colour-blind too. Source: S. van der Walt, N. Smith, 2015 (public domain, CC0).
  viridis,
  /// Diverging, from blue over light grey to red: for values on both sides of 0. Source: K.
  /// Moreland, Diverging Color Maps for Scientific Visualization, ISVC 2009.
  cool_warm,
};

/// Red, green and blue in [0,1], as screens take them (sRGB).
using Color = std::array<double, 3>;

/// The colour of a share, which is clamped to [0,1]; NaN counts as 0.
/// Cost: constant. Thread safety: pure function.
[[nodiscard]] Color color_of(ColorMap map, double share) noexcept;

/// The same colour in linear light, as glTF and shaders take it. Source: IEC 61966-2-1.
[[nodiscard]] Color to_linear(const Color& color) noexcept;

}  // namespace difmesh
