#pragma once
/// \file reference_input.hpp
/// The options that say what a surface should be, and its errors.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "difmesh/mesh.hpp"
#include "shape_options.hpp"

namespace difmesh::cli {

/// A shape or a mesh.
struct ReferenceInput {
  std::string shape_name;
  ShapeInput shape;
  std::string path;
  bool allow_outside = false;  ///< see kAllowOutsideHelp

  [[nodiscard]] bool is_given() const { return !shape_name.empty() || !path.empty(); }
};

/// Adds --shape, --reference and the parameters of shapes. `input` must outlive the parsing.
void add_reference_options(CLI::App& command, ReferenceInput& input);
/// \throw CLI::ValidationError where both are given, or parameters that the shape does not have;
///   Error as make_shape()
void check_reference(const ReferenceInput& input);

/// A mesh with triangles; appends what its reader warns of. \throw Error
[[nodiscard]] Mesh read_triangles(const std::string& path, bool allow_outside,
                                  std::vector<std::string>& warnings);

/// Scalars `error`: distances of the vertices from the reference, negative inside where that is
/// known. Appends what the reader of a reference mesh warns of.
/// \pre input.is_given()
/// \throw Error; for a reference mesh in a build without difmesh::metrics too
[[nodiscard]] VertexScalar errors_of(const Mesh& mesh, const ReferenceInput& input, bool quiet,
                                     std::vector<std::string>& warnings);

}  // namespace difmesh::cli
