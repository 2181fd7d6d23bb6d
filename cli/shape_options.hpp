#pragma once
/// \file shape_options.hpp
/// The options with which a command takes a built-in shape, and its making.

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/shapes.hpp"
#include "json.hpp"

namespace difmesh::cli {

/// A shape as the command line asks for it. Its kind is known only when all has been read.
struct ShapeInput {
  ShapeOptions options;
  std::vector<std::string> given;  ///< options that were on the command line

  /// \throw CLI::ValidationError naming an option that `kind` does not have; Error as make_shape()
  [[nodiscard]] Shape make(ShapeKind kind) const;
};

/// Adds --centre, --rotation, --radius and so on. `input` must outlive the parsing.
void add_shape_options(CLI::App& command, ShapeInput& input);

/// Looks the name up.
/// \param else_wanted what the word may be in place of a shape; may be empty
/// \throw CLI::ValidationError listing the names if there is no such shape
[[nodiscard]] ShapeKind parse_shape(const std::string& option, std::string_view name,
                                    const std::string& else_wanted = "");

/// The name and the parameters that the shape has.
[[nodiscard]] Json shape_json(const Shape& shape);

}  // namespace difmesh::cli
