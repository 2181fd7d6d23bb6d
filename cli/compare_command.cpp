// difmesh compare: how far a mesh is from a shape or from a reference mesh.

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "difmesh/error.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/metrics/distance.hpp"
#include "json.hpp"
#include "long_call.hpp"
#include "mesh_facts.hpp"
#include "names.hpp"
#include "output_file.hpp"
#include "parse.hpp"
#include "reference_input.hpp"
#include "shape_options.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

constexpr const char* kDescription =
    "Measures how far a mesh is from a shape or from another mesh.\n"
    "\n"
    "Distances are taken at vertices and at points on the facets, four or more per triangle; "
    "means\n"
    "over facets are integrals over the surface. To a reference mesh they are measured both ways.\n"
    "Distances are positive outside, where the reference has an inside; rms, mean and maximum are\n"
    "those of their sizes.\n";

constexpr const char* kFooter =
    "Examples:\n"
    "  difmesh compare sphere.ply --shape sphere\n"
    "  difmesh compare torus.ply --shape torus --tube-radius 0.3 --json torus.json\n"
    "  difmesh compare part_again.ply --reference part.stl\n";

struct Request {
  std::string mesh_path;
  ReferenceInput reference;
  std::string json_path;
  std::optional<double> facet_spacing;
  bool without_sign = false;
  int threads = 0;
};

struct Comparison {
  Distance to_reference;
  std::optional<MeshDistance> both_ways;  ///< where the reference is a mesh
  Json reference;
  std::optional<double> volume;
  std::optional<double> reference_volume;
  std::vector<std::string> warnings;  ///< of the files

  /// Relative.
  [[nodiscard]] std::optional<double> volume_difference() const {
    if (!volume || !reference_volume || *reference_volume == 0.0) {
      return std::nullopt;
    }
    return (*volume - *reference_volume) / *reference_volume;
  }
};

/// A mesh that cannot be measured is a fault of its file, not of the command line.
Error error_in(const std::string& path, const Error& error) {
  const ErrorCode code =
      error.code() == ErrorCode::invalid_argument ? ErrorCode::file_format : error.code();
  return {code, "'" + path + "': " + error.what()};
}

std::optional<double> volume_of(const Mesh& mesh) {
  return enclosed_volume(measure(mesh));
}

Comparison compare_with_shape(const Request& request, const DistanceOptions& options) {
  const Shape shape =
      request.reference.shape.make(parse_shape("--shape", request.reference.shape_name));
  Comparison comparison;
  const Mesh mesh =
      read_triangles(request.mesh_path, request.reference.allow_outside, comparison.warnings);
  try {
    comparison.to_reference = distance(mesh, shape, options);
  } catch (const Error& error) {
    throw error_in(request.mesh_path, error);
  }
  comparison.reference = {{"shape", shape_json(shape)}};
  comparison.volume = volume_of(mesh);
  comparison.reference_volume = shape.volume();
  return comparison;
}

Comparison compare_with_mesh(const Request& request, const DistanceOptions& options) {
  Comparison comparison;
  const Mesh mesh =
      read_triangles(request.mesh_path, request.reference.allow_outside, comparison.warnings);
  const Mesh reference =
      read_triangles(request.reference.path, request.reference.allow_outside, comparison.warnings);
  try {
    comparison.both_ways = distance(mesh, reference, options);
  } catch (const Error& error) {
    throw error_in(request.mesh_path + "' and '" + request.reference.path, error);
  }
  comparison.to_reference = comparison.both_ways->to_reference;
  comparison.reference = {{"path", request.reference.path}};
  comparison.volume = volume_of(mesh);
  comparison.reference_volume = volume_of(reference);
  return comparison;
}

Json statistics_json(const DistanceStatistics& of, bool has_sign) {
  const auto if_signed = [has_sign](double value) { return has_sign ? Json(value) : Json(); };
  return {{"points", of.points},
          {"rms", of.rms},
          {"mean", of.mean},
          {"signed_mean", if_signed(of.signed_mean)},
          {"lowest", of.lowest},
          {"highest", of.highest},
          {"maximum", of.maximum},
          {"maximum_index", of.maximum_index},
          {"maximum_position", of.maximum_position}};
}

Json distance_json(const Distance& distance) {
  return {{"vertices", statistics_json(distance.vertices, distance.has_sign)},
          {"facets", statistics_json(distance.facets, distance.has_sign)},
          {"area", distance.area},
          {"reach", distance.reach},
          {"has_sign", distance.has_sign}};
}

Json comparison_json(const Request& request, const Comparison& comparison) {
  const auto or_null = [](const std::optional<double>& number) {
    return number ? Json(*number) : Json();
  };
  const std::optional<MeshDistance>& both = comparison.both_ways;
  Json json = json_head();
  json["path"] = request.mesh_path;
  json["reference"] = comparison.reference;
  json["to_reference"] = distance_json(comparison.to_reference);
  json["from_reference"] = both ? distance_json(both->from_reference) : Json();
  json["hausdorff"] = both ? Json(both->hausdorff) : Json();
  json["volume"] = or_null(comparison.volume);
  json["reference_volume"] = or_null(comparison.reference_volume);
  json["volume_difference"] = or_null(comparison.volume_difference());
  json["warnings"] = comparison.warnings;
  return json;
}

