// difmesh info: what a field or a mesh holds, as text or JSON.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.hpp"
#include "difmesh/error.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "field_facts.hpp"
#include "field_input.hpp"
#include "json.hpp"
#include "mesh_facts.hpp"
#include "names.hpp"
#include "output_file.hpp"
#include "parse.hpp"
#include "roughness.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

constexpr const char* kDescription =
    "Tells what a field or a mesh holds.\n"
    "\n"
    "Of a field: type, grid, range, filled volume, and the cells that flow solvers get wrong: "
    "wisps,\n"
    "overshoot, NaN. Of a mesh: whether it is closed and manifold, its volume, area, topology and\n"
    "roughness (rms angle between neighbouring facets).\n";

constexpr const char* kFooter =
    "Examples:\n"
    "  difmesh info drops.nrrd\n"
    "  difmesh info drops.ply\n"
    "  difmesh info drops.ply --json drops.json\n"
    "  difmesh info ct.raw --raw-dims 512,512,300 --raw-type uint16 --raw-big-endian\n";

struct Request {
  FieldInput input;  ///< its path may be that of a mesh
  double purity_tolerance = Options{}.purity_tolerance;
  std::string json_path;
};

Json field_json(const LoadedField& field, const FieldFacts& facts) {
  const auto cell_or_null = [](const std::optional<Index3>& cell) {
    return cell ? Json(*cell) : Json();
  };
  return {{"type", name_of(field.file.file_type)},
          {"dims", field.grid.dims},
          {"origin", uniform_json(field.grid, field.grid.origin)},
          {"origin_from", name_of(field.origin_from)},
          {"spacing", uniform_json(field.grid, field.grid.spacing)},
          {"spacing_from", name_of(field.spacing_from)},
          {"edges", edges_json(field.grid)},
          {"cells", facts.cells},
          {"lowest", facts.lowest ? Json(*facts.lowest) : Json()},
          {"highest", facts.highest ? Json(*facts.highest) : Json()},
          {"fraction_volume", facts.fraction_volume},
          {"interfacial_cells", facts.interfacial},
          {"empty_cells", facts.empty},
          {"full_cells", facts.full},
          {"nearly_empty_cells", facts.nearly_empty},
          {"nearly_full_cells", facts.nearly_full},
          {"cells_outside", facts.outside},
          {"largest_overshoot", facts.largest_overshoot},
          {"largest_overshoot_cell", cell_or_null(facts.largest_overshoot_cell)},
          {"nan_cells", facts.nan},
          {"first_nan_cell", cell_or_null(facts.first_nan_cell)}};
}

std::string number_or_none(const std::optional<double>& number) {
  return number ? exact(*number) : "none";
}

void print_field(std::ostream& out, const Request& request, const LoadedField& field,
                 const FieldFacts& facts) {
  const std::string tolerance = exact(request.purity_tolerance);
  print_fact(out, "field", request.input.path);
  print_fact(out, "type", name_of(field.file.file_type));
  print_fact(out, "cells", dims_text(field.grid.dims) + " = " + std::to_string(facts.cells));
  print_axes(out, field);
  print_fact(out, "lowest fraction", number_or_none(facts.lowest));
  print_fact(out, "highest fraction", number_or_none(facts.highest));
  print_fact(out, "fraction volume",
             rounded(facts.fraction_volume, 10) +
                 "  (sum of fraction x cell volume, fractions clamped to [0, 1])");
  print_fact(out, "interfacial",
             count_of(facts.interfacial, "cell") + "  (" + tolerance + " < fraction < 1 - " +
                 tolerance + ")");
  print_fact(out, "exactly 0", count_of(facts.empty, "cell"));
  print_fact(out, "exactly 1", count_of(facts.full, "cell"));
  print_fact(out, "nearly 0",
             count_of(facts.nearly_empty, "cell") + "  (0 < |fraction| <= " + tolerance + ")");
  print_fact(out, "nearly 1",
             count_of(facts.nearly_full, "cell") + "  (1 - " + tolerance + " <= fraction < 1)");
  print_fact(out, "outside [0, 1]",
             count_of(facts.outside, "cell") +
                 (facts.largest_overshoot_cell
                      ? ", the farthest by " + rounded(facts.largest_overshoot, 6) + " at " +
                            cell_text(*facts.largest_overshoot_cell)
                      : ""));
  print_fact(
      out, "NaN",
      count_of(facts.nan, "cell") +
          (facts.first_nan_cell ? ", the first at " + cell_text(*facts.first_nan_cell) : ""));
}

