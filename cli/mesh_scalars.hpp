#pragma once
/// \file mesh_scalars.hpp
/// Numbers per vertex that the program can colour a surface by.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/io/vertex_scalars.hpp"

namespace difmesh::cli {

/// One kind of scalars. To add one: a row in the table of mesh_scalars.cpp.
struct ScalarKind {
  std::string_view name;
  std::string_view meaning;
  Array<double> (*of)(const Mesh& mesh);
};

/// All kinds that come from the mesh alone.
[[nodiscard]] std::span<const ScalarKind> scalar_kinds();

/// The scalars of that name: of the file that the mesh came from, or computed.
/// \throw CLI::ValidationError naming the option, the word and what there is
[[nodiscard]] VertexScalars scalars_of(const std::string& option, const std::string& name,
                                       const ScalarMesh& surface);

}  // namespace difmesh::cli
