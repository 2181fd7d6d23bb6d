#pragma once
/// \file curvature.hpp
/// Mean and Gaussian curvature at the vertices of a triangle mesh.

#include <cstdint>
#include <span>

#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

struct CurvatureOptions {
  /// Neighbours whose positions are fitted: those up to so many edges away; [1, 8].
  int rings = 2;
  bool principal = false;  ///< fill Curvature::largest and smallest
  int threads = 0;         ///< at most this many, 0: as the machine has; changes no bit
  Progress progress = {};  ///< may be empty; see options.hpp
};

/// Curvatures of the surface near each vertex, in 1 / unit of the positions, squared for the
/// Gaussian. Bodies whose triangles are counter-clockwise seen from outside curve positively where
/// they are convex: a ball of radius R has mean curvature 1/R, a bubble in a full domain -1/R.
struct Curvature {
  Array<double> mean;      ///< one per vertex: half the sum of the principal curvatures, or NaN
  Array<double> gaussian;  ///< one per vertex: their product, or NaN
  Array<double> largest;   ///< empty, or one per vertex: the larger principal curvature, or NaN
  Array<double> smallest;  ///< empty, or one per vertex: the smaller, or NaN
  /// Vertices with NaN: isolated ones, those on parts of fewer than six vertices, and those whose
  /// neighbours determine no patch however many rings are added (all on two lines, for instance).
  std::int64_t undefined_vertices = 0;
  /// Vertices that needed more than the rings asked for, most of them on boundaries.
  std::int64_t widened_vertices = 0;
};

/// Fits a parabolic patch, h(x,y) = c0 + c1 x + c2 y + c3 x^2 + c4 xy + c5 y^2 over the plane
/// across the normal, to the vertices of two rings by least squares, and takes the curvatures of
/// the patch at the foot of the vertex.
/// - The patch need not pass through the vertex, and its normal becomes the frame's axis of the
///   next fit until both agree; the first is the mean of the triangles' normals by area.
/// - Weights fall with the distance r from the vertex, (1 - r²/(1.1 r_max²))². Against equal ones
///   they bring the rms error on surfaces of `plic` down by up to a third (docs/method.md).
/// - Where fewer than 12 neighbours are found, as at boundaries, or they do not determine the
///   patch, rings are added one by one, as far as the mesh is connected.
/// - Exact, but for rounding, where the surface is such a patch in the frame of the vertex: on
///   planes, and at the apex of paraboloids. Elsewhere the error shrinks with the square of the
///   edges' length where neighbours lie all round the vertex evenly, and with their length where
///   they do not, as on boundaries. At `open` sides surfaces by `plic` end in half a cell of plane:
///   the curvature of the vertices there may be off by as much as itself. Boundary loops of
///   `periodic` sides are fitted from their side alone.
/// - Coordinates scaled by a power of two scale the results, without change of a bit.
/// - Any triangles will do: what is not manifold, folded or noise gives finite numbers or NaN,
///   which tell little.
///
/// \throw Error invalid_argument for options out of range, an index out of range (the triangle is
///   named) or a position that is not finite (the vertex is named); too_large beyond 2^32 - 1
///   vertices; cancelled
/// Cost: O(sum of the neighbours); some 2 µs per vertex on one thread for two rings of 18. A vertex
/// with n neighbours costs each of them n, so fans of many thousands of triangles are slow. Memory
/// beyond the result: some 100 bytes per vertex. Thread safety: concurrent calls are safe.
/// Source: the procedure of E19 (options.hpp), figures 8-10; curvatures of a graph: M. P. do Carmo,
/// Differential Geometry of Curves and Surfaces, 1976, section 3-3.
[[nodiscard]] Curvature curvature(std::span<const Vec3> positions,
                                  std::span<const Triangle> triangles,
                                  const CurvatureOptions& options = {});
[[nodiscard]] inline Curvature curvature(const Mesh& mesh, const CurvatureOptions& options = {}) {
  return curvature(mesh.positions, mesh.triangles, options);
}

}  // namespace difmesh
