#pragma once
/// \file mesh_check.hpp
/// What every writer asks of a mesh before it opens a file.

#include <filesystem>
#include <string>

#include "difmesh/error.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// \throw Error: cannot write 'path': matter
[[noreturn]] void fail_write(ErrorCode code, const std::filesystem::path& path,
                             const std::string& matter);

/// \param format where float32 bounds the positions, the name of the format; else nullptr
/// \throw Error invalid_argument if an index is out of range, or normals or edge_ids are neither
///   empty nor one per vertex; invalid_value if a position or normal is not finite or beyond that
void check_mesh(const std::filesystem::path& path, const Mesh& mesh, const char* format = nullptr);

}  // namespace difmesh::detail