void print_statistics(std::ostream& out, const std::string& of, const DistanceStatistics& found,
                      const std::string& place) {
  print_fact(out, of + " rms", rounded(found.rms, 6));
  print_fact(out, of + " mean", rounded(found.mean, 6));
  print_fact(out, of + " maximum",
             rounded(found.maximum, 6) + "  at " + rounded(found.maximum_position, 8) + ", " +
                 place + " " + std::to_string(found.maximum_index));
}

void print_distances(std::ostream& out, const Comparison& comparison) {
  const Distance& to = comparison.to_reference;
  print_fact(out, "points",
             std::to_string(to.vertices.points) + " vertices, " + std::to_string(to.facets.points) +
                 " facet points");
  print_statistics(out, "vertices", to.vertices, "vertex");
  print_statistics(out, "facets", to.facets, "triangle");
  if (to.has_sign) {
    print_fact(out, "facets bias",
               rounded(to.facets.signed_mean, 6) + "  (mean with sign, < 0 inside)");
  }
  if (comparison.both_ways) {
    const MeshDistance& both = *comparison.both_ways;
    print_statistics(out, "back", both.from_reference.facets, "triangle of the reference");
    const double reach = std::max(to.reach, both.from_reference.reach);
    print_fact(
        out, "Hausdorff",
        rounded(both.hausdorff, 6) + " or more, at most " + rounded(both.hausdorff + reach, 6));
  }
}

void print_volumes(std::ostream& out, const Comparison& comparison) {
  const auto text = [](const std::optional<double>& volume) {
    return volume ? rounded(*volume, 10) : "none, it is open or its orientation is mixed";
  };
  print_fact(out, "volume", text(comparison.volume));
  print_fact(out, "reference volume", text(comparison.reference_volume));
  if (const std::optional<double> difference = comparison.volume_difference()) {
    print_fact(out, "difference",
               (*difference < 0.0 ? "" : "+") + rounded(*difference, 3) + " of the reference's");
  }
}

void print_comparison(std::ostream& out, const Request& request, const Comparison& comparison) {
  print_fact(out, "mesh", request.mesh_path);
  print_fact(
      out, "reference",
      request.reference.shape_name.empty() ? request.reference.path : request.reference.shape_name);
  print_distances(out, comparison);
  print_volumes(out, comparison);
}

void check_request(const Request& request) {
  check_reference(request.reference);
  if (!request.reference.is_given()) {
    throw CLI::ValidationError("--shape", "needed, or --reference");
  }
  if (request.without_sign && request.reference.path.empty()) {
    throw CLI::ValidationError("--without-sign", "only for a reference mesh");
  }
  if (!request.json_path.empty()) {
    check_output("--json", request.json_path, request.mesh_path);
    check_output("--json", request.json_path, request.reference.path);
  }
}

void run(const Request& request) {
  check_request(request);
  const bool as_json = !request.json_path.empty();
  LongCall long_call("comparing", false);
  DistanceOptions options;
  options.facet_spacing = request.facet_spacing.value_or(options.facet_spacing);
  options.with_sign = !request.without_sign;
  options.threads = request.threads;
  options.progress = long_call.progress();
  const Comparison comparison = request.reference.shape_name.empty()
                                    ? compare_with_mesh(request, options)
                                    : compare_with_shape(request, options);
  long_call.done();
  warn_all(comparison.warnings);
  if (as_json) {
    OutputFile(request.json_path, to_text(comparison_json(request, comparison))).commit();
  } else {
    print_comparison(std::cout, request, comparison);
  }
}

}  // namespace

void add_compare_command(CLI::App& program) {
  const auto request = std::make_shared<Request>();
  CLI::App& command = *program.add_subcommand("compare", kDescription);
  command.footer(kFooter);
  command
      .add_option("MESH", request->mesh_path, "Mesh to measure (" + mesh_extensions_text() + ")")
      ->required();
  command
      .add_option("--json", request->json_path,
                  "Write the facts as JSON to FILE instead of text; - is standard output")
      ->option_text("FILE");
  command
      .add_option_function<std::string>(
          "--facet-spacing",
          [request](const std::string& text) {
            request->facet_spacing =
                parse_number("--facet-spacing", text, {0.0, std::numeric_limits<double>::max()});
          },
          "How far facet points are from the next ones on their triangle at most, in the unit of\n"
          "the mesh; 0, the default: as far as the usual triangle's four points")
      ->option_text("LENGTH");
  command.add_flag("--without-sign", request->without_sign,
                   "Do not tell inside from outside of a reference mesh");
  add_threads_option(command, "The distances do", request->threads);
  add_reference_options(command, request->reference);
  command.add_flag("--allow-outside", request->reference.allow_outside, kAllowOutsideHelp);
  command.callback([request] { run(*request); });
}

}  // namespace difmesh::cli
