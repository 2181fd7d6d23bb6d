#pragma once
/// \file write_mesh_options.hpp
/// How a mesh is written. What a format cannot honour is refused: see MeshFormat.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "difmesh/grid.hpp"
#include "difmesh/io/color_map.hpp"
#include "difmesh/io/draco_options.hpp"

namespace difmesh {

/// The axis of the mesh's coordinates that points up. In glTF that is y.
enum class UpAxis : std::uint8_t {
  y,  ///< coordinates are written as they are
  z,  ///< a root node turns z up to y up; the coordinates below it are as they are
};

/// Colours by a scalar of the mesh.
struct ColorBy {
  std::string scalars;  ///< the name of one of the scalars written
  ColorMap map = ColorMap::viridis;
  /// Values of the first and the last colour; values beyond get these. Not set: the least and the
  /// greatest value; for cool_warm, as far from 0 on both sides.
  std::optional<std::array<double, 2>> range = {};
};

struct WriteMeshOptions {
  std::string format = {};  ///< an extension, such as "ply"; empty: that of the path
  /// Write vertex normals, where the mesh and the format have them. glTF gets means of those of the
  /// triangles around, weighted by area, where the mesh has none.
  bool normals = true;
  bool edge_ids = true;  ///< write edge ids, where the mesh and the format have them
  bool scalars = true;   ///< write scalars, where the mesh and the format have them

  std::optional<ColorBy> color = {};       ///< formats with colours; none: light grey
  std::optional<DracoOptions> draco = {};  ///< compress glTF; how to compress .drc

  // For formats that hold a scene.
  UpAxis up = UpAxis::y;
  double metres_per_unit = 1.0;  ///< > 0. glTF's unit is the metre; a root node scales to it
  /// Where positions are relative to, kept by the node's translation in float64. Not set: the
  /// centre of the bounding box, which leaves float32 the most digits.
  std::optional<Vec3> local_origin = {};
  /// More vertices are split into several primitives, whose common vertices are repeated; at least
  /// 3. 65535 gives indices of 16 bits throughout, for viewers that have no others.
  std::int64_t most_vertices = 0xFFFFFFFF;
  std::string name = "surface";  ///< of mesh and node; UTF-8
};

}  // namespace difmesh
