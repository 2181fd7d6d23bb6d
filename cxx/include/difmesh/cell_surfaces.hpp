#pragma once
/// \file cell_surfaces.hpp
/// Curved surfaces of interfacial cells, and their curvature from fractions: what flow solvers need
/// for surface tension, without a mesh. Usable alone.

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "difmesh/field_view.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

/// What the surface of a cell is made of.
enum class CellSurfaceSource : std::uint8_t {
  none,           ///< the fractions around determine no smooth surface
  heights_13,     ///< heights of 13 columns: a quartic along both axes across them
  heights_25,     ///< heights of 25 columns: a biquartic
  quadratic_fit,  ///< a paraboloid fitted to the fractions within 2.1 cells
  quartic_fit,    ///< a quartic fitted to those within 3.2 cells
};

/// What the surfaces are for, which decides on what they are made of.
enum class CellSurfaceKind : std::uint8_t {
  /// 13 columns, else a paraboloid: the least error of position.
  position,
  /// 25 columns, else a quartic where cells are at most 1.5 times as long as wide, else 13 columns,
  /// else a paraboloid: the least error of curvature.
  curvature,
};

/// The surface in and around a cell, the graph ζ = q(ξ, η) over a plane through the cell's centre;
/// the material is below it, ζ < q.
///
/// Positions are told from the cell's centre in the unit of the grid, but for the graph's own
/// coordinates, which are counted in `length`. Curvatures are positive where the material is
/// convex: a drop of radius R has mean curvature 1/R. Without a source all numbers but `length` and
/// `residual` are 0 or NaN.
struct CellSurface {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  CellSurfaceSource source = CellSurfaceSource::none;
  /// Heights: 0 to 2, the axis that the columns run along; -1 else. Where two or three axes have
  /// the same right, the graph is that of the lowest, and everything else that of the mean of the
  /// functions ζ - q of all.
  int axis = -1;
  Vec3 foot{0.0, 0.0, 0.0};    ///< point of the surface next to the cell's centre, to second order
  Vec3 normal{0.0, 0.0, 0.0};  ///< there: unit vector out of the material
  double mean = kNone;         ///< there: half the sum of the principal curvatures
  double gaussian = kNone;     ///< their product
  double largest = kNone;      ///< the larger of them
  double smallest = kNone;     ///< the smaller
  /// How badly the fractions are explained. Heights: the largest difference in the 27 cells around
  /// from the surface's tangent planes; fits: the largest weighted difference from the surface. At
  /// most 0.03; NaN where no surface was tried to the end.
  double residual = kNone;
  double length = 0.0;          ///< cube root of the cell's volume
  std::array<Vec3, 3> frame{};  ///< unit vectors along ξ, η and ζ, orthogonal
  /// ζ / length = Σ coefficients[5 p + q] (ξ / length)^p (η / length)^q, p and q from 0 to 4
  std::array<double, 25> coefficients{};
};

/// Surfaces of the listed cells, by options.boundary and options.purity_tolerance; cells that are
/// as good as pure have none.
///
/// - Heights are sums of fractions, in lengths, along columns from the first full cell to the first
///   empty one, at most 5 cells away (6 for 25 columns); the columns' averages of the polynomial
///   equal the heights. They are taken along the axis of the largest component of Youngs' normal in
///   the unit cell, if all are consistent, monotone to 1e-9, their tangent planes explain the 27
///   cells around to 0.03, and quadratic heights of nine columns agree, where the slope is above
///   1/2 (above 0.7 for 25 columns).
/// - Fits minimise the squares of the differences of fractions, weighted by distance, with the
///   volume under the graph right to second order in its distance from the tangent plane, and right
///   to rounding in quadratic fits where it grazes faces of cells.
/// - Planes are exact to rounding, up to open sides, where fits take the cells that there are. Next
///   to these the nearly pure cells know theirs to some digits only, and the curvature of few cells
///   may be off by more than itself; so may it be where bodies have less than 4 cells per radius.
/// - Next to `mirror`, `periodic`, `empty` and `full` sides, cells beyond count as what is there.
///   On stretched axes fits work in space, and heights with the cells' widths.
///
/// On spheres the curvature of kind `curvature` is off by 3e-3 of itself (rms; at most 2e-2) at 8
/// cells per radius, 6e-4 (6e-3) at 26, 4e-5 (4e-4) at 64; the foot by 2e-4, 1e-5 and 3e-7 cells.
/// \param cells indices of cells in the grid; \param surfaces as many results
/// \throw Error as cell_planes(). The field is not validated; NaN count as 0.
/// Cost: on one thread 3 µs per cell where 13 heights hold, 6 µs for 25, 40 µs where a paraboloid
/// is fitted, some 200 µs for a quartic, and as much in vain on interfaces that are smeared over
/// many cells, of which none owns a surface; on options.threads threads.
/// Thread safety: concurrent calls are safe.
/// Source: docs/method.md, "Curved cell surfaces"; curvature of level sets: R. Goldman, Comput.
/// Aided Geom. Des. 22 (2005) 632-658.
void cell_surfaces(const FieldView& field, const Grid& grid, std::span<const Index3> cells,
                   CellSurfaceKind kind, const Options& options, std::span<CellSurface> surfaces);

}  // namespace difmesh
