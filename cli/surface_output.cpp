#include "surface_output.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "difmesh/io/draco_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "mesh_scalars.hpp"
#include "names.hpp"
#include "parse.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

// Of the spacing: as much as second-order vertices are off by on coarse grids.
constexpr double kCoarse = 0.01;

bool is_drc(const SurfaceOutput& output) {
  return has_extension(output.path, kDracoExtensions);
}

DracoOptions draco_options(const SurfaceOutput& output, double cell_size) {
  DracoOptions draco;
  draco.cell_size = cell_size;
  if (!output.draco.empty() && output.draco != "true") {
    draco.position_bits = static_cast<int>(parse_integer("--draco", output.draco, 1, 24));
  }
  draco.method = output.draco_method.value_or(draco.method);
  draco.speed = output.draco_speed.value_or(draco.speed);
  return draco;
}

MeshFileReport write_as_gltf(const SurfaceOutput& output, const ScalarMesh& surface,
                             double cell_size) {
  WriteGltfOptions options;
  if (!output.draco.empty()) {
    options.draco = draco_options(output, cell_size);
  }
  options.scalars = surface.scalars;
  if (!output.color_by.empty()) {
    const std::string name = scalars_name(output.color_by);
    if (!has_scalars(surface, name)) {
      options.scalars.push_back(scalars_of("--color-by", output.color_by, surface));
    }
    options.colour = ColourBy{name, map_of(output.colours, name), output.colours.range};
  }
  options.up = output.up.value_or(options.up);
  options.metres_per_unit = output.metres_per_unit.value_or(options.metres_per_unit);
  return write_gltf(output.path, surface.mesh, options);
}

void add_draco_options(CLI::App& command, SurfaceOutput& output) {
  command
      .add_flag("--draco", output.draco,
                "Compress .glb and .gltf with Draco. --draco=BITS, also for .drc,\n"
                "sets the bits per coordinate, 1 to 24; as many as keep errors within\n"
                "a thousandth of the spacing if not given")
      ->option_text("[=BITS]");
  command
      .add_option_function<std::string>(
          "--draco-method",
          [&output](const std::string& text) {
            output.draco_method = parse_name("--draco-method", text, kDracoMethods);
          },
          "edgebreaker (default) is smallest, sequential keeps the order of\n"
          "vertices and triangles")
      ->option_text("NAME");
  command
      .add_option_function<std::string>(
          "--draco-speed",
          [&output](const std::string& text) {
            output.draco_speed = static_cast<int>(parse_integer("--draco-speed", text, 0, 10));
          },
          "0 small to 10 fast. Default: 5")
      ->option_text("N");
}

std::string kinds_text() {
  std::string text;
  for (const ScalarKind& kind : scalar_kinds()) {
    text += "\n  " + std::string(kind.name);
    text.resize(text.size() + (kind.name.size() < 20 ? 20 - kind.name.size() : 1), ' ');
    text += kind.meaning;
  }
  text += "\n  error  distance from --shape or --reference";
  return text;
}

void add_colour_options(CLI::App& command, SurfaceOutput& output) {
  command
      .add_option(
          "--color-by", output.color_by,
          "Colour .glb and .gltf by a number per vertex, which is written too:" + kinds_text())
      ->option_text("NAME");
  add_colour_scale_options(command, output.colours);
}

}  // namespace

bool SurfaceOutput::is_gltf() const {
  return has_extension(path, kGltfExtensions);
}

void add_surface_options(CLI::App& command, SurfaceOutput& output) {
  command.add_flag("--curvature", output.curvature,
                   "Write mean and Gaussian curvature with each vertex (.ply, .glb, .gltf, .drc)");
  add_draco_options(command, output);
  add_colour_options(command, output);
  command
      .add_option_function<std::string>(
          "--up",
          [&output](const std::string& text) { output.up = parse_name("--up", text, kUpAxes); },
          "The axis that points up, for .glb and .gltf, where that is y: y\n"
          "(default) leaves coordinates as they are, z has viewers turn them")
      ->option_text("AXIS");
  command
      .add_option_function<std::string>(
          "--metres-per-unit",
          [&output](const std::string& text) {
            output.metres_per_unit = parse_number("--metres-per-unit", text, {1e-30, 1e30});
          },
          "The unit of the field's lengths, for .glb and .gltf. Default: 1")
      ->option_text("M");
}

