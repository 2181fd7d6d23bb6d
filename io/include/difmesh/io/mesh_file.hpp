#pragma once
/// \file mesh_file.hpp
/// Triangle meshes in files. mesh_formats() tells what formats there are and what each keeps. Of
/// those in the library:
/// - .ply, binary little endian: all bit for bit; edge ids as two vertex properties `edge_id_low`
///   and `edge_id_high`, as PLY has no integers of 64 bits; scalars as float64 properties of their
///   names.
/// - .obj and .off, text: positions and normals bit for bit.
/// - .stl, binary: positions rounded to float32 by the format, nothing shared between triangles.
/// - .glb and .gltf, glTF 2.0: positions rounded to float32 about the centre; see glb.hpp.
/// - .drc, Draco: float32 positions in steps, named attributes for edge ids and scalars. Where
///   float32 about zero would be coarser than an eighth of a step, positions are relative to the
///   centre of the bounding box, which the metadata `difmesh_origin` holds as three float64.
///
/// glTF and Draco hold no empty mesh; vertices that no triangle uses are left out there.

#include <filesystem>

#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/io/mesh_format.hpp"
#include "difmesh/io/mesh_reading.hpp"
#include "difmesh/io/write_mesh_options.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

/// Writes a mesh, which need not be manifold. The file appears under its name when it is complete
/// and not before; on failure nothing is left and an older file stays as it was. Symbolic links are
/// followed, to files that are there or not yet, and stay. Targets that are no regular files, such
/// as /dev/stdout, are written directly. Numbers in text are as short as they can be and still be
/// read as the same float64.
/// \throw Error invalid_argument if the extension is unknown, an option is out of range or one that
///   the format cannot honour, an index is out of range, normals, edge_ids or scalars are neither
///   empty nor one per vertex, or scalars that are written have no good name of their own;
///   invalid_value if a position, normal or scalar is not finite, or beyond the range of float32
///   (positions in STL; scalars in all formats), or for a mesh without triangles in glTF and Draco;
///   too_large for more than 2^31 - 1 triangles in STL and for what encode_glb() says; unsupported
///   if the build lacks the format; file_write with the path and the system's reason.
/// Cost: linear; 1.2 million triangles take some 0.05 s as PLY, 0.2 s as OFF, OBJ or STL, 0.1 s as
/// glTF, 0.7 s with Draco. Thread safety: concurrent calls are safe.
MeshFileReport write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                          const WriteMeshOptions& options = {});

/// Reads a mesh, with warnings of what was left out or taken otherwise than the file says. The
/// extension of the path, in any case of letters, tells the format. Vertices and faces keep their
/// order. A polygon of n corners becomes n - 2 triangles with its corners: a fan about its first
/// corner where that fills it, else ears are cut off, so that polygons need neither be convex nor
/// quite plane.
///
/// What is not finite and the surface does without is left out: vertices that no triangle uses
/// (those behind them move up), all normals if one is bad, scalars. Text may start with a byte
/// order mark, and its lines end with a line feed, a carriage return or both.
/// - PLY, text or binary of either byte order: faces and triangle strips, before or after the
///   vertices, whose list of integers may have any name where there is but one; other elements are
///   skipped. Scalars are the float properties of vertices that are no positions or normals.
/// - OBJ: normals are taken where every corner `v//n` has n = v; groups, materials, texture
///   coordinates, weights, colours, lines, points and free forms are skipped. Indices may be
///   negative; faces may come before their vertices. A file without a vertex is an empty mesh only
///   if all its lines are OBJ's.
/// - OFF, text or binary: with its prefixes C, N and ST in any letters, or without a keyword;
///   colours and texture coordinates are skipped. Vertices and faces stand in lines of their own,
///   or run across lines, as long as the whole file fits.
/// - STL, text or binary: corners with equal coordinates become one vertex, in the order of their
///   first appearance; triangles that lose a corner this way are kept. All solids become one mesh.
///   Text without `endsolid` and bytes behind the triangles of a binary file are warned of.
/// - glTF: glb.hpp says what of a scene is read. What write_mesh() wrote comes back in the
///   coordinates and unit that it was given, and undivided.
/// - Draco, of any encoder since bitstream 1.0: positions, normals, and generic attributes of one
///   component that have a name.
/// \throw Error file_missing if the file cannot be opened; file_format if it is malformed,
///   truncated, of a kind not supported or of an unknown extension, an index is out of range, a
///   vertex of a triangle not finite; too_large beyond 2^32 - 1 vertices; unsupported if the build
///   lacks the format; OutOfMemory. The message names the file and the line or element.
///
/// Cost: linear; memory is bounded by a small multiple of the file's size, for glTF and Draco by
/// what glb.hpp says. Thread safety: concurrent calls are safe.
[[nodiscard]] MeshFile read_mesh_file(const std::filesystem::path& path,
                                      const ReadMeshOptions& options = {});

/// The same without the warnings.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path,
                             const ReadMeshOptions& options = {});

}  // namespace difmesh
