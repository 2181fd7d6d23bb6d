#pragma once
// What a cell is given: a plane in the unit cube about its centre.

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// The plane m·u = a of a cell in the unit cube about its centre; the material is m·u <= a. A cell
/// that is full or empty has m = 0 and a = 1 or -1. One without a gradient has m = 0 and a = γ -
/// 1/2: its normal is taken along whichever edge is asked about. The centre is inside the material,
/// a >= 0, exactly where γ >= 1/2: see offset_of_share(). Kernels read it as four doubles.
struct UnitPlane {
  Vec3 m{0.0, 0.0, 0.0};
  double a = 0.0;

  [[nodiscard]] bool has_normal() const { return m[0] != 0.0 || m[1] != 0.0 || m[2] != 0.0; }
  /// The one test for the side on which the centre, or what trace() made of it, lies.
  [[nodiscard]] bool is_centre_inside() const { return a >= 0.0; }
  [[nodiscard]] static UnitPlane pure(bool inside) {
    return {{0.0, 0.0, 0.0}, inside ? 1.0 : -1.0};
  }
};

static_assert(sizeof(UnitPlane) == 4 * sizeof(double));

}  // namespace difmesh::detail
