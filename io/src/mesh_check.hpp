#pragma once
/// \file mesh_check.hpp
/// What every writer asks of a mesh before it opens a file, and every reader of one at last.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/io/mesh_reading.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/mesh_portion.hpp"

namespace difmesh::detail {

/// The most vertices that 32-bit indices can name.
inline constexpr std::int64_t kMostVertices = 0xFFFFFFFF;

/// \throw Error: cannot write 'path': matter
[[noreturn]] void fail_write(ErrorCode code, const std::filesystem::path& path,
                             const std::string& matter);

/// Counts over the whole mesh, for messages.
struct PortionStart {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};
/// \param float32_format where float32 bounds the positions, the name of the format; else empty
/// \throw Error invalid_argument if an index is out of range, or normals, edge_ids or scalars are
///   neither empty nor one per vertex; invalid_value if a position or normal is not finite or
///   beyond that
void check_portion(const std::filesystem::path& path, const MeshPortion& portion,
                   const PortionStart& start, std::string_view float32_format = {});

/// Of scalars that are written. \throw Error invalid_argument for names that no file could hold,
///   invalid_value for values that are not of float32's range
void check_scalars(const std::filesystem::path& path, std::span<const VertexScalar> scalars,
                   std::size_t first_vertex = 0);

/// The line that a vertex stands in.
struct VertexLine {
  std::size_t vertex;
  std::int64_t line;
};
/// "line 7", or nothing for a vertex that is not among `lines`, which ascend.
[[nodiscard]] std::string place_of(const std::vector<VertexLine>& lines, std::size_t vertex);

/// Leaves out what is not finite and no surface needs, with a warning: all normals, if one of them
/// is not; vertices that no triangle uses, with all that belongs to them. The others keep their
/// order. Scalars are not looked at.
/// \param place where the file has a vertex, for the message: "line 7" or nothing
/// \throw Error file_format if a triangle uses a vertex that is not finite; indices must be in
///   range
/// Cost: one pass over positions and normals; over all the mesh where vertices are left out.
void leave_out_not_finite(const std::filesystem::path& path, MeshFile& surface,
                          const std::function<std::string(std::size_t vertex)>& place = {});

}  // namespace difmesh::detail
