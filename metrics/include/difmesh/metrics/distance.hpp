#pragma once
/// \file distance.hpp
/// How far a surface is from the truth: from a shape, or from a reference triangle mesh.

#include <cstdint>
#include <functional>
#include <span>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"

namespace difmesh {

class Shape;

/// Distance of a point from a shape's surface, in the unit of the mesh; negative inside.
using SignedDistance = std::function<double(const Vec3& point)>;

struct DistanceOptions {
  /// Facet points are at most this far from the next ones on their triangle, in the unit of the
  /// mesh. 0: triangles up to twice the usual size get four points, larger ones more; see
  /// distance().
  double facet_spacing = 0.0;
  /// Reference meshes: also measure from the reference to the mesh. One way alone cannot see what
  /// the mesh lacks.
  bool both_ways = true;
  /// Reference meshes: tell inside from outside where the reference is closed. Off saves little.
  bool with_sign = true;
  /// 0: as many as the machine has; no bit of the result depends on it. A SignedDistance is called
  /// from several threads at once unless this is 1.
  int threads = 0;
  Progress progress;  ///< may be empty; see options.hpp
};

/// Distances d of some points, in the unit of the mesh.
struct DistanceStatistics {
  std::int64_t points = 0;
  double rms = 0.0;          ///< root of the mean of d²
  double mean = 0.0;         ///< mean of |d|
  double signed_mean = 0.0;  ///< mean of d: the bias
  double lowest = 0.0;       ///< least d
  double highest = 0.0;      ///< greatest d
  double maximum = 0.0;      ///< greatest |d|
  /// Where the maximum is: a vertex, or a triangle for facet points; the first one if there are
  /// several. -1 for no points.
  std::int64_t maximum_index = -1;
  Vec3 maximum_position{0, 0, 0};
};

/// Distances of the points of one surface from another.
struct Distance {
  /// The vertices that triangles use, each counting once.
  DistanceStatistics vertices;
  /// The facet points. Means are integrals over the surface divided by its area, by a rule that is
  /// exact for cubics; of the weight of a triangle in four points its corners have 3/20. Count and
  /// extremes are of the facet points alone.
  DistanceStatistics facets;
  double area = 0.0;  ///< of the measured surface
  /// No point of the surface is further than this from a vertex or facet point. Distances from a
  /// shape change no faster than the point moves, so none exceeds the larger maximum by more.
  double reach = 0.0;
  /// Whether d has a sign. Without, d >= 0.
  bool has_sign = false;
};

/// Distances between a mesh and a reference mesh.
struct MeshDistance {
  Distance to_reference;    ///< from points of the mesh to the reference's surface
  Distance from_reference;  ///< from points of the reference to the mesh; 0 points if not asked for
  /// The greatest maximum of all: the symmetric Hausdorff distance is at least this, and at most
  /// this and the larger reach (where measured both ways).
  double hausdorff = 0.0;
};

/// Distance of a mesh from a shape: of shapes.hpp, or any other by a function.
///
/// Facet points keep coarse triangles from hiding behind vertices that lie on the shape. A triangle
/// whose longest edge is L is divided into m² equal parts; its points are the corners (but for its
/// own three), edge mid-points and centroids of the parts. m = ⌈L / (2 rms L)⌉ with the rms over
/// all triangles, so that the parts are at most 9/4 as many as the triangles; or, if asked for,
/// ⌈L / (2 facet_spacing)⌉. Points on an edge come with each of its triangles. Those of triangles
/// without area count for the extremes alone.
/// \throw Error invalid_argument for an empty mesh, a position that is not finite or an index out
///   of range (vertex or triangle are named), a mesh without area, options out of range, an empty
///   function, a facet_spacing of less than L / 8192; invalid_value where the function returns NaN
///   or infinity (the point and its vertex or triangle are named: the first vertex, or else the
///   first triangle); cancelled. What the function throws passes through.
/// Cost: a call per vertex and four per triangle, and more for large triangles. Memory: 8 bytes per
/// vertex. Thread safety: concurrent calls are safe if the function allows it.
[[nodiscard]] Distance distance(std::span<const Vec3> positions,
                                std::span<const Triangle> triangles, const SignedDistance& shape,
                                const DistanceOptions& options = {});
[[nodiscard]] Distance distance(std::span<const Vec3> positions,
                                std::span<const Triangle> triangles, const Shape& shape,
                                const DistanceOptions& options = {});
[[nodiscard]] inline Distance distance(const Mesh& mesh, const SignedDistance& shape,
                                       const DistanceOptions& options = {}) {
  return distance(mesh.positions, mesh.triangles, shape, options);
}
[[nodiscard]] inline Distance distance(const Mesh& mesh, const Shape& shape,
                                       const DistanceOptions& options = {}) {
  return distance(mesh.positions, mesh.triangles, shape, options);
}

/// Distance of a mesh from a reference mesh, at the same points.
///
/// Distances are those of the closest points of the reference's triangles, in float64: errors are a
/// few 1e-16 of the distance and of the size of that triangle (1e-14 for slivers whose height is
/// less than a millionth of their length), wherever the origin is. A tree of boxes in float32 only
/// rules out what is surely further away.
///
/// The sign is that of the reference's orientation: positive on the side from which its triangles
/// are counter-clockwise. Where the closest point is on an edge or vertex, the normals of all
/// triangles around it decide, weighted by their angles there; that is exact if the reference
/// bounds a solid and does not cut itself. It need not share vertices between triangles and may
/// hold triangles without area. Below 1e-12 of the closest triangle's size the sign means nothing.
/// d has no sign if an edge of the reference is not run along as often one way as the other; edges
/// match by the positions of their ends.
/// \throw Error as above, for either mesh (a reference measured one way may have no area);
///   too_large for 2^32 - 1 triangles
/// Cost: a search per vertex and four per triangle, and more for large triangles; each takes 1 µs
/// where the surfaces are close, up to 5 µs where they are far apart, and more where many triangles
/// are as close to within a thousandth of the reference's size: a plane seen from afar. Memory: 8
/// bytes per vertex and some 100 per triangle. Thread safety: concurrent calls are safe.
/// Source: tree: Wald et al., Embree, ACM Trans. Graph. 33 (2014) 143; sign: Bærentzen, Aanæs, IEEE
/// TVCG 11 (2005) 243; sampling: Cignoni, Rocchini, Scopigno, Metro, Comput. Graph. Forum 17 (1998)
/// 167.
[[nodiscard]] MeshDistance distance(std::span<const Vec3> positions,
                                    std::span<const Triangle> triangles,
                                    std::span<const Vec3> reference_positions,
                                    std::span<const Triangle> reference_triangles,
                                    const DistanceOptions& options = {});
[[nodiscard]] inline MeshDistance distance(const Mesh& mesh, const Mesh& reference,
                                           const DistanceOptions& options = {}) {
  return distance(mesh.positions, mesh.triangles, reference.positions, reference.triangles,
                  options);
}

}  // namespace difmesh
