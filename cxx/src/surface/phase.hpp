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
inline constexpr Phase kCounts{"the counts", 0.07};
inline constexpr Phase kVertices{"the vertices", 0.6};
inline constexpr Phase kTriangles{"the triangles", 0.1};
inline constexpr Phase kVolume{"the volume", 0.03};

}  // namespace difmesh::detail
