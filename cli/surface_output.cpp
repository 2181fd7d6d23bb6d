#include "surface_output.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "difmesh/io/mesh_file.hpp"
#include "mesh_scalars.hpp"
#include "names.hpp"
#include "parse.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

// Of the spacing: as much as second-order vertices are off by on coarse grids.
constexpr double kCoarse = 0.01;

bool has_colors(const MeshFormat& format) {
  return format.colors;
}
bool has_scene(const MeshFormat& format) {
  return format.scene;
}
bool has_scalar_place(const MeshFormat& format) {
  return format.scalars;
}
bool has_compression(const MeshFormat& format) {
  return format.compression != Compression::none;
}
bool is_compressed(const MeshFormat& format) {
  return format.compression == Compression::always;
}
bool is_exact(const MeshFormat& format) {
  return format.exact;
}

/// ".ply, .glb and .gltf", with "nor" for instance in the place of "and".
std::string listed(HasFormat has, const std::string& last_joint) {
  std::vector<std::string_view> words = mesh_extensions(has);
  const std::string last(words.back());
  words.pop_back();
  return words.empty() ? last : joined(words) + " " + last_joint + " " + last;
}

/// \pre the extension is known
const MeshFormat& format_of(const SurfaceOutput& output) {
  return *mesh_format_of(output.path);
}

bool uses_draco(const SurfaceOutput& output) {
  const MeshFormat& format = format_of(output);
  return is_compressed(format) || (has_compression(format) && !output.draco.empty());
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

void add_draco_options(CLI::App& command, SurfaceOutput& output) {
  command
      .add_flag(
          "--draco", output.draco,
          "Compress " +
              listed([](const MeshFormat& f) { return f.compression == Compression::optional; },
                     "and") +
              " with Draco. --draco=BITS, also for " + listed(is_compressed, "and") +
              ",\n"
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

void add_color_options(CLI::App& command, SurfaceOutput& output) {
  command
      .add_option("--color-by", output.color_by,
                  "Color " + listed(has_colors, "and") +
                      " by a number per vertex, which is written too:" + kinds_text())
      ->option_text("NAME");
  add_color_scale_options(command, output.colors);
}

}  // namespace

bool SurfaceOutput::shows_normals() const {
  const MeshFormat* const format = mesh_format_of(path);
  return format != nullptr && has_scene(*format);
}

void add_surface_options(CLI::App& command, SurfaceOutput& output) {
  command.add_flag("--curvature", output.curvature,
                   "Write mean and Gaussian curvature with each vertex (" +
                       mesh_extensions_text(has_scalar_place) +
                       "),\nwith --placement curved from the cells' surfaces, else from patches");
  add_draco_options(command, output);
  add_color_options(command, output);
  command
      .add_option_function<std::string>(
          "--up",
          [&output](const std::string& text) { output.up = parse_name("--up", text, kUpAxes); },
          "The axis that points up, for " + listed(has_scene, "and") +
              ", where that is y: y\n"
              "(default) leaves coordinates as they are, z has viewers turn them")
      ->option_text("AXIS");
  command
      .add_option_function<std::string>(
          "--metres-per-unit",
          [&output](const std::string& text) {
            output.metres_per_unit = parse_number("--metres-per-unit", text, {1e-30, 1e30});
          },
          "The unit of the field's lengths, for " + listed(has_scene, "and") + ". Default: 1")
      ->option_text("M");
}

void check_surface_output(const SurfaceOutput& output, const std::vector<std::string>& scalars) {
  if (!is_mesh_file(output.path)) {
    throw CLI::ValidationError(
        "--output",
        "'" + output.path + "' has an unknown extension; meshes are " + mesh_extensions_text());
  }
  const auto check = [&](bool is_given, const char* option, HasFormat has) {
    if (is_given && !has(format_of(output))) {
      throw CLI::ValidationError(option, "'" + output.path + "' is neither " + listed(has, "nor"));
    }
  };
  const auto check_draco = [&](bool is_given, const char* option) {
    if (is_given && !uses_draco(output)) {
      throw CLI::ValidationError(option, "'" + output.path + "' is neither " +
                                             listed(is_compressed, "nor") +
                                             " nor is --draco given");
    }
  };
  check(!output.draco.empty(), "--draco", has_compression);
  check_draco(output.draco_method.has_value(), "--draco-method");
  check_draco(output.draco_speed.has_value(), "--draco-speed");
  check(output.curvature, "--curvature", has_scalar_place);
  check(!output.color_by.empty(), "--color-by", has_colors);
  check(output.up.has_value(), "--up", has_scene);
  check(output.metres_per_unit.has_value(), "--metres-per-unit", has_scene);
  if (output.color_by.empty() && (output.colors.map || output.colors.range)) {
    throw CLI::ValidationError(output.colors.map ? "--color-map" : "--color-range",
                               "needs --color-by");
  }
  // Wrong words are told before the work begins.
  (void)draco_options(output, 1.0);
  Mesh promised;
  for (const std::string& name : scalars) {
    promised.scalars.push_back({name, {}});
  }
  check(!scalars.empty(), "--shape and --reference", has_scalar_place);
  if (!output.color_by.empty()) {
    (void)scalars_of("--color-by", output.color_by, promised);
  }
}

MeshFileReport write_surface(const SurfaceOutput& output, Mesh& mesh, double cell_size) {
  WriteMeshOptions options;
  if (uses_draco(output)) {
    options.draco = draco_options(output, cell_size);
  }
  if (!output.color_by.empty()) {
    const std::string name = scalars_name(output.color_by);
    if (!has_scalars(mesh, name)) {
      mesh.scalars.push_back(scalars_of("--color-by", output.color_by, mesh));
    }
    options.color = ColorBy{name, map_of(output.colors, name), output.colors.range};
  }
  options.up = output.up.value_or(options.up);
  options.metres_per_unit = output.metres_per_unit.value_or(options.metres_per_unit);
  return write_mesh(output.path, mesh, options);
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
  return text + "; " + listed(is_exact, "and") + " keep all digits";
}

}  // namespace difmesh::cli
