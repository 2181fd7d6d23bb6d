#pragma once
// The case table of marching cubes: which triangles a dual cell holds, for every set of inside
// corners and every decision of its ambiguous faces. Generated at compile time by the rule in
// case_table.cpp.
//
// Numbers. Corner c in 0..7: bits 0, 1, 2 are x, y, z, 1 on the high side. Edge e in 0..11 is
// 4 * axis + b, where bits 0 and 1 of b are the coordinates along the two other axes, in increasing
// axis order. Face f in 0..5 is 2 * axis + side. A cell has one vertex on each crossed edge,
// anywhere strictly between its ends.
//
// Promised, and proved for all positions of the vertices by case_table_test:
// - Each loop of contour segments is filled by a disk with no further vertices: a loop of n
//   vertices has n - 2 triangles, counter-clockwise seen from the outside corners.
// - Two triangles of a cell meet in their common vertices and edges only.
// - A diagonal lies on a face of the cell only where no filling without it is valid (152 of the 656
//   cases), and then cuts a face corner that the cell beyond never cuts: see face_cut_allowed(). So
//   no two cells share a diagonal, the mesh is edge-manifold, and triangles of two cells meet in
//   the contour of their common face only. No triangle lies flat on a face.
// - Exchanging inside and outside, and joined and separated, turns the triangles around, no more.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace difmesh::detail {

inline constexpr unsigned kCubeCorners = 8;
inline constexpr unsigned kCubeEdges = 12;
inline constexpr unsigned kCubeFaces = 6;

/// `rest` with a further bit, `value`, at place `axis`: a corner from its coordinates along an axis
/// and along the two others.
[[nodiscard]] constexpr unsigned insert_coordinate(unsigned rest, unsigned axis, unsigned value) {
  const unsigned below = (1U << axis) - 1U;
  return (rest & below) | (value << axis) | ((rest & ~below) << 1U);
}

[[nodiscard]] constexpr unsigned edge_axis(unsigned edge) {
  return edge / 4U;
}

[[nodiscard]] constexpr unsigned edge_low_corner(unsigned edge) {
  return insert_coordinate(edge % 4U, edge_axis(edge), 0U);
}

[[nodiscard]] constexpr unsigned edge_high_corner(unsigned edge) {
  return insert_coordinate(edge % 4U, edge_axis(edge), 1U);
}

/// The edge between two corners that differ in one bit.
[[nodiscard]] constexpr unsigned edge_between(unsigned corner, unsigned other) {
  const auto axis = static_cast<unsigned>(std::countr_zero(corner ^ other));
  const unsigned below = (1U << axis) - 1U;
  return 4U * axis + ((corner & below) | ((corner >> 1U) & ~below));
}

/// Bits of the two faces that hold the edge.
[[nodiscard]] constexpr unsigned edge_faces(unsigned edge) {
  unsigned faces = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned side = (edge_low_corner(edge) >> axis) & 1U;
    if (axis != edge_axis(edge)) faces |= 1U << (2U * axis + side);
  }
  return faces;
}

/// The four corners, by rising coordinates, the lower axis running fastest: 0 and 3 are opposite, 1
/// and 2 too. The same places in the same order from both cells at the face.
[[nodiscard]] constexpr std::array<unsigned, 4> face_corners(unsigned face) {
  std::array<unsigned, 4> corners{};
  for (unsigned i = 0; i < 4; ++i) {
    corners[i] = insert_coordinate(i, face / 2U, face % 2U);
  }
  return corners;
}

/// True where the cell may draw a diagonal on an ambiguous face between the two face edges that end
/// in `corner`. Of the two corners that such diagonals can cut, one is for the cell below the face
/// and the other for the cell above: a cell takes the one whose coordinate along the face's next
/// axis (x, y, z, x ...) equals the side on which the face lies.
[[nodiscard]] constexpr bool face_cut_allowed(unsigned face, unsigned corner) {
  const unsigned next_axis = (face / 2U + 1U) % 3U;
  return ((corner >> next_axis) & 1U) == face % 2U;
}

/// Three edges, whose vertices span the triangle.
using CubeTriangle = std::array<std::uint8_t, 3>;
using CubeTriangles = std::span<const CubeTriangle>;

/// What the eight corners alone decide.
struct CubeCase {
  std::uint16_t crossed_edges;
  std::uint16_t first_decision;  ///< row of kFirstTriangle, all ambiguous faces separated
  std::uint8_t ambiguous_faces;
};

/// All decisions of the ambiguous faces, over all sets of inside corners, and their triangles.
inline constexpr unsigned kCubeDecisions = 656;
inline constexpr unsigned kCubeTriangleCount = 3204;

extern const std::array<CubeCase, 256> kCubeCases;
extern const std::array<std::uint16_t, kCubeDecisions + 1> kFirstTriangle;
extern const std::array<CubeTriangle, kCubeTriangleCount> kCubeTriangles;

/// Bits of the faces whose corners alternate between inside and outside.
[[nodiscard]] inline std::uint8_t ambiguous_faces(std::uint8_t corners) {
  return kCubeCases[corners].ambiguous_faces;
}

/// Bits of the edges with one end inside.
[[nodiscard]] inline std::uint16_t crossed_edges(std::uint8_t corners) {
  return kCubeCases[corners].crossed_edges;
}

/// The triangles of a cell, at most 10. Bits of `joined`: the ambiguous faces across which the two
/// inside corners are connected; those of other faces are ignored.
[[nodiscard]] inline CubeTriangles cube_triangles(std::uint8_t corners, std::uint8_t joined) {
  const CubeCase& cube = kCubeCases[corners];
  unsigned decision = cube.first_decision;
  unsigned place = 1;
  for (unsigned faces = cube.ambiguous_faces; faces != 0; faces &= faces - 1U, place <<= 1U) {
    if ((joined & faces & (~faces + 1U)) != 0) decision += place;
  }
  const std::uint16_t first = kFirstTriangle[decision];
  return {kCubeTriangles.data() + first,
          static_cast<std::size_t>(kFirstTriangle[decision + 1U] - first)};
}

}  // namespace difmesh::detail
