#pragma once
// What a placement is to the rest of the library. A new one is a file with its constant, and a line
// in placement.cpp.

#include <cstdint>

#include "difmesh/options.hpp"

namespace difmesh::detail {

/// Crossed dual edges by the fractions of their two cells: outer < 1/2 <= inner.
struct FractionBatch {
  const double* outer;
  const double* inner;
  double* position;  ///< from the outer cell to the inner one, in [0,1]
  int count;
};

/// How the vertices of crossed dual edges are put.
struct PlacementPart {
  /// Whether a vertex lies where the window over the planes of both cells is half full (see
  /// planes/window.hpp). Else it follows from their fractions alone, and place() says where.
  bool by_planes;
  /// Whether the curved surfaces of the cells come before the window; needs by_planes.
  bool by_surfaces;
  /// Layers of cells beyond a block of which it reads what by_planes says.
  std::int64_t reach;
  /// Null where it is by planes: surface/window_queue.hpp takes those edges in batches.
  void (*place)(const FractionBatch& edges);
};

/// PlacementPart::place of placements that are a formula for one edge.
template <double (*kPosition)(double outer, double inner)>
void place_each(const FractionBatch& edges) {
  for (int n = 0; n < edges.count; ++n) {
    edges.position[n] = kPosition(edges.outer[n], edges.inner[n]);
  }
}

/// \pre a value of the enumeration
[[nodiscard]] const PlacementPart& placement_part(Placement placement);

/// Layers of cells beyond a block on which its mesh depends, at most ghost_layers(placement).
/// \pre placement and normals are values of their enumerations
[[nodiscard]] std::int64_t layers_read(const Options& options);

extern const PlacementPart kMidpoint;
extern const PlacementPart kLinear;
extern const PlacementPart kManson;
extern const PlacementPart kPlic;
extern const PlacementPart kCurved;

}  // namespace difmesh::detail
