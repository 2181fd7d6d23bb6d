#pragma once
/// \file polygons.hpp
/// Polygons of files as triangles.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "difmesh/io/mesh_reading.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// Takes the polygons of a file one by one, and cuts them when all vertices are known, as faces may
/// come before the vertices that they use.
///
/// A polygon of n corners becomes n - 2 triangles: the fan about its first corner where all
/// triangles of it face as the polygon does, which is every strictly convex polygon; else its ears
/// are cut off (ear_cutter.hpp). A corner that comes twice in succession counts once.
class Polygons {
 public:
  /// Appends the fan, for now. At least three corners.
  void add(Array<Triangle>& triangles, std::span<const std::uint32_t> corners);

  /// Of polygons that cross themselves: any triangles with their edges.
  struct Report {
    std::int64_t crossed = 0;
    std::int64_t first_crossed = -1;  ///< the number of its first triangle
  };
  /// Cuts the polygons of `mesh`, whose triangles are those of add() alone and whose corners are
  /// vertices, of which those that are not finite spoil but their own polygon.
  /// \throw Error file_format for a polygon whose ears take too long to find
  /// Cost: linear for fans, else O(n log n) for all but hostile polygons.
  Report cut(const std::filesystem::path& path, Mesh& mesh) const;

 private:
  /// Polygons in succession that have as many corners.
  struct Run {
    std::size_t corners;
    std::size_t polygons;
  };
  std::vector<Run> runs_;
};

/// Polygons::cut() with a warning of polygons that cross themselves.
void cut_polygons(const std::filesystem::path& path, const Polygons& polygons, MeshFile& surface);

}  // namespace difmesh::detail
