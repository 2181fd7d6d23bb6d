#pragma once
/// \file mesh_file_report.hpp
/// What became of a mesh in a file.

#include <cstdint>
#include <string>
#include <vector>

#include "difmesh/mesh.hpp"

namespace difmesh {

/// Counts are those of the file.
struct MeshFileReport {
  std::int64_t bytes = 0;  ///< size of the file
  /// STL has three per triangle, the parts of a split glTF repeat some, and Draco adds some where
  /// the mesh is not manifold.
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t primitives = 0;  ///< of glTF; 1 in other formats
  int position_bits = 0;        ///< of Draco; 0 without
  /// No coordinate is off by more, in the unit of the mesh: exact for STL, a bound for glTF and
  /// Draco, 0 for the others. Readers that add a local origin far from the surface in float64 round
  /// once more, by at most 2^-53 of the coordinate.
  double position_error = 0.0;
  Vec3 local_origin{0, 0, 0};  ///< glTF, Draco: what positions are relative to in the file; else 0
  /// STL: triangles that lose their area, all of it, in float32; other formats, whose positions are
  /// not rounded or relative to an origin nearby: 0.
  std::int64_t collapsed_triangles = 0;
  /// What a user should know though the file is there, one English sentence each that names it:
  /// that float32 moves coordinates of STL by more than a hundredth of the mean edge, or triangles
  /// collapse. UTF-8 of at most 1000 bytes, without control characters.
  std::vector<std::string> warnings = {};
};

}  // namespace difmesh
