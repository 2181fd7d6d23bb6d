#pragma once
/// \file draco_options.hpp
/// How Draco compresses a mesh, alone (.drc) or within glTF.

#include <cstdint>

namespace difmesh {

enum class DracoMethod : std::uint8_t {
  edgebreaker,  ///< smallest; vertices and triangles come in another order, triangles without area
                ///< by their indices are left out
  sequential,   ///< keeps the order of vertices and triangles; some three times as large
};

/// Coordinates become whole numbers of steps; a step is the longest side of the bounding box
/// divided by 2^bits - 1, and no coordinate is off by more than half of it, float32 rounding aside.
struct DracoOptions {
  /// 1 to 24; 0: as many as keep that half step within a thousandth of `cell_size`.
  int position_bits = 0;
  /// The Δx of the rule above, in the unit of the mesh; 0: the mean length of the triangles' edges.
  double cell_size = 0.0;
  int normal_bits = 10;   ///< 2 to 24, per coordinate of an octahedron; 10 are off by up to 0.25°
  int generic_bits = 12;  ///< 1 to 24: scalars, in steps of their range divided by 2^bits - 1
  int speed = 5;          ///< 0 small to 10 fast, for encoding and decoding
  DracoMethod method = DracoMethod::edgebreaker;
};

}  // namespace difmesh
