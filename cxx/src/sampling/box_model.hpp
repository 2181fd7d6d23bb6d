#pragma once
// Parabolas through the samples of a box: where roots are to be expected, and how far f stays
// smooth.

#include <array>
#include <cstddef>

#include "sampling/sampled_box.hpp"

namespace difmesh::detail {

struct ParabolaRoot {
  double t = 0.0;
  double slope = 0.0;  ///< of the parabola there
};

/// The root at which c0 + c1 t + c2 t^2 rises (or falls, if not `rising`). May be NaN where there
/// is none.
[[nodiscard]] ParabolaRoot parabola_root(double c0, double c1, double c2, bool rising);

/// The parabolas through the samples of a box, multiplied out over the axes (along, across,
/// height), in this order. Coordinates run from 0 to 1.
class BoxModel {
 public:
  BoxModel() = default;
  BoxModel(const SampledBox& box, const GraphAxes& axes);

  /// Coefficients of across^j height^k, at j + 3 k, for a fixed coordinate along.
  [[nodiscard]] std::array<double, 9> slice(double along) const;
  /// Distance from the middle of the box to where a circle with the model's slope and curvature
  /// stands vertical: for the surface over `direction` (0 along, 1 across) ...
  [[nodiscard]] double surface_reach(std::size_t direction) const;
  /// ... and for its cut with the face at height 0 or 1, as a curve over `along`.
  [[nodiscard]] double cut_reach(std::size_t face) const;

 private:
  struct Derivatives {
    double x, h, xx, xh, hh;
    [[nodiscard]] double reach(double aspect) const;
  };
  [[nodiscard]] Derivatives derivatives(std::size_t centre, std::size_t x, std::size_t h) const;

  std::array<double, 27> sample_{};
  std::array<double, 27> coefficient_{};
  Vec3 side_{};
};

}  // namespace difmesh::detail
