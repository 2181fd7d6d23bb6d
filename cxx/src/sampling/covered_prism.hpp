#pragma once
// How much of a box is covered how often, by the pieces of surface in it and those before it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// A part of a triangle in a box: a convex polygon. Coordinates are relative to a cell.
struct CellPiece {
  static constexpr std::size_t kMost = 16;

  std::array<Vec3, kMost> corners{};
  std::size_t size = 0;
  std::uint32_t triangle = 0;
};

struct UnitBox {
  Vec3 low{0, 0, 0};
  Vec3 high{1, 1, 1};

  [[nodiscard]] double volume() const {
    return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
  }
};

/// Volumes by the winding number w.
struct Covered {
  double once = 0.0;       ///< of {w >= 1}
  double again = 0.0;      ///< the integral of max(w - 1, 0)
  double inverted = 0.0;   ///< the integral of max(-w, 0)
  double undecided = 0.0;  ///< where w is not known; the others may be off by as much

  void add(double volume, double winding) {
    once += winding >= 1.0 ? volume : 0.0;
    again += winding > 1.0 ? (winding - 1.0) * volume : 0.0;
    inverted += winding < 0.0 ? -winding * volume : 0.0;
  }
  void add(const Covered& other) {
    once += other.once;
    again += other.again;
    inverted += other.inverted;
    undecided += other.undecided;
  }
};

/// Where the winding number, whose integral is known, takes two neighbouring values.
[[nodiscard]] inline Covered from_sum(double volume, double sum) {
  return {std::clamp(sum, 0.0, volume), std::max(sum - volume, 0.0), std::max(-sum, 0.0), 0.0};
}

/// All that decides the winding number in a box: a line along x meets first pieces before the box
/// and then those in it.
struct CoveredBox {
  UnitBox box;
  std::vector<CellPiece> inside;
  std::vector<CellPiece> before;  ///< cut to the y and z of the box; their x is of no matter
  double base = 0.0;              ///< winding number before all pieces
  /// +1: the winding number falls where a triangle faces along x, as it does on leaving a body
  double sign = 1.0;
};

/// Exact but for rounding, about 1e-15 of the cell for each piece. The face of the box along x is
/// cut along the projected edges of the pieces, and along the lines where pieces meet, into convex
/// parts over which nothing crosses. Cost grows fast with the number of pieces.
/// \param effort the steps that it may take, about 10 ns each; lowered by those that it took
/// \return none where that is too few
[[nodiscard]] std::optional<Covered> covered_volumes(const CoveredBox& box, std::int64_t& effort);

}  // namespace difmesh::detail
