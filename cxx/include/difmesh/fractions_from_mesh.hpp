#pragma once
/// \file fractions_from_mesh.hpp
/// The way back: exact volume fractions of the inside of a closed triangle mesh.

#include <array>
#include <cstdint>
#include <span>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/names.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

/// What to do where parts of a mesh overlap: where the winding number w, which counts how often a
/// point is inside, exceeds 1.
enum class Overlaps : std::uint8_t {
  unite,   ///< γ is the share of a cell with w >= 1
  refuse,  ///< fail, and name a cell
  count,   ///< γ is the mean of w over the cell: not clamped, may exceed 1 or be negative
};
/// Their words; see names.hpp.
inline constexpr std::array<Named<Overlaps>, 3> kOverlaps{
    {{"union", Overlaps::unite}, {"refuse", Overlaps::refuse}, {"count", Overlaps::count}}};

struct FractionsFromMeshOptions {
  /// The triangles are clockwise seen from outside: treat the mesh as turned inside out.
  bool flip = false;
  /// Demand that every edge is run along as often one way as the other. Edges match by the
  /// positions of their ends, so triangles need not share vertices. Off: a mesh with T-junctions or
  /// tiny cracks passes too, and only the columns' sums show whether it is closed; they may not
  /// show a hole that is seen edge-on along x.
  bool check_edges = true;
  Overlaps overlaps = Overlaps::unite;
  /// A column's sum may miss an integer by this before the call fails, and with Overlaps::refuse a
  /// share of a cell be covered twice or negatively; [1e-12, 0.25]. Raise it for a mesh that is
  /// slightly cracked.
  double tolerance = 1e-9;
  int threads = 0;    ///< 0: as many as the machine has; the result does not depend on it
  Progress progress;  ///< may be empty; see options.hpp
};

/// Where in the grid a mesh covers space more than once, or negatively, or may do so. Shares below
/// 1e-12 of a cell are rounding and do not count; without check_edges, nor do those below the
/// tolerance.
struct CoverReport {
  double volume = 0.0;      ///< in the unit of the grid; what is covered thrice counts twice
  std::int64_t cells = 0;   ///< that have some
  double largest = 0.0;     ///< in a cell, as a share of it
  Index3 cell{0, 0, 0};     ///< the first with the largest
  Vec3 low{0.0, 0.0, 0.0};  ///< corners of the box round all those cells
  Vec3 high{0.0, 0.0, 0.0};
};

/// Facts about one call.
struct FractionsFromMeshReport {
  std::int64_t pieces = 0;         ///< parts of triangles inside cells, counted cell by cell
  std::int64_t cells_touched = 0;  ///< cells that hold a piece; all others are exactly 0 or 1
  double lowest_raw = 0.0;         ///< least mean winding number of a cell; 0 if none was below
  double highest_raw = 1.0;        ///< greatest; 1 if none was above
  double largest_gap = 0.0;        ///< largest distance of a column's sum from its integer
  double fraction_volume = 0.0;    ///< Σγ|K| over the cells, in the unit of the grid
  double mesh_volume = 0.0;        ///< ∫w of the whole mesh, within the grid or not
  CoverReport overlap;             ///< ∫max(w - 1, 0): covered more than once
  CoverReport inverted;            ///< ∫max(-w, 0): pockets that are inside out
  CoverReport undecided;           ///< where w was not found out: a bound for the error of Σγ|K|,
                                   ///< of ∫max(w - 1, 0) and, in a cell, of γ
  struct Seconds {                 ///< wall time by phase
    double check = 0.0;            ///< vertices, indices, edges, volume
    double bin = 0.0;              ///< triangles to rows of cells
    double clip = 0.0;             ///< clipping, sums, writing of the field
    double total = 0.0;
  } seconds;
};

struct FractionsFromMesh {
  Array<double> fractions;  ///< one per cell of the grid, x fastest; [0,1] unless `count`
  FractionsFromMeshReport report;
};

/// Volume fractions γ = |K ∩ Ω| / |K| of all cells K of a grid, Ω being the inside of a closed mesh
/// whose triangles are counter-clockwise seen from outside, as those of reconstruct() are.
///
/// No sampling and no inside test: each triangle is clipped to the cells it meets. A piece in a
/// cell adds the volume beyond itself to the cell, and its area projected along x to all cells
/// beyond it, by one running sum per column (divergence theorem; docs/method.md, "Making fields").
/// - Several components and hollow ones are fine, and those that overlap, touch or cut themselves:
///   Ω is where the winding number is 1 or more (see Overlaps; docs/method.md). Overlaps are found
///   and reported whatever the grid, also within a cell.
/// - Pockets inside out (w < 0) of up to a thousandth of the volume in the grid are outside.
/// - Cells in which surfaces cross are cut up, the finer the more triangles they hold: exact to
///   1e-12, or 1e-15 for each piece in the cell if that is more, and for what is `undecided`:
///   usually nothing, but twenty surfaces that cross within a ten-thousandth of a cell, or hundreds
///   farther apart, may need more effort than is granted for each of its pieces.
/// - The grid cuts off what lies outside it. A mesh that surrounds the grid gives 1 everywhere, one
///   beside it 0.
/// - Triangles, edges and vertices may lie exactly on faces of cells.
/// - Accuracy: γ is that of a closed surface within 2^-50 n spacings of the mesh, where n is its
///   largest coordinate in spacings from the grid's origin (2e-13 for n = 256), and usually much
///   closer. Fractions within 2^-51 max(dims) of 0 or 1 become 0 or 1; cells without a piece are
///   exactly 0 or 1.
/// - The fractions have the same bits for any number of threads and any order of the triangles.
///
/// \param positions finite, less than 2^32 spacings away from the grid's origin
/// \throw Error invalid_grid; too_large for 2^32 vertices or triangles; cancelled; invalid_argument
///   for options out of range, an empty mesh, a vertex not finite or too far away, an index out of
///   range, an open mesh (an edge and its triangle are named, and where the grid sees the hole
///   along x the first column and its gap; without check_edges the latter alone), mixed orientation
///   (two triangles are named), a mesh that is inside out (see `flip`), or parts that are (a cell
///   is named) or that overlap (Overlaps::refuse; a cell is named) or may do so by more than the
///   tolerance, being undecided.
/// Cost: O(pieces + cells), 50 to 150 ns per piece and up to 3 ns per cell on one core; 0.01 to 0.2
/// ms per piece in cells in which surfaces cross, and some 10 at most. Memory beyond the field:
/// 53 bytes per vertex, 12 per triangle and 4 more for each layer of cells that it meets, and 1 MB
/// per thread (more where rows have over 32,000 cells), and 1 kB for each piece of a cell in which
/// surfaces cross. Thread safety: concurrent calls are safe.
[[nodiscard]] FractionsFromMesh fractions_from_mesh(const Grid& grid,
                                                    std::span<const Vec3> positions,
                                                    std::span<const Triangle> triangles,
                                                    const FractionsFromMeshOptions& options = {});

}  // namespace difmesh