Json mesh_json(const Mesh& mesh, const Measure& facts, const std::optional<double>& roughness) {
  const std::optional<double> volume = enclosed_volume(facts);
  return {{"vertices", facts.vertices},
          {"triangles", facts.triangles},
          {"edges", facts.edges},
          {"closed", facts.closed},
          {"manifold", facts.manifold},
          {"boundary_edges", facts.boundary_edges},
          {"non_manifold_edges", facts.non_manifold_edges},
          {"misoriented_edges", facts.misoriented_edges},
          {"unbalanced_edges", facts.unbalanced_edges},
          {"non_manifold_vertices", facts.non_manifold_vertices},
          {"isolated_vertices", facts.isolated_vertices},
          {"degenerate_triangles", facts.degenerate_triangles},
          {"components", facts.components},
          {"euler_number", facts.euler_number},
          {"area", facts.area},
          {"closed_by_position", facts.has_volume},
          {"volume", volume ? Json(*volume) : Json()},
          {"low", facts.low},
          {"high", facts.high},
          {"roughness_degrees", roughness ? Json(*roughness) : Json()},
          {"vertex_normals", !mesh.normals.empty()}};
}

std::string volume_text(const Measure& facts) {
  if (const std::optional<double> volume = enclosed_volume(facts)) {
    return rounded(*volume, 10);
  }
  return facts.closed ? "none, the mesh has mixed orientation" : "none, the mesh is not closed";
}

std::string closed_text(const Measure& facts) {
  if (facts.closed) {
    return "yes";
  }
  std::string text = "no: ";
  if (facts.boundary_edges > 0) {
    text += count_of(facts.boundary_edges, "boundary edge");
  }
  if (facts.unbalanced_edges > 0) {
    text += text.size() > 4 ? ", " : "";
    text += count_of(facts.unbalanced_edges, "edge") + " of three triangles or more unbalanced";
  }
  return text + (facts.has_volume ? "; closed where equal positions are joined" : "");
}

std::string manifold_text(const Measure& facts) {
  if (facts.manifold) {
    return "yes";
  }
  return "no: " + count_of(facts.non_manifold_edges, "non-manifold edge") + ", " +
         std::to_string(facts.non_manifold_vertices) +
         (facts.non_manifold_vertices == 1 ? " non-manifold vertex, "
                                           : " non-manifold vertices, ") +
         count_of(facts.misoriented_edges, "misoriented edge");
}

void print_mesh(std::ostream& out, const std::string& path, const Measure& facts,
                const std::optional<double>& roughness) {
  print_fact(out, "mesh", path);
  print_fact(out, "vertices",
             std::to_string(facts.vertices) +
                 (facts.isolated_vertices > 0
                      ? ", of these in no triangle: " + std::to_string(facts.isolated_vertices)
                      : ""));
  print_fact(out, "triangles",
             std::to_string(facts.triangles) +
                 (facts.degenerate_triangles > 0
                      ? ", of these without area: " + std::to_string(facts.degenerate_triangles)
                      : ""));
  print_fact(out, "closed", closed_text(facts));
  print_fact(out, "manifold", manifold_text(facts));
  print_fact(out, "components", std::to_string(facts.components));
  print_fact(out, "Euler number", std::to_string(facts.euler_number));
  print_fact(out, "area", rounded(facts.area, 10));
  print_fact(out, "enclosed volume", volume_text(facts));
  print_fact(out, "box", rounded(facts.low, 8) + "  to  " + rounded(facts.high, 8));
  print_fact(out, "roughness",
             roughness
                 ? rounded(*roughness, 4) + " degrees  (rms angle between neighbouring facets)"
                 : "none, no two triangles share an edge");
}