void check_surface_output(const SurfaceOutput& output, const std::vector<std::string>& scalars) {
  if (!has_extension(output.path, kMeshExtensions)) {
    throw CLI::ValidationError(
        "--output",
        "'" + output.path + "' has an unknown extension; meshes are " + joined(kMeshExtensions));
  }
  const auto check = [&](bool is_given, bool fits, const char* option, const char* formats) {
    if (is_given && !fits) {
      throw CLI::ValidationError(option, "'" + output.path + "' is neither " + formats);
    }
  };
  const bool gltf = output.is_gltf();
  const bool draco = (gltf && !output.draco.empty()) || is_drc(output);
  check(!output.draco.empty(), gltf || is_drc(output), "--draco", ".glb, .gltf nor .drc");
  check(output.draco_method.has_value(), draco, "--draco-method", ".drc nor is --draco given");
  check(output.draco_speed.has_value(), draco, "--draco-speed", ".drc nor is --draco given");
  check(output.curvature, gltf || is_drc(output) || has_extension(output.path, kPlyExtensions),
        "--curvature", ".ply, .glb, .gltf nor .drc");
  check(!output.color_by.empty(), gltf, "--color-by", ".glb nor .gltf");
  check(output.up.has_value(), gltf, "--up", ".glb nor .gltf");
  check(output.metres_per_unit.has_value(), gltf, "--metres-per-unit", ".glb nor .gltf");
  if (output.color_by.empty() && (output.colours.map || output.colours.range)) {
    throw CLI::ValidationError(output.colours.map ? "--color-map" : "--color-range",
                               "needs --color-by");
  }
  // Wrong words are told before the work begins.
  (void)draco_options(output, 1.0);
  ScalarMesh promised;
  for (const std::string& name : scalars) {
    promised.scalars.push_back({name, {}});
  }
  check(!scalars.empty(), gltf || is_drc(output), "--shape and --reference",
        ".glb, .gltf nor .drc");
  if (!output.color_by.empty()) {
    (void)scalars_of("--color-by", output.color_by, promised);
  }
}

MeshFileReport write_surface(const SurfaceOutput& output, const ScalarMesh& surface,
                             double cell_size) {
  if (output.is_gltf()) {
    return write_as_gltf(output, surface, cell_size);
  }
  if (is_drc(output)) {
    WriteDrcOptions options;
    options.scalars = surface.scalars;
    options.draco = draco_options(output, cell_size);
    return write_drc(output.path, surface.mesh, options);
  }
  WriteMeshOptions options;
  options.scalars = surface.scalars;
  return write_mesh(output.path, surface.mesh, options);
}

std::string file_text(const MeshFileReport& report) {
  std::string text = count_of(report.bytes, "byte");
  if (report.position_bits > 0) {
    text += ", positions of " + std::to_string(report.position_bits) + " bits";
  }
  return text + (report.position_error > 0.0
                     ? ", coordinates off by " + rounded(report.position_error, 3) + " at most"
                     : ", coordinates exact");
}

std::optional<std::string> rounding_warning(const SurfaceOutput& output,
                                            const MeshFileReport& report, double cell_size) {
  const bool asked_for = !output.draco.empty() && output.draco != "true";
  const bool coarse = report.position_error > kCoarse * cell_size && !asked_for;
  if (!coarse && report.collapsed_triangles == 0) {
    return std::nullopt;
  }
  std::string text = "'" + output.path + "': coordinates are off by up to " +
                     rounded(report.position_error, 3) + ", " +
                     rounded(report.position_error / cell_size, 3) + " times the spacing";
  if (report.collapsed_triangles > 0) {
    text += ", and " + std::to_string(report.collapsed_triangles) + " of " +
            count_of(report.triangles, "triangle") + " collapse";
  }
  return text + "; .ply, .obj and .off keep all digits";
}

}  // namespace difmesh::cli
