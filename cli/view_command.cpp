// difmesh view: a page that shows one surface or two.

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "difmesh/error.hpp"
#include "difmesh/io/glb.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/reconstruct.hpp"
#include "field_input.hpp"
#include "json.hpp"
#include "long_call.hpp"
#include "mesh_scalars.hpp"
#include "names.hpp"
#include "output_file.hpp"
#include "parse.hpp"
#include "reference_input.hpp"
#include "text.hpp"
#include "view_page.hpp"

namespace difmesh::cli {
namespace {

constexpr const char* kDescription =
    "Makes a page that shows a surface in any browser.\n"
    "\n"
    "The page is one file with all that it needs; nothing is fetched when it is opened. It turns "
    "and\n"
    "zooms, shows wireframes, and colors by numbers per vertex: those in the file, x, y, z, the "
    "angle\n"
    "between facets and curvature. Two surfaces are shown side by side or in turn. A field is\n"
    "reconstructed: linear and "
    "plic.\n";

/// Browsers hold no longer text: Chromium's limit, which is the lowest.
constexpr std::size_t kMostBytes = (std::size_t{1} << 29U) - 24;

constexpr const char* kFooter =
    "Examples:\n"
    "  difmesh view drops.nrrd -o drops.html                     linear against plic\n"
    "  difmesh view bunny.glb -o bunny.html --color-by angle\n"
    "  difmesh view ball.nrrd -o ball.html --color-by error --shape sphere\n"
    "  difmesh view part.stl part_again.ply -o both.html --up z\n";

struct Request {
  FieldInput input;
  std::string second_path;
  std::string page_path;
  std::string color_by;
  ColorScale colors;
  ReferenceInput reference;
  UpAxis up = UpAxis::y;
  bool quiet = false;
};

struct Shown {
  std::string name;
  MeshFile surface;
};

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

bool is_field(const FieldInput& input) {
  return input.is_raw() || has_extension(input.path, kFieldExtensions);
}

Shown reconstructed(const LoadedField& field, const std::string& path, Placement placement,
                    const std::string& name, bool quiet) {
  LongCall long_call("reconstructing", quiet);
  Options options;
  options.placement = placement;
  options.vertex_normals = true;
  options.progress = long_call.progress();
  try {
    Shown shown{name, {reconstruct(field.file.view(), field.grid, options).mesh}};
    long_call.done();
    return shown;
  } catch (const Error& error) {
    throw Error(error.code(), "'" + path + "': " + error.what());
  }
}

MeshFile read_surface(const std::string& path, bool allow_outside) {
  if (!is_mesh_file(path)) {
    throw Error(ErrorCode::file_format, "'" + path + "': unknown extension; meshes are " +
                                            mesh_extensions_text() + ", fields " +
                                            joined(kFieldExtensions));
  }
  return read_mesh_file(path, {.outside_files = allow_outside});
}

/// A field alone gives two surfaces; beside another input it gives one.
void load(const Request& request, const FieldInput& input, bool alone, std::vector<Shown>& shown) {
  const std::string name = file_name(input.path);
  if (!is_field(input)) {
    shown.push_back({name, read_surface(input.path, input.allow_outside)});
    return;
  }
  const LoadedField field = load_field(input);
  if (alone) {
    shown.push_back(reconstructed(field, input.path, Placement::linear, "linear", request.quiet));
  }
  shown.push_back(
      reconstructed(field, input.path, Placement::plic, alone ? "plic" : name, request.quiet));
  std::vector<std::string>& warnings = shown.back().surface.warnings;
  warnings.insert(warnings.end(), field.file.warnings.begin(), field.file.warnings.end());
  const std::string doubt = scale_warning(input, field.file);
  if (shown.back().surface.mesh.triangles.empty()) {
    throw Error(ErrorCode::invalid_value,
                doubt.empty() ? "'" + name + "': the surface is empty" : doubt);
  }
  warnings.insert(warnings.end(), doubt.empty() ? 0 : 1, doubt);
}

std::vector<Shown> load_all(const Request& request) {
  std::vector<Shown> shown;
  load(request, request.input, request.second_path.empty(), shown);
  if (!request.second_path.empty()) {
    FieldInput second;
    second.path = request.second_path;
    second.allow_outside = request.input.allow_outside;
    load(request, second, false, shown);
  }
  std::vector<std::string> warnings;
  for (Shown& one : shown) {
    warnings.insert(warnings.end(), one.surface.warnings.begin(), one.surface.warnings.end());
    if (one.surface.mesh.triangles.empty()) {
      throw Error(ErrorCode::invalid_value, "'" + one.name + "': the surface is empty");
    }
    if (request.reference.is_given()) {
      Mesh& mesh = one.surface.mesh;
      std::erase_if(mesh.scalars,
                    [](const VertexScalar& scalars) { return scalars.name == kErrorName; });
      mesh.scalars.push_back(errors_of(mesh, request.reference, request.quiet, warnings));
    }
  }
  if (!request.quiet) {
    warn_all(warnings);
  }
  return shown;
}

/// Adds the scalars that there are beside those of the file.
void add_all_scalars(Mesh& mesh) {
  for (const ScalarKind& kind : scalar_kinds()) {
    const std::string name(kind.name);
    if (!has_scalars(mesh, name)) {
      mesh.scalars.push_back({name, kind.of(mesh)});
    }
  }
}

std::vector<std::array<int, 3>> color_table(ColorMap map) {
  std::vector<std::array<int, 3>> table;
  for (int i = 0; i < 256; ++i) {
    const Color color = color_of(map, i / 255.0);
    table.push_back({static_cast<int>(std::lround(255.0 * color[0])),
                     static_cast<int>(std::lround(255.0 * color[1])),
                     static_cast<int>(std::lround(255.0 * color[2]))});
  }
  return table;
}

Json scene_json(const Request& request, std::vector<Shown>& shown) {
  Json scene;
  scene["title"] = file_name(request.input.path) +
                   (request.second_path.empty() ? "" : ", " + file_name(request.second_path));
  scene["surfaces"] = Json::array();
  for (Shown& one : shown) {
    if (!request.color_by.empty()) {
      (void)scalars_of("--color-by", request.color_by, one.surface.mesh);
    }
    add_all_scalars(one.surface.mesh);
    WriteMeshOptions options;
    options.edge_ids = false;
    options.up = request.up;
    options.name = one.name;
    scene["surfaces"].push_back(
        {{"name", one.name}, {"glb", encode_glb_base64(one.surface.mesh, options)}});
  }
  const ColorMap map = map_of(request.colors, request.color_by);
  scene["colors"] = color_table(map);
  scene["diverging"] = map == ColorMap::cool_warm;
  scene["colorBy"] = scalars_name(request.color_by);
  if (request.colors.range) {
    scene["range"] = *request.colors.range;
  }
  return scene;
}

/// As text within HTML: a script element ends at the first "</script".
std::string without_tags(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at)) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

void run(const Request& request) {
  check_reference(request.reference);
  check_output("--output", request.page_path, request.input.path);
  check_output("--output", request.page_path, request.reference.path);
  if (!request.second_path.empty()) {
    check_output("--output", request.page_path, request.second_path);
  }
  std::vector<Shown> shown = load_all(request);
  const Json scene = scene_json(request, shown);
  std::string page(kPageBeforeScene);
  page += without_tags(scene.dump(-1, ' ', false, Json::error_handler_t::replace));
  page += kPageAfterScene;
  const std::size_t bytes = page.size();
  if (bytes > kMostBytes) {
    throw Error(ErrorCode::too_large, "'" + request.page_path + "': a page of " +
                                          std::to_string(bytes) +
                                          " bytes is more than browsers can read, 512 MiB");
  }
  OutputFile(request.page_path, std::move(page)).commit();
  if (request.quiet) {
    return;
  }
  print_fact(std::cout, "page", request.page_path);
  for (const Shown& one : shown) {
    print_fact(
        std::cout, "surface",
        one.name + ", " +
            count_of(static_cast<std::int64_t>(one.surface.mesh.triangles.size()), "triangle"));
  }
  print_fact(std::cout, "size", count_of(static_cast<std::int64_t>(bytes), "byte"));
}

void add_color_options(CLI::App& command, Request& request) {
  command
      .add_option("--color-by", request.color_by,
                  "Number per vertex to color by at first; the page offers all")
      ->option_text("NAME");
  add_color_scale_options(command, request.colors);
  command
      .add_option_function<std::string>(
          "--up",
          [&request](const std::string& text) { request.up = parse_name("--up", text, kUpAxes); },
          "The axis that points up: y (default) or z")
      ->option_text("AXIS");
}

}  // namespace

void add_view_command(CLI::App& program) {
  const auto request = std::make_shared<Request>();
  CLI::App& command = *program.add_subcommand("view", kDescription);
  command.footer(kFooter);
  command
      .add_option("MESH|FIELD", request->input.path,
                  "Mesh (" + mesh_extensions_text() +
                      ") or field (.npy, .nrrd, .nhdr,\n"
                      "raw)")
      ->required();
  command.add_option("SECOND", request->second_path, "Another mesh or field to show with it");
  command.add_option("-o,--output", request->page_path, "Page to write (.html)")
      ->required()
      ->option_text("PAGE");
  add_color_options(command, *request);
  command.add_flag("--quiet", request->quiet, "Print nothing but errors");
  add_field_options(command, request->input);
  add_reference_options(command, request->reference);
  command.callback([request] {
    request->reference.allow_outside = request->input.allow_outside;
    run(*request);
  });
}

}  // namespace difmesh::cli
