#pragma once
/// \file mesh_scalars.hpp
/// Numbers per vertex that the program can colour a surface by.

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/curvature.hpp"
#include "difmesh/io/color_map.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::cli {

/// The name of the distances from what a surface should be.
inline constexpr const char* kErrorName = "error";

/// One kind of scalars. To add one: a row in the table of mesh_scalars.cpp.
struct ScalarKind {
  std::string_view name;
  std::string_view meaning;
  Array<double> (*of)(const Mesh& mesh);
};

/// All kinds that come from the mesh alone.
[[nodiscard]] std::span<const ScalarKind> scalar_kinds();

/// The name that a word of the command line stands for: '-' is read as '_'.
[[nodiscard]] std::string scalars_name(std::string word);

/// Mean and Gaussian curvature, 0 at vertices that have none.
[[nodiscard]] std::vector<VertexScalar> curvature_scalars(Curvature curvature);

/// The scalars of that name: the mesh's, or computed.
/// \throw CLI::ValidationError naming the option, the word and what there is
[[nodiscard]] VertexScalar scalars_of(const std::string& option, const std::string& word,
                                      const Mesh& mesh);

[[nodiscard]] bool has_scalars(const Mesh& mesh, const std::string& name);

/// How numbers become colours, as far as the command line says.
struct ColorScale {
  std::optional<ColorMap> map;
  std::optional<std::array<double, 2>> range;
};

/// The map that was asked for, else the one that suits the scalars of that name.
[[nodiscard]] ColorMap map_of(const ColorScale& scale, const std::string& name);

/// Adds --color-map and --color-range. `scale` must outlive the parsing.
void add_color_scale_options(CLI::App& command, ColorScale& scale);

}  // namespace difmesh::cli
