#pragma once
/// \file options.hpp
/// The choices of a reconstruction. The defaults are meant to be used.

#include <array>
#include <cstdint>

#include "difmesh/progress.hpp"

namespace difmesh {

/// Where a vertex is put on its dual edge. Source: method of Evrard, Denner, van Wachem, IEEE TVCG
/// 2019 (E19); Manson, Smith, Schaefer, Eurographics 2011.
enum class Placement : std::uint8_t {
  midpoint,  ///< middle of the edge
  linear,    ///< linear interpolation of the fractions: what plain marching cubes does
  manson,    ///< Manson et al., four cases from the two fractions alone
  plic,      ///< E19: half-full window over the planes of both cells; second-order accurate
  /// The curved surfaces of both cells (cell_surfaces.hpp), or plic where they have none or
  /// contradict each other; of fourth order and more where surfaces are smooth. Vertex normals are
  /// theirs. Blocks need kCurvedGhostLayers. Source: docs/method.md, "Curved cell surfaces".
  curved,
};

/// How the normal of an interfacial cell is estimated.
enum class Normals : std::uint8_t {
  youngs,  ///< weighted gradient on 3x3x3 cells
  myc,     ///< mixed Youngs-centred on 3x3x3 cells (Aulisa et al., J. Comput. Phys. 2007)
  /// 3x3 columns of 9 cells where consistent, myc elsewhere; instead of it at open sides, and on
  /// stretched axes everywhere, the plane that suits the neighbours' fractions best.
  height_function,
  /// The plane whose fractions in 3x3x3 cells differ least, in squares, from those there, among 27
  /// by differences of columns of 5 and myc's (after Pilliod & Puckett, J. Comput. Phys. 199 (2004)
  /// 465). Exact for planes two cells away from open sides. 7 to 9 µs per cell.
  elvira,
  /// The same among all planes near myc's, by Gauss-Newton steps; exact for planes. 1 to 2 µs per
  /// cell.
  lvira,
};

/// What lies beyond a side of the domain.
enum class Side : std::uint8_t {
  open,      ///< nothing is known: stencils are one-sided, the surface runs on to the domain face
  mirror,    ///< a symmetry plane: the surface meets the face at right angles
  periodic,  ///< wraps round, both sides of an axis together; see reconstruct.hpp
  empty,     ///< γ = 0: closes the surface
  full,      ///< γ = 1: closes the surface of the complement
};

/// One per side: xlo, xhi, ylo, yhi, zlo, zhi.
using Boundary = std::array<Side, 6>;

struct Options {
  Placement placement = Placement::plic;
  Normals normals = Normals::height_function;
  Boundary boundary{Side::open, Side::open, Side::open, Side::open, Side::open, Side::open};
  /// γ <= this counts as empty, γ >= 1 - this as full, wherever that has to be decided; [0, 0.1].
  double purity_tolerance = 1e-6;
  /// Values in [-bound, 1 + bound] are clamped to [0,1] and counted; beyond it the call fails. In
  /// [0, 1].
  double overshoot_bound = 0.1;
  /// Vertices stay at least this share of the edge's length away from its ends; [1e-13, 0.25].
  /// Larger values give fatter triangles where many fractions are exactly 1/2, and larger errors
  /// there.
  double clearance = 1e-12;
  bool vertex_normals = false;  ///< fill Mesh::normals
  bool edge_ids = false;        ///< fill Mesh::edge_ids
  int threads = 0;              ///< at most this many, 0: as the machine has; changes no bit
  Progress progress;            ///< may be empty
};

}  // namespace difmesh
