#pragma once
/// \file vec3.hpp
/// Triples of indices and of coordinates.

#include <array>
#include <cstdint>

namespace difmesh {

using Index3 = std::array<std::int64_t, 3>;  ///< (i,j,k): x, y, z in this order
using Vec3 = std::array<double, 3>;          ///< (x,y,z)

}  // namespace difmesh
