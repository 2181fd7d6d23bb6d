#pragma once
/// \file differences.hpp
/// How far apart points are that should be the same.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "difmesh/mesh.hpp"

namespace difmesh::test {

/// In any coordinate.
inline double largest_difference(const Vec3& a, const Vec3& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Of points or vectors of the same place in both.
inline double largest_difference(const Array<Vec3>& a, const Array<Vec3>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    largest = std::max(largest, largest_difference(a[v], b[v]));
  }
  return largest;
}

}  // namespace difmesh::test
