#pragma once
/// \file mesh_check.hpp
/// What every writer asks of a mesh before it opens a file, and every reader of one at last.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/io/vertex_scalars.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// \throw Error: cannot write 'path': matter
[[noreturn]] void fail_write(ErrorCode code, const std::filesystem::path& path,
                             const std::string& matter);

/// \param format where float32 bounds the positions, the name of the format; else nullptr
/// \throw Error invalid_argument if an index is out of range, or normals or edge_ids are neither
///   empty nor one per vertex; invalid_value if a position or normal is not finite or beyond that
void check_mesh(const std::filesystem::path& path, const Mesh& mesh, const char* format = nullptr);

/// The line that a vertex stands in.
struct VertexLine {
  std::size_t vertex;
  std::int64_t line;
};
/// "line 7", or nothing for a vertex that is not among `lines`, which ascend.
[[nodiscard]] std::string place_of(const std::vector<VertexLine>& lines, std::size_t vertex);

/// Leaves out what is not finite and no surface needs, with a warning: all normals, if one of them is
/// not; vertices that no triangle uses, with all that belongs to them. The others keep their order.
/// Scalars are not looked at.
/// \param place where the file has a vertex, for the message: "line 7" or nothing
/// \throw Error file_format if a triangle uses a vertex that is not finite; indices must be in range
/// Cost: one pass over positions and normals; over all the mesh where vertices are left out.
void leave_out_not_finite(const std::filesystem::path& path, ScalarMesh& surface,
                          const std::function<std::string(std::size_t vertex)>& place = {});

}  // namespace difmesh::detail
