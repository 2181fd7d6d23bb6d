#pragma once
/// \file surface_output.hpp
/// The options with which a command writes a mesh, and the writing.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "difmesh/io/mesh_file_report.hpp"
#include "difmesh/io/write_mesh_options.hpp"
#include "difmesh/mesh.hpp"
#include "mesh_scalars.hpp"

namespace difmesh::cli {

/// A file of a mesh as the command line asks for it.
struct SurfaceOutput {
  std::string path;
  std::string draco;  ///< empty: not asked for; "true": the default bits; else bits
  std::optional<DracoMethod> draco_method;
  std::optional<int> draco_speed;
  bool curvature = false;  ///< write it with each vertex
  std::string color_by;
  ColorScale colors;
  std::optional<UpAxis> up;
  std::optional<double> metres_per_unit;

  /// Whether the format is for looking at, and wants the best normals that there are.
  [[nodiscard]] bool shows_normals() const;
};

/// Adds --draco, --curvature and the others. `output` must outlive the parsing.
void add_surface_options(CLI::App& command, SurfaceOutput& output);
/// \param scalars names that the surface will have scalars of
/// \throw CLI::ValidationError for an unknown extension, and options that the format does not have
void check_surface_output(const SurfaceOutput& output, const std::vector<std::string>& scalars);
/// Writes the mesh. \return what is in the file
/// \param mesh gets the scalars to colour by, where it does not have them
/// \param cell_size Δx, for the choice of Draco's bits
/// \throw Error
MeshFileReport write_surface(const SurfaceOutput& output, Mesh& mesh, double cell_size);

/// Size and error of a file in words.
[[nodiscard]] std::string file_text(const MeshFileReport& report);
/// A sentence where the format made triangles collapse or rounds coordinates by more than a
/// hundredth of the spacing, unless it was told by how much to.
[[nodiscard]] std::optional<std::string> rounding_warning(const SurfaceOutput& output,
                                                          const MeshFileReport& report,
                                                          double cell_size);

}  // namespace difmesh::cli
