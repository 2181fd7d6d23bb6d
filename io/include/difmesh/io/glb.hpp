#pragma once
/// \file glb.hpp
/// Surfaces as glTF 2.0, which viewers, browsers and game engines open: what the files hold, and
/// the same in memory.
///
/// read_mesh() takes of a .glb or .gltf file the triangles, strips and fans of its default scene,
/// plain or compressed by Draco, moved to where their nodes put them and joined to one mesh in the
/// order of the scene. Materials, textures and animations are skipped. So are, with a warning where
/// viewers would show something else, points and lines, primitives without positions, skins, morph
/// targets, copies by EXT_mesh_gpu_instancing, extensions that are not known here, and what is not
/// finite: normals, scalars, vertices of no triangle. Accessors without data are zero. Positions,
/// normals and scalars may have any type that glTF allows for them. Normals, edge ids and scalars
/// are kept where all primitives have them; scalars are attributes of one number whose name starts
/// with an underscore, in small letters here. Buffers are within the file, in base64, or in files
/// in the same folder or below; elsewhere where the options allow it.
///
/// It throws Error file_format also for sparse accessors, meshes that hang on no node, and by name
/// for required extensions that are not known to leave geometry alone. The message names the part,
/// for instance accessors[2].count. Memory: at most some 100 times the size of the file; of Draco's
/// data, alone too, which may pack that well, up to 1000 vertices and triangles for each of their
/// bytes. A file that asks for more is refused as not to be trusted.

#include <string>
#include <vector>

#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/io/write_mesh_options.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

/// The bytes of a .glb file, one binary file. (A .gltf file is text, its data in base64: a third
/// larger, but whole or not there at all like any file of ours.)
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
/// \param options `format` is not looked at
/// \throw Error as write_mesh(); unsupported without DIFMESH_WITH_GLTF; invalid_value for a mesh
///   without triangles, which glTF cannot hold, and for positions beyond the range of float32 about
///   the local origin; too_large beyond 4 GiB, the most that the .glb format can hold.
/// Cost: linear; 1.2 million triangles take some 0.1 s. Memory: about the size of the file without
/// compression. Thread safety: concurrent calls are safe. Source: Khronos, glTF 2.0.
[[nodiscard]] std::vector<char> encode_glb(const Mesh& mesh, const WriteMeshOptions& options = {},
                                           MeshFileReport* report = nullptr);

/// The same in base64, for web pages.
[[nodiscard]] std::string encode_glb_base64(const Mesh& mesh, const WriteMeshOptions& options = {});

}  // namespace difmesh
