#pragma once
/// \file draco_file.hpp
/// Meshes compressed by Draco, alone (.drc) or within glTF. Needs DIFMESH_WITH_DRACO; without it
/// the functions throw Error invalid_argument.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/io/vertex_scalars.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

enum class DracoMethod : std::uint8_t {
  edgebreaker,  ///< smallest; vertices and triangles come in another order, triangles without area
                ///< by their indices are left out
  sequential,   ///< keeps the order of vertices and triangles; some three times as large
};

/// How a mesh is compressed. Coordinates become whole numbers of steps; a step is the longest side
/// of the bounding box divided by 2^bits - 1, and no coordinate is off by more than half of it,
/// float32 rounding aside.
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

struct WriteDrcOptions {
  bool normals = true;                      ///< write vertex normals, where the mesh has them
  bool edge_ids = true;                     ///< write edge ids, where the mesh has them
  std::vector<VertexScalars> scalars = {};  ///< each with one value per vertex
  DracoOptions draco = {};
};

/// Writes a .drc file: float32 positions, named attributes for edge ids and scalars. Vertices that no
/// triangle uses are left out: Draco holds no more than three per triangle. Where float32
/// about zero would be coarser than an eighth of a step, positions are relative to the centre of
/// the bounding box, which the metadata `difmesh_origin` holds as three float64.
/// \throw Error as write_mesh(), invalid_argument for options out of range or scalars of another
///   length or without a name of their own, invalid_value for a mesh without triangles.
/// Cost: linear; see bench/gltf_bench.cpp. Thread safety: concurrent calls are safe.
MeshFileReport write_drc(const std::filesystem::path& path, const Mesh& mesh,
                         const WriteDrcOptions& options = {});

/// Reads a .drc file of any encoder since bitstream 1.0: positions, normals, and generic attributes of
/// one component that have a name. `difmesh_origin` is added. Files of difmesh's own come back with
/// edge ids. Normals and scalars that are not finite are left out with a warning, and so are vertices
/// that no triangle uses.
/// \throw Error as read_mesh(); also for point clouds.
[[nodiscard]] ScalarMesh read_drc(const std::filesystem::path& path);

}  // namespace difmesh
