#pragma once
// The phases of a reconstruction: what each makes, for messages, and its share of the work, for
// progress.

namespace difmesh::detail {

struct Phase {
  const char* makes;
  double weight;
};

inline constexpr Phase kInsideBits{"the inside bits", 0.1};
inline constexpr Phase kPlanes{"the planes", 0.1};
inline constexpr Phase kSurfaces{"the curved surfaces", 1.6};
inline constexpr Phase kCurving{"the curved vertices", 0.4};
inline constexpr Phase kCounts{"the counts", 0.07};
inline constexpr Phase kVertices{"the vertices", 0.6};
inline constexpr Phase kTriangles{"the triangles", 0.1};
inline constexpr Phase kVolume{"the volume", 0.03};

/// Of all weights, where cells own curved surfaces; else it is 1.
inline constexpr double kWeightWithSurfaces = 3.0;

}  // namespace difmesh::detail
