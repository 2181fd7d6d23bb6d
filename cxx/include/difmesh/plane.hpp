#pragma once
/// \file plane.hpp
/// Planes in cuboid cells (PLIC): fraction from offset and offset from fraction. Usable alone.

#include <cstdint>

#include "difmesh/vec3.hpp"

namespace difmesh {

/// A plane {x : normal·(x - c) = offset}, c the centre of its cell; the material is where
/// normal·(x - c) <= offset.
struct Plane {
  Vec3 normal{0.0, 0.0, 0.0};  ///< unit vector out of the material
  double offset = 0.0;         ///< signed distance of the plane from the centre, in the grid's unit
};

/// Where the normal of a cell came from; see cell_planes.hpp.
enum class NormalSource : std::uint8_t {
  none,    ///< no gradient: a lone droplet cell, a film symmetric about the cell. Normal is 0
  youngs,  ///< weighted gradient
  centred_columns,  ///< centred differences of columns of three (MYC)
  height_function,  ///< differences of columns of nine
  /// Fitted to the neighbours' fractions: elvira, lvira, and, where it has no columns,
  /// height_function next to open sides and on stretched axes.
  least_squares,
};

/// Share of a cuboid cell of the given spacing that lies in {normal·(x - centre) <= offset}, in
/// [0,1]. Holds to 1e-14 for every direction and aspect ratios to 1000; the normal need not have
/// unit length (offset then is in units of normal·length).
/// \pre all finite, spacing > 0, normal not zero
/// Cost: some ten nanoseconds. Thread safety: pure.
/// Source: Scardovelli & Zaleski, J. Comput. Phys. 164 (2000) 228-237, in ordered piecewise form.
[[nodiscard]] double plane_fraction(const Vec3& normal, const Vec3& spacing,
                                    double offset) noexcept;

/// The inverse: the offset at which the cell has the given fraction, clamped to [0,1]. 0 and 1 give
/// planes that touch a corner of the cell. |plane_fraction(plane_offset(γ)) - γ| <= 1e-14.
/// \pre as above
/// Cost: up to a tenth of a microsecond. Thread safety: pure.
[[nodiscard]] double plane_offset(const Vec3& normal, const Vec3& spacing,
                                  double fraction) noexcept;

}  // namespace difmesh
