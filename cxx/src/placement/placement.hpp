#pragma once
// What a placement is to the rest of the library. A new one is a file with its constant, and a line
// in placement.cpp.

#include "difmesh/options.hpp"

namespace difmesh::detail {

/// How the vertex of a crossed dual edge is put.
struct PlacementPart {
  /// Where the window over the planes of both cells is half full; see planes/window.hpp. Else
  /// position() says where.
  bool by_planes;
  /// From the fractions of the two cells alone: the position from the outer cell (outer < 1/2) to
  /// the inner one (inner >= 1/2), in [0,1]. Null where it is by planes.
  double (*position)(double outer, double inner);
};

/// \pre a value of the enumeration
[[nodiscard]] const PlacementPart& placement_part(Placement placement);

extern const PlacementPart kMidpoint;
extern const PlacementPart kLinear;
extern const PlacementPart kManson;
extern const PlacementPart kPlic;

}  // namespace difmesh::detail
