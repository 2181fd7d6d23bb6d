#include "placement/linear.hpp"

#include "placement/placement.hpp"

namespace difmesh::detail {

// outer < 1/2 <= inner: their difference is positive, and the result in (0,1].
double linear_position(double outer, double inner) {
  return (0.5 - outer) / (inner - outer);
}

const PlacementPart kLinear{false, false, 1, place_each<linear_position>};

}  // namespace difmesh::detail
