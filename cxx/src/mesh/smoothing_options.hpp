#pragma once
// Checks that all kinds of smoothing share.

#include <string>

#include "difmesh/error.hpp"
#include "difmesh/smoothing.hpp"

namespace difmesh::detail {

inline void check_steps(const std::string& caller, int steps) {
  constexpr int kMostSteps = 1000000;
  if (steps < 0 || steps > kMostSteps) {
    throw Error(ErrorCode::invalid_argument, caller + ": steps must be 0 to " +
                                                 std::to_string(kMostSteps) + ", got " +
                                                 std::to_string(steps));
  }
}

inline void check_boundary(const std::string& caller, BoundaryVertices boundary) {
  if (boundary > BoundaryVertices::along) {
    throw Error(ErrorCode::invalid_argument, caller + ": unknown rule for boundary vertices");
  }
}

}  // namespace difmesh::detail
