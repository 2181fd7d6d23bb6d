#pragma once
/// \file measure.hpp
/// Volume, area and topology of a triangle mesh.

#include <cstdint>
#include <span>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

/// Facts about a triangle mesh, from its arrays alone. Vertices are told apart by index, never by
/// position,
/// but for has_volume. A triangle with an index twice has no area and no part in the topology:
/// edges, components, fans, vertices in use and the Euler number are those of the other triangles.
struct Measure {
  std::int64_t vertices = 0;  ///< in use or not
  std::int64_t edges = 0;     ///< undirected
  std::int64_t triangles = 0;
  std::int64_t components = 0;             ///< of triangles joined by edges
  std::int64_t isolated_vertices = 0;      ///< in no triangle
  std::int64_t boundary_edges = 0;         ///< with one triangle
  std::int64_t non_manifold_edges = 0;     ///< with more than two triangles
  std::int64_t misoriented_edges = 0;      ///< with two triangles that run along it the same way
  std::int64_t non_manifold_vertices = 0;  ///< whose triangles are not one fan or one cycle
  std::int64_t degenerate_triangles = 0;   ///< with an index twice or area exactly 0
  bool closed = true;                      ///< every edge has an even number of triangles
  bool manifold = true;                    ///< no non-manifold edge or vertex, no misoriented edge
  std::int64_t euler_number = 0;           ///< V - E + F over the vertices in use
  double area = 0.0;
  /// Signed, by the divergence theorem about the centre of the bounding box; positive for triangles
  /// that are counter-clockwise seen from outside. Means something only where has_volume.
  double volume = 0.0;
  Vec3 low{0, 0, 0};  ///< bounding box of all positions; 0 for no vertices
  Vec3 high{0, 0, 0};
  /// With more than two triangles, more of which run along it one way than the other.
  std::int64_t unbalanced_edges = 0;
  /// The triangles run along every edge as often one way as the other, where vertices at equal
  /// positions count as one: what fractions_from_mesh() demands too. True of meshes that are closed
  /// and well oriented, and of those whose vertices are split along edges that would make them so.
  bool has_volume = true;
};

/// Measures a mesh.
/// \throw Error too_large beyond 2^32 - 1 vertices;
///   invalid_argument if an index is out of range (the triangle is named) or a position
///   is not finite (the vertex is named).
///
/// Cost: O(n log n) at worst and O(n) for meshes of bounded vertex degree, some 0.15 s for a
/// million triangles; about 100 bytes of memory per triangle. Area and volume are compensated sums
/// in the order of the triangles. Thread safety: pure function.
[[nodiscard]] Measure measure(std::span<const Vec3> positions, std::span<const Triangle> triangles);
[[nodiscard]] inline Measure measure(const Mesh& mesh) {
  return measure(mesh.positions, mesh.triangles);
}

}  // namespace difmesh
