#pragma once
/// \file mesh_file.hpp
/// Triangle meshes in files: PLY, OBJ, OFF, STL, glTF and Draco.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/io/read_mesh_options.hpp"
#include "difmesh/io/vertex_scalars.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

/// What each format keeps of a mesh when written and read again. Meshes need not be manifold.
enum class MeshFormat : std::uint8_t {
  ply,  ///< binary little endian; positions, normals and triangles bit for bit, and edge ids as two
        ///< vertex properties `edge_id_low` and `edge_id_high`, as PLY has no integers of 64 bits;
        ///< scalars as vertex properties of their names
  obj,  ///< text; positions and normals bit for bit
  off,  ///< text; positions and, as NOFF, normals bit for bit
  stl,  ///< binary; positions rounded to float32 by the format, nothing shared between triangles
  glb,  ///< binary glTF; positions rounded to float32 about the centre, with normals (computed where
        ///< there are none) and edge ids; no empty mesh, and no vertices that no triangle uses. Its
        ///< options: gltf_file.hpp
  gltf,  ///< the same as text
  drc,   ///< Draco: coordinates rounded to steps, the order changed; see draco_file.hpp
};

struct WriteMeshOptions {
  std::optional<MeshFormat> format = {};  ///< by the extension of the path if not set
  bool normals = true;   ///< write vertex normals, where the mesh and the format have them
  bool edge_ids = true;  ///< write edge ids, where the mesh and the format have them
  /// Each with one value per vertex. PLY holds them as float64, glTF and Draco as float32; the other
  /// formats have no place for them. Finite, and within the range of float32.
  std::vector<VertexScalars> scalars = {};
};

/// Writes a mesh. The file appears under its name when it is complete and not before; on failure
/// nothing is left and an older file stays as it was. Symbolic links are followed, to files that are
/// there or not yet, and stay. Targets that are no regular files, such as
/// /dev/stdout, are written directly. Numbers in text are as short as they can be and still be read
/// as the same float64.
/// \throw Error invalid_argument if an index is out of range, normals or edge_ids are neither empty
///   nor one per vertex, or the extension is unknown; invalid_value if a position or normal is not
///   finite, or beyond the range of float32 for STL; too_large for more than 2^32 - 1 triangles in
///   STL; file_write with the path and the system's reason.
/// Cost: linear; 1.2 million triangles take some 0.05 s as PLY, 0.2 s as OFF, OBJ or STL.
/// Thread safety: concurrent calls are safe.
MeshFileReport write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                          const WriteMeshOptions& options = {});

/// Reads a mesh; the extension of the path, in any case of letters, tells the format. Vertices and
/// faces keep their order. A polygon of n corners becomes n - 2 triangles with its corners: a fan
/// about its first corner where that fills it, else ears are cut off, so that polygons need neither
/// be convex nor quite plane. For glTF and Draco see read_gltf() and read_drc().
///
/// What is not finite and the surface does without is left out: vertices that no triangle uses (those
/// behind them move up), and all normals if one is bad. Text may start with a byte order mark, and
/// its lines end with a line feed, a carriage return or both.
/// - PLY, text or binary of either byte order: faces and triangle strips, before or after the vertices,
///   whose list of integers may have any name where there is but one; other elements are skipped.
/// - OBJ: normals are taken where every corner `v//n` has n = v; groups, materials, texture
///   coordinates, weights, colours, lines, points and free forms are skipped. Indices may be
///   negative; faces may come before their vertices. A file without a vertex is an empty mesh only
///   if all its lines are OBJ's.
/// - OFF, text or binary: with its prefixes C, N and ST in any letters, or without a keyword; colours
///   and texture coordinates are skipped. Vertices and faces stand in lines of their own, or run
///   across lines, as long as the whole file fits.
/// - STL, text or binary: corners with equal coordinates become one vertex, in the order of their
///   first appearance; triangles that lose a corner this way are kept. All solids become one mesh.
///   Text without `endsolid` and bytes behind the triangles of a binary file are warned of.
/// \throw Error file_missing if the file cannot be opened; file_format if it is malformed,
///   truncated, of a kind not supported or of an unknown extension, an index is out of range, a
///   vertex of a triangle not finite; too_large beyond 2^32 - 1 vertices; OutOfMemory. The message
///   names the file and the line or element.
///
/// Cost: linear; memory is bounded by a small multiple of the file's size.
/// Thread safety: concurrent calls are safe.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path,
                             const ReadMeshOptions& options = {});

/// The same with warnings, of what was left out or taken otherwise than the file says, and with the
/// scalars that come with the vertices in glTF, Draco and PLY files. In PLY these are the float
/// properties of vertices that are no positions or normals, where all are finite.
[[nodiscard]] ScalarMesh read_scalar_mesh(const std::filesystem::path& path,
                                          const ReadMeshOptions& options = {});

/// The format that the extension of a path, in any case of letters, stands for.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);

}  // namespace difmesh
