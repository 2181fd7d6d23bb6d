#pragma once
// The surface in and around one cell, in lengths from the cell's centre whose unit is the cube root
// of its volume.

#include <array>
#include <cmath>
#include <cstddef>

#include "base/vector3.hpp"
#include "difmesh/cell_surfaces.hpp"

namespace difmesh::detail {

/// Powers of two coordinates up to the fourth: the coefficient of ξ^p η^q is at 5 p + q.
using Coefficients = std::array<double, 25>;
[[nodiscard]] constexpr std::size_t power(std::size_t p, std::size_t q) {
  return 5 * p + q;
}

/// A surface that puts the cell's centre on the other side than the fraction does is believed where
/// the fraction is at least so far from 0 and 1.
inline constexpr double kMayFlip = 0.3;
/// Cells from the centre to a surface that it may own.
inline constexpr double kMostAway = 1.8;

/// A polynomial and its derivatives at a point.
struct GraphJet {
  double value = 0.0;
  double by_xi = 0.0;
  double by_eta = 0.0;
  double by_xi_xi = 0.0;
  double by_xi_eta = 0.0;
  double by_eta_eta = 0.0;
};
[[nodiscard]] GraphJet jet_of(const Coefficients& coefficients, double xi, double eta);
[[nodiscard]] double value_of(const Coefficients& coefficients, double xi, double eta);

/// A function and its derivatives at a point in space.
struct FunctionJet {
  double value = 0.0;
  Vec3 gradient{0.0, 0.0, 0.0};
  std::array<Vec3, 3> hessian{};

  void add(const FunctionJet& other, double weight);
};

/// The graph ζ = q(ξ, η) over a plane through the cell's centre, with the material below it.
struct Graph {
  std::array<Vec3, 3> frame{};  ///< directions of ξ, η and ζ: orthonormal, ζ out of the material
  Coefficients coefficients{};
  double scale = 1.0;     ///< makes the gradient of function() at ξ = η = 0 one unit long
  double residual = 0.0;  ///< see CellSurface

  /// Sets the scale by the slopes.
  void normalise() {
    scale = 1.0 / std::sqrt(1.0 + coefficients[power(1, 0)] * coefficients[power(1, 0)] +
                            coefficients[power(0, 1)] * coefficients[power(0, 1)]);
  }
  /// (ζ - q) scale: negative in the material.
  [[nodiscard]] double function(const Vec3& x) const {
    return (dot(frame[2], x) - value_of(coefficients, dot(frame[0], x), dot(frame[1], x))) * scale;
  }
  [[nodiscard]] FunctionJet jet(const Vec3& x) const;
};

/// What a cell owns: no surface, one graph, or the mean of several where columns along several axes
/// have the same right.
struct LocalSurface {
  CellSurfaceSource source = CellSurfaceSource::none;
  int count = 0;
  int axis = -1;  ///< of the first graph's columns
  std::array<Graph, 3> graphs{};

  [[nodiscard]] double function(const Vec3& x) const;
  [[nodiscard]] FunctionJet jet(const Vec3& x) const;
};

/// The point of a surface next to the cell's centre, to second order.
template <class Surface>
[[nodiscard]] Vec3 foot_of(const Surface& surface) {
  constexpr int kSteps = 2;
  Vec3 x{0.0, 0.0, 0.0};
  for (int n = 0; n < kSteps; ++n) {
    const FunctionJet jet = surface.jet(x);
    x = minus(x, scaled(jet.gradient, jet.value / squared_length(jet.gradient)));
  }
  return x;
}

/// Of the level set through a point, in 1 / unit; positive where the material is convex.
struct LevelCurvature {
  double mean;
  double gaussian;

  /// Half the difference of the principal ones.
  [[nodiscard]] double spread() const;
};
[[nodiscard]] LevelCurvature curvature_of(const FunctionJet& jet);

}  // namespace difmesh::detail
