#pragma once
/// \file fractions_from_function.hpp
/// Making fields: volume fractions of the region {f < 0} of an implicit function, by quadrature.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

/// Writes f(points[i]) to values[i] for a batch of points; both spans have the same length, >= 1.
using FunctionBatch = std::function<void(std::span<const Vec3> points, std::span<double> values)>;
/// Writes the gradient of f, in f's unit per unit of length, likewise.
using GradientBatch = std::function<void(std::span<const Vec3> points, std::span<Vec3> gradients)>;

struct FractionsFromFunctionOptions {
  /// Absolute error aimed at in the fraction of each cell; [1e-13, 1e-2]. Where f is smooth the
  /// true error is usually ten times less. Rounding in x and f(x) limits it to some 1e-15 |x| over
  /// the spacing.
  double tolerance = 1e-10;
  /// The same where f turns out to have a kink in a cell, if that is larger; [1e-13, 1e-2]. Two
  /// digits more cost about twice as many evaluations there. The true error mostly is ten times
  /// less, but a kink that cuts off no more than a corner of a cell may go unseen: of 1230 cells
  /// that the rims of a golf ball crossed, 8 were off by more than 1e-5, one by 8e-5.
  double kink_tolerance = 1e-5;
  /// Where a cell has used up this many evaluations, what is left of it is estimated roughly and
  /// the cell counts as unresolved; [1000, 1e9].
  std::int64_t max_calls_per_cell = 200'000;
  /// May be empty. Used to tell more surely whether the surface is a graph over a face of a cell,
  /// at nine evaluations per cell; worth it only where f is known to wiggle within a cell.
  GradientBatch gradient;
  /// 0: as many as the machine has; the result does not depend on it. f and its gradient are called
  /// from several threads at once unless this is 1.
  int threads = 0;
  /// May be empty. Always called on the calling thread; at least 20 times in grids of 20 layers.
  /// See options.hpp.
  Progress progress;
};

/// Facts about one call.
struct FractionsFromFunctionReport {
  std::int64_t interfacial_cells = 0;  ///< 0 < γ < 1
  std::int64_t sampled_cells = 0;      ///< cells that were looked at beyond their corners
  std::int64_t subdivided_cells = 0;   ///< of these, bisected at least once
  std::int64_t unresolved_cells = 0;   ///< of these, out of calls before the tolerances were met
  /// Of a cell's fraction; pessimistic where f is smooth.
  double largest_error_estimate = 0.0;
  std::int64_t function_calls = 0;  ///< points at which f was evaluated, lattice_calls included
  std::int64_t lattice_calls = 0;   ///< one per corner of the grid's cells
  std::int64_t gradient_calls = 0;  ///< points at which the gradient was evaluated
  /// (function_calls - lattice_calls) / interfacial_cells.
  double calls_per_interfacial_cell = 0.0;
  double fraction_volume = 0.0;  ///< Σγ|K| over the cells, in the unit of the grid
  struct Seconds {               ///< wall time by phase
    double lattice = 0.0;        ///< corner values, and which cells may hold surface
    double quadrature = 0.0;     ///< the cells that may
    double total = 0.0;
  } seconds;
};

struct FractionsFromFunction {
  /// One per cell, in [0,1], x fastest: FieldView::x_fastest(fractions.data(), grid.dims).
  Array<double> fractions;
  FractionsFromFunctionReport report;
};

/// Volume fractions γ = |K ∩ {f < 0}| / |K| of all cells K of a grid. f = 0 counts as outside.
/// Fractions within the rounding of coordinates of 0 or 1 become 0 or 1, so a surface on cell faces
/// gives exactly these beside it.
///
/// f is evaluated once per corner of the cells, never outside the grid. Cells that the surface may
/// meet are sampled at 27 points. In a box where f is monotone along one axis (the one with the
/// largest ratio of its least slope to the greatest ones along the others), the surface is a height
/// over the opposite face: heights are found by root finding at Gauss-Legendre nodes, between
/// limits that are themselves roots on faces and edges, so that each integrand is smooth; intervals
/// whose Legendre coefficients do not fall off fast enough get more nodes or are cut, at kinks if
/// there are any. Other boxes are bisected.
///
/// f need not be a distance: any continuous function will do. Cost is least where it is smooth and
/// its gradient does not vanish on the surface. What is assumed:
/// - Between sample points f bends at most about four times as much as the second differences of
///   its samples next to them show: over the corners of the cells first, at half that distance
///   within the cells so found. A droplet, shell, hole or bulge smaller than a cell is found on
///   that condition; a feature that leaves no trace in f at the corners of the cells around it is
///   not (a union by min() of distances leaves one, a bump of compact support may not), and of a
///   film written as |d| - t parts may be lost if t is less than a twentieth of a cell.
/// - In a box with samples of both signs, monotonicity is judged by the 27 samples (and nine
///   gradients, where given).
/// \throw Error invalid_grid, too_large; invalid_argument for options out of range or an empty f;
///   invalid_value where f or its gradient is NaN or infinite (point and cell are named: the first
///   corner or else the first cell in the order z, y, x); cancelled. What f throws passes through.
/// Cost: for a sphere, R / spacing = 16 to 64, tolerance 1e-10: 55 to 120 evaluations and 3 to 4 µs
/// per interfacial cell on one core, 15 ns per cell of the grid; some thousands of evaluations in a
/// cell with a kink, and up to max_calls_per_cell where faces that meet there are steep all ways.
/// Memory beyond the field: some 100 bytes per interfacial cell and 50 MB. Thread safety:
/// concurrent calls are safe if f allows it. The result does not depend on the number of threads.
/// Source: the idea of VofI: Bnà, Manservisi, Scardovelli, Yecko, Zaleski, Comput. Phys. Commun.
/// 200 (2016) 291; nesting of roots on faces and edges: Saye, SIAM J. Sci. Comput. 37 (2015) A993.
[[nodiscard]] FractionsFromFunction fractions_from_function(
    const Grid& grid, const FunctionBatch& f, const FractionsFromFunctionOptions& options = {});

/// A function of one point as a function of batches. The callable is copied.
template <class F>
requires std::is_invocable_r_v<double, const F&, const Vec3&>
[[nodiscard]] FunctionBatch batch_of(F f) {
  return [f = std::move(f)](std::span<const Vec3> points, std::span<double> values) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      values[i] = f(points[i]);
    }
  };
}

/// As above for a callable double(const Vec3&), say a lambda.
template <class F>
requires std::is_invocable_r_v<double, const F&, const Vec3&>
[[nodiscard]] FractionsFromFunction fractions_from_function(
    const Grid& grid, F f, const FractionsFromFunctionOptions& options = {}) {
  return fractions_from_function(grid, batch_of(std::move(f)), options);
}

}  // namespace difmesh
