#pragma once
/// \file gltf_file.hpp
/// Surfaces as glTF 2.0, which viewers, browsers and game engines open. Needs DIFMESH_WITH_GLTF;
/// without it the functions throw Error invalid_argument.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "difmesh/io/colour_map.hpp"
#include "difmesh/io/draco_file.hpp"
#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/io/read_mesh_options.hpp"
#include "difmesh/io/vertex_scalars.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

/// The axis of the mesh's coordinates that points up. In glTF that is y.
enum class UpAxis : std::uint8_t {
  y,  ///< coordinates are written as they are
  z,  ///< a root node turns z up to y up; the coordinates below it are as they are
};

/// Colours by a scalar of the mesh.
struct ColourBy {
  std::string scalars;  ///< the name of one of the scalars written
  ColourMap map = ColourMap::viridis;
  /// Values of the first and the last colour; values beyond get these. Not set: the least and the
  /// greatest value; for cool_warm, as far from 0 on both sides.
  std::optional<std::array<double, 2>> range = {};
};

struct WriteGltfOptions {
  /// Write vertex normals: the mesh's or, where it has none, means of those of the triangles
  /// around, weighted by area.
  bool normals = true;
  bool edge_ids = true;                     ///< write edge ids, where the mesh has them
  std::vector<VertexScalars> scalars = {};  ///< each with one finite value per vertex
  std::optional<ColourBy> colour = {};      ///< none: light grey
  std::optional<DracoOptions> draco = {};   ///< compress, with KHR_draco_mesh_compression
  UpAxis up = UpAxis::y;
  double metres_per_unit = 1.0;  ///< > 0. glTF's unit is the metre; a root node scales to it
  /// Where positions are relative to, kept by the node's translation in float64. Not set: the
  /// centre of the bounding box, which leaves float32 the most digits.
  std::optional<Vec3> local_origin = {};
  /// More vertices are split into several primitives, whose common vertices are repeated; at least
  /// 3. 65535 gives indices of 16 bits throughout, for viewers that have no others.
  std::int64_t most_vertices = 0xFFFFFFFF;
  std::string name = "surface";  ///< of mesh and node; UTF-8
  /// Write .glb, or .gltf; by the extension of the path if not set.
  std::optional<bool> binary = {};
};

/// Writes a mesh as .glb (one binary file) or .gltf (one text file, its data in base64: a third
/// larger, but whole or not there at all like any file of ours).
/// - Vertices that no triangle uses are left out: far off, they would cost the surface digits and
///   viewers their view of it.
/// - POSITION float32 with exact min and max, NORMAL, indices uint16 or, from 65536 vertices on,
///   uint32; one double-sided material, neither metallic nor glossy.
/// - `_NAME`, in capitals, for each of the scalars: float32; its range is in the mesh's `extras`.
/// - `_EDGE_ID`: VEC4 of uint16, the four digits of the id to the base 65536, lowest first, as glTF
///   has no integers of 64 bits and allows no uint32 here.
/// - COLOR_0 where asked for: linear RGBA, 16 bits (8 with Draco); scalar, map and range are in the
///   mesh's `extras`.
/// - `_VERTEX` in split meshes: the vertex's index in the whole mesh, two digits as above.
/// \throw Error as write_mesh() and write_drc(); invalid_value for a mesh without triangles, which
///   glTF cannot hold, and for positions beyond the range of float32 about the local origin;
///   too_large where the file would exceed 4 GiB, the most that the .glb format can hold.
/// Cost: linear; 1.2 million triangles take some 0.1 s. Memory: about the size of the file without
/// compression. Thread safety: concurrent calls are safe. Source: Khronos, glTF 2.0.
MeshFileReport write_gltf(const std::filesystem::path& path, const Mesh& mesh,
                          const WriteGltfOptions& options = {});

/// The bytes of the .glb file, in memory.
[[nodiscard]] std::vector<char> encode_glb(const Mesh& mesh, const WriteGltfOptions& options = {},
                                           MeshFileReport* report = nullptr);

/// The same in base64, for web pages.
[[nodiscard]] std::string encode_glb_base64(const Mesh& mesh, const WriteGltfOptions& options = {});

/// Reads the surfaces of a .glb or .gltf file: the triangles, strips and fans of its default scene,
/// plain or compressed by Draco, moved to where their nodes put them and joined to one mesh in the
/// order of the scene. Materials, textures and animations are skipped. So are, with a warning where
/// viewers would show something else, points and lines, primitives without positions, skins, morph
/// targets, copies by EXT_mesh_gpu_instancing, extensions that are not known here, and what is not
/// finite: normals, scalars, vertices of no triangle. Accessors without data are zero. Positions,
/// normals and scalars may have any type that glTF allows for them. Normals, edge ids and scalars are
/// kept where all primitives have them; scalars are attributes of one number whose name starts with
/// an underscore, in small letters here. What write_gltf() wrote comes back in the coordinates and
/// unit that it was given, and undivided.
///
/// Buffers are within the file, in base64, or in files in the same folder or below; elsewhere where
/// the options allow it.
/// \throw Error as read_mesh(); file_format also for sparse accessors, meshes that hang on no node,
///   and by name for required extensions that are not known to leave geometry alone. The message
///   names the part, for instance accessors[2].count.
/// Cost: linear. Memory: at most some 100 times the size of the file; of Draco's data, which may
/// pack that well, up to 1000 vertices and triangles for each of their bytes. A file that asks for
/// more is refused as not to be trusted.
/// Thread safety: concurrent calls are safe.
[[nodiscard]] ScalarMesh read_gltf(const std::filesystem::path& path,
                                   const ReadMeshOptions& options = {});

}  // namespace difmesh