enum class Kind : std::uint8_t { field, mesh };

Kind kind_of(const FieldInput& input) {
  if (input.is_raw() || has_extension(input.path, kFieldExtensions)) {
    return Kind::field;
  }
  if (!is_mesh_file(input.path)) {
    throw Error(ErrorCode::file_format,
                "'" + input.path + "': unknown extension; fields are " + joined(kFieldExtensions) +
                    " or, with --raw-dims, raw; meshes are " + mesh_extensions_text());
  }
  const bool is_stretched = input.is_stretched(0) || input.is_stretched(1) || input.is_stretched(2);
  if (input.origin || input.spacing || is_stretched) {
    throw CLI::ValidationError(input.origin    ? "--origin"
                               : input.spacing ? "--spacing"
                                               : "--edges",
                               "'" + input.path + "' is a mesh, it has no grid");
  }
  if (input.full_value || !input.labels.empty()) {
    throw CLI::ValidationError(input.full_value ? "--full-value" : "--label",
                               "'" + input.path + "' is a mesh, it has no values");
  }
  return Kind::mesh;
}

void output(const Request& request, const char* key, Json facts,
            const std::vector<std::string>& warnings) {
  Json json = json_head();
  json["path"] = request.input.path;
  json[key] = std::move(facts);
  json["warnings"] = warnings;
  OutputFile(request.json_path, to_text(json)).commit();
}

void run(const Request& request) {
  const bool as_json = !request.json_path.empty();
  if (as_json) {
    check_output("--json", request.json_path, request.input.path);
  }
  if (kind_of(request.input) == Kind::field) {
    const LoadedField field = load_field(request.input);
    const FieldFacts facts = look_at_field(field.file.view(), field.grid, request.purity_tolerance);
    std::vector<std::string> warnings = field.file.warnings;
    const std::string doubt = scale_warning(request.input, field.file);
    warnings.insert(warnings.end(), doubt.empty() ? 0 : 1, doubt);
    warn_all(warnings);
    as_json ? output(request, "field", field_json(field, facts), warnings)
            : print_field(std::cout, request, field, facts);
    return;
  }
  const auto [mesh, warnings] =
      read_mesh_file(request.input.path, {.outside_files = request.input.allow_outside});
  warn_all(warnings);
  const Measure facts = measure(mesh);
  const std::optional<double> roughness = roughness_degrees(mesh);
  as_json ? output(request, "mesh", mesh_json(mesh, facts, roughness), warnings)
          : print_mesh(std::cout, request.input.path, facts, roughness);
}

}  // namespace

void add_info_command(CLI::App& program) {
  const auto request = std::make_shared<Request>();
  CLI::App& command = *program.add_subcommand("info", kDescription);
  command.footer(kFooter);
  command
      .add_option("FIELD|MESH", request->input.path,
                  "Field (.npy, .nrrd, .nhdr, raw) or mesh (" + mesh_extensions_text() + ")")
      ->required();
  add_field_options(command, request->input);
  command
      .add_option_function<std::string>(
          "--purity-tolerance",
          [request](const std::string& text) {
            request->purity_tolerance =
                parse_number("--purity-tolerance", text, kPurityToleranceRange);
          },
          "Fields: a fraction so close to 0 or 1 counts as empty or full.\n"
          "Default: 1e-6")
      ->option_text("T");
  command
      .add_option("--json", request->json_path,
                  "Write the facts as JSON to FILE instead of text; - is standard output")
      ->option_text("FILE");
  command.callback([request] { run(*request); });
}

}  // namespace difmesh::cli
