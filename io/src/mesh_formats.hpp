#pragma once
/// \file mesh_formats.hpp
/// One reader and one writer for each mesh format.
///
/// Why our own and not OpenMesh's: OpenMesh 9.0 passes every position and normal through float32.
/// Its readers and writers of PLY, OBJ and OFF, binary and text, with a mesh of float64 points and
/// 17 digits asked for, give back 0.1 as 0.10000000149011612. Its reader of
/// STL drops triangles whose corners coincide, and its writer speaks through a log that the whole
/// program shares.

#include <cstdint>
#include <filesystem>

#include "atomic_file.hpp"
#include "difmesh/io/vertex_scalars.hpp"
#include "difmesh/mesh.hpp"
#include "input_file.hpp"

namespace difmesh::detail {

/// What a PLY file holds beside positions and triangles.
struct PlyContent {
  bool normals = false;
  bool edge_ids = false;
  const std::vector<VertexScalars>& scalars;
};

/// \throw Error invalid_argument for scalars that are called like a property of the mesh
void check_ply_names(const std::filesystem::path& path, const std::vector<VertexScalars>& scalars);

/// The writers take a mesh whose indices, sizes and numbers were checked.
void write_ply(AtomicFile& file, const Mesh& mesh, const PlyContent& content);
void write_obj(AtomicFile& file, const Mesh& mesh, bool normals);
void write_off(AtomicFile& file, const Mesh& mesh, bool normals);
void write_stl(AtomicFile& file, const Mesh& mesh);

[[nodiscard]] ScalarMesh read_ply(const InputFile& file);
[[nodiscard]] ScalarMesh read_obj(const InputFile& file);
[[nodiscard]] ScalarMesh read_off(const InputFile& file);
[[nodiscard]] ScalarMesh read_stl(const InputFile& file);

/// The most vertices that 32-bit indices can name.
inline constexpr std::int64_t kMostVertices = 0xFFFFFFFF;

/// "x y z", each as short as it can be and still be read as the same number.
inline void write_vector(AtomicFile& file, const Vec3& vector) {
  file.write_number(vector[0]);
  file.write(" ");
  file.write_number(vector[1]);
  file.write(" ");
  file.write_number(vector[2]);
}

}  // namespace difmesh::detail
