// difmesh reconstruct: a field in, its surface out.

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "difmesh/cell_planes.hpp"
#include "difmesh/error.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/mollify.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/vertex_curvature.hpp"
#include "field_input.hpp"
#include "json.hpp"
#include "long_call.hpp"
#include "mesh_scalars.hpp"
#include "names.hpp"
#include "output_file.hpp"
#include "parse.hpp"
#include "reference_input.hpp"
#include "smoothing.hpp"
#include "stopwatch.hpp"
#include "surface_output.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

constexpr const char* kDescription =
    "Reconstructs the surface of a field of volume fractions.\n"
    "\n"
    "Reads FIELD (.npy, .nrrd, .nhdr or raw) and writes MESH; its extension (.ply, .obj, .off, "
    ".stl,\n"
    ".glb, .gltf or .drc) tells the format. The mesh is manifold for every field. The defaults "
    "are\n"
    "meant to be used.\n";

constexpr const char* kFooter =
    "Examples:\n"
    "  difmesh reconstruct drops.nrrd -o drops.ply\n"
    "  difmesh reconstruct drops.npy -o drops.stl --spacing 0.01 --boundary mirror\n"
    "  difmesh reconstruct drops.nrrd -o drops.glb --draco --color-by mean_curvature\n"
    "  difmesh reconstruct drops.nrrd -o drops.ply --smooth constrained --curvature\n"
    "  difmesh reconstruct ball.nrrd -o ball.glb --color-by error --shape sphere\n"
    "  difmesh reconstruct tank.npy -o tank.ply --spacing 0.01,0.01,0.02 \\\n"
    "      --boundary periodic,periodic,open,open,empty,open --report tank.json\n"
    "  difmesh reconstruct scan.raw -o scan.ply --raw-dims 256,256,128 --raw-type uint8\n"
    "\n"
    "Ctrl-C stops the work and leaves no file (exit code 130). Files that are being written "
    "already\n"
    "are finished; a second Ctrl-C stops at once.\n";

struct Request {
  FieldInput input;
  SurfaceOutput output;
  ReferenceInput reference;
  std::string report_path;
  Options options;
  std::string mollify;  ///< empty: not asked for; "true": the usual radius; else a radius
  std::optional<Smoothing> smoothing;
  bool quiet = false;

  [[nodiscard]] bool with_summary() const { return !quiet && report_path != "-"; }
};

struct Seconds {
  double read = 0.0;
  double reconstruct = 0.0;
  double write = 0.0;
};

/// The volumes are those of the same body: no side counts as full beyond the domain.
std::optional<double> volume_difference(const Request& request, const Report& report) {
  const Boundary& boundary = request.options.boundary;
  const bool full_beyond =
      std::find(boundary.begin(), boundary.end(), Side::full) != boundary.end();
  if (!report.closed || full_beyond || !(report.fraction_volume > 0.0)) {
    return std::nullopt;
  }
  return (report.enclosed_volume - report.fraction_volume) / report.fraction_volume;
}

/// None where the field is taken as it is.
std::optional<double> mollify_radius(const Request& request) {
  if (request.mollify.empty()) {
    return std::nullopt;
  }
  return request.mollify == "true" ? MollifyOptions{}.radius
                                   : parse_number("--mollify", request.mollify, kMollifyRange);
}

Json options_json(const Request& request) {
  const Options& options = request.options;
  const std::optional<double> radius = mollify_radius(request);
  Json boundary = Json::array();
  for (const Side side : options.boundary) {
    boundary.push_back(name_of(kSides, side));
  }
  return {{"placement", name_of(kPlacements, options.placement)},
          {"normals", name_of(kNormals, options.normals)},
          {"boundary", boundary},
          {"purity_tolerance", options.purity_tolerance},
          {"overshoot_bound", options.overshoot_bound},
          {"clearance", options.clearance},
          {"vertex_normals", options.vertex_normals},
          {"edge_ids", options.edge_ids},
          {"curvature", request.output.curvature},
          {"mollify", radius ? Json(*radius) : Json()},
          {"smooth", request.smoothing ? Json(smoothing_text(*request.smoothing)) : Json()},
          {"threads", options.threads}};
}

Json report_json(const Request& request, const LoadedField& field, const Reconstruction& result,
                 const Seconds& seconds) {
  const Report& report = result.report;
  const std::optional<double> difference = volume_difference(request, report);
  Json json = json_head();
  json["field"] = {{"path", request.input.path},
                   {"type", name_of(field.file.file_type)},
                   {"dims", field.grid.dims},
                   {"origin", uniform_json(field.grid, field.grid.origin)},
                   {"origin_from", name_of(field.origin_from)},
                   {"spacing", uniform_json(field.grid, field.grid.spacing)},
                   {"spacing_from", name_of(field.spacing_from)},
                   {"edges", edges_json(field.grid)},
                   {"cells", report.cells},
                   {"interfacial_cells", report.interfacial_cells},
                   {"clamped_cells", report.clamped_cells},
                   {"largest_overshoot", report.largest_overshoot},
                   {"fraction_volume", report.fraction_volume}};
  json["options"] = options_json(request);
  json["mesh"] = {{"path", request.output.path},
                  {"vertices", result.mesh.positions.size()},
                  {"triangles", result.mesh.triangles.size()},
                  {"closed", report.closed},
                  {"enclosed_volume", report.closed ? Json(report.enclosed_volume) : Json()},
                  {"volume_difference", difference ? Json(*difference) : Json()}};
  json["work"] = {{"planes", report.planes},
                  {"height_function_cells", report.height_function_cells},
                  {"gradient_free_cells", report.gradient_free_cells},
                  {"solved_edges", report.solved_edges},
                  {"newton_steps_mean", report.newton_steps_mean},
                  {"newton_steps_max", report.newton_steps_max},
                  {"non_monotone_edges", report.non_monotone_edges},
                  {"curved_cells", report.curved_cells},
                  {"curved_vertices", report.curved_vertices},
                  {"moved_centres", report.moved_centres}};
  json["seconds"] = {{"read", seconds.read},
                     {"classify", report.seconds.classify},
                     {"normals", report.seconds.normals},
                     {"count", report.seconds.count},
                     {"vertices", report.seconds.vertices},
                     {"triangles", report.seconds.triangles},
                     {"reconstruct", report.seconds.total}};
  return json;
}

/// Appends what there is to know of the field's file and of its values.
void add_warnings(const Request& request, const LoadedField& field,
                  std::vector<std::string>& warnings) {
  warnings.insert(warnings.end(), field.file.warnings.begin(), field.file.warnings.end());
  const std::string doubt = scale_warning(request.input, field.file);
  warnings.insert(warnings.end(), doubt.empty() ? 0 : 1, doubt);
}

void print_warnings(const Request& request, const Reconstruction& result) {
  const Report& report = result.report;
  if (report.clamped_cells > 0) {
    warn("'" + request.input.path + "': clamped " + count_of(report.clamped_cells, "cell") +
         " outside [0, 1], the farthest by " + rounded(report.largest_overshoot, 6));
  }
  if (result.mesh.triangles.empty()) {
    warn("'" + request.input.path + "': no fraction crosses 1/2, the mesh is empty");
  }
}

void print_summary(const Request& request, const LoadedField& field, const Reconstruction& result,
                   const Seconds& seconds) {
  const Report& report = result.report;
  const std::optional<double> difference = volume_difference(request, report);
  std::ostream& out = std::cout;
  print_fact(out, "mesh", request.output.path);
  print_fact(
      out, "cells",
      dims_text(field.grid.dims) + ", interfacial: " + std::to_string(report.interfacial_cells));
  print_axes(out, field);
  print_fact(out, "vertices", std::to_string(result.mesh.positions.size()));
  print_fact(out, "triangles", std::to_string(result.mesh.triangles.size()));
  print_fact(out, "closed", report.closed ? "yes" : "no, it ends at sides of the domain");
  print_fact(out, "fraction volume",
             rounded(report.fraction_volume, 10) + "  (sum of fraction x cell volume)");
  print_fact(out, "enclosed volume",
             report.closed ? rounded(report.enclosed_volume, 10) : "none, the mesh is not closed");
  if (difference) {
    print_fact(
        out, "difference",
        (*difference < 0.0 ? "" : "+") + rounded(*difference, 3) + " of the fraction volume");
  }
  print_fact(out, "seconds",
             rounded(seconds.read + seconds.reconstruct + seconds.write, 3) + "  (read " +
                 rounded(seconds.read, 3) + ", reconstruct " + rounded(seconds.reconstruct, 3) +
                 ", write " + rounded(seconds.write, 3) + ")");
}

/// Of the field or, where asked for, of the field made smooth, of whose values the first that is
/// out of bounds is to be named and not what smoothing made of it.
Reconstruction reconstruct_field(const Request& request, const LoadedField& field,
                                 const Options& options, LongCall& long_call) {
  const FieldView view = field.file.view();
  const std::optional<double> radius = mollify_radius(request);
  if (!radius) {
    return reconstruct(view, field.grid, options);
  }
  if (!field.grid.is_uniform()) {
    throw Error(ErrorCode::invalid_argument,
                "--mollify counts cells alike along each axis: not with --edges");
  }
  long_call.next("mollifying");
  Options checked = options;
  checked.progress = {};
  static_cast<void>(interfacial_cells(view, field.grid, checked));
  MollifyOptions mollify_options;
  mollify_options.radius = *radius;
  mollify_options.boundary = options.boundary;
  mollify_options.threads = options.threads;
  mollify_options.progress = long_call.progress();
  const Array<double> smooth = mollify(view, mollify_options);
  long_call.next("reconstructing");
  return reconstruct(FieldView::x_fastest(smooth.data(), field.grid.dims), field.grid, options);
}

void smooth(const Request& request, const LoadedField& field, LongCall& long_call,
            Reconstruction& result) {
  Mesh& mesh = result.mesh;
  long_call.next("smoothing");
  smooth_surface(*request.smoothing, {field.grid, request.options.threads, long_call.progress()},
                 mesh);
  if (result.report.closed) {
    result.report.enclosed_volume = measure(mesh).volume;
  }
  if (!request.options.edge_ids) {
    mesh.edge_ids.clear();
  }
}

/// Whether the cells' surfaces tell the curvature at vertices: these lie on them.
bool has_curvature_of_cells(const Request& request) {
  return request.output.curvature && request.options.placement == Placement::curved &&
         !request.smoothing && request.mollify.empty();
}

/// The library knows cells and lengths, not files.
Reconstruction reconstruct_file(const Request& request, const LoadedField& field,
                                LongCall& long_call) {
  Options options = request.options;
  options.vertex_normals = options.vertex_normals || request.output.shows_normals();
  options.edge_ids =
      options.edge_ids || request.smoothing.has_value() || has_curvature_of_cells(request);
  options.progress = long_call.progress();
  try {
    Reconstruction result = reconstruct_field(request, field, options, long_call);
    if (request.smoothing) {
      smooth(request, field, long_call, result);
    }
    return result;
  } catch (const Error& error) {
    throw Error(error.code(), "'" + request.input.path + "': " + error.what());
  }
}

Curvature curvature_of(const Request& request, const LoadedField& field, Mesh& mesh) {
  if (!has_curvature_of_cells(request)) {
    CurvatureOptions options;
    options.threads = request.options.threads;
    return curvature(mesh, options);
  }
  Curvature result = vertex_curvature(field.file.view(), field.grid, mesh, request.options);
  if (!request.options.edge_ids) {
    mesh.edge_ids.clear();
  }
  return result;
}

/// Gives the mesh what is to be written with its vertices.
void add_scalars(const Request& request, const LoadedField& field, Mesh& mesh) {
  if (!request.output.curvature) {
    return;
  }
  Curvature curvature = curvature_of(request, field, mesh);
  if (curvature.undefined_vertices > 0 && !request.quiet) {
    warn("'" + request.input.path + "': no curvature on parts that are too small, 0 is written: " +
         std::to_string(curvature.undefined_vertices) + " of " +
         std::to_string(mesh.positions.size()) + " vertices");
  }
  mesh.scalars = curvature_scalars(std::move(curvature));
}

void check_outputs(const Request& request) {
  (void)mollify_radius(request);
  std::vector<std::string> scalars;
  if (request.reference.is_given()) {
    scalars.emplace_back(kErrorName);
  }
  check_reference(request.reference);
  check_surface_output(request.output, scalars);
  check_output("--output", request.output.path, request.input.path);
  check_output("--output", request.output.path, request.reference.path);
  if (!request.report_path.empty()) {
    check_output("--report", request.report_path, request.input.path);
    check_output("--report", request.report_path, request.reference.path);
    check_output("--report", request.report_path, request.output.path);
  }
}

Json file_json(const MeshFileReport& written) {
  return {{"bytes", written.bytes},
          {"vertices", written.vertices},
          {"triangles", written.triangles},
          {"position_bits", written.position_bits},
          {"position_error", written.position_error},
          {"collapsed_triangles", written.collapsed_triangles}};
}

/// Mesh and report. \param warnings get what the format does to the mesh
MeshFileReport write_outputs(const Request& request, Mesh& mesh, double cell_size, Json& json,
                             std::vector<std::string>& warnings) {
  // Where not even a report without the facts of the mesh's file can be written, there is no mesh.
  std::optional<OutputFile> draft;
  if (!request.report_path.empty()) {
    json["file"] = file_json({});
    json["warnings"] = warnings;
    draft.emplace(request.report_path, to_text(json));
  }
  const MeshFileReport written = write_surface(request.output, mesh, cell_size);
  if (const std::optional<std::string> warning =
          rounding_warning(request.output, written, cell_size)) {
    warnings.push_back(*warning);
  }
  if (draft) {
    json["file"] = file_json(written);
    json["warnings"] = warnings;
    OutputFile(request.report_path, to_text(json)).commit();
  }
  return written;
}

void run(const Request& request) {
  check_outputs(request);
  Stopwatch watch;
  Seconds seconds;
  const LoadedField field = load_field(request.input);
  seconds.read = watch.lap();

  LongCall long_call("reconstructing", request.quiet);
  Reconstruction result = reconstruct_file(request, field, long_call);
  long_call.done();
  std::vector<std::string> warnings;  // of the files
  add_scalars(request, field, result.mesh);
  if (request.reference.is_given() && !result.mesh.triangles.empty()) {
    result.mesh.scalars.push_back(
        errors_of(result.mesh, request.reference, request.quiet, warnings));
  }
  seconds.reconstruct = watch.lap();
  add_warnings(request, field, warnings);

  Json json = report_json(request, field, result, seconds);
  const double cell = least_edge(field.grid);
  const MeshFileReport written = write_outputs(request, result.mesh, cell, json, warnings);
  seconds.write = watch.lap();

  if (!request.quiet) {
    warn_all(warnings);
    print_warnings(request, result);
  }
  if (request.with_summary()) {
    print_summary(request, field, result, seconds);
    print_fact(std::cout, "file", file_text(written));
  }
}

void add_method_options(CLI::App& command, Request& request) {
  Options& options = request.options;
  command
      .add_option_function<std::string>(
          "--placement",
          [&options](const std::string& text) {
            options.placement = parse_name("--placement", text, kPlacements);
          },
          "Where vertices are put on the edges between cell centres:\n"
          "  plic      from planes in both cells, second-order accurate (default)\n"
          "  curved    from curved surfaces in both cells, else plic: of fourth order, and slow\n"
          "  manson    from the two fractions, in four cases\n"
          "  linear    where interpolation gives 1/2: plain marching cubes\n"
          "  midpoint  in the middle")
      ->option_text("NAME");
  command
      .add_option_function<std::string>(
          "--normals",
          [&options](const std::string& text) {
            options.normals = parse_name("--normals", text, kNormals);
          },
          "How normals of cells are estimated, for plic and --vertex-normals:\n"
          "  height_function  heights over 3 x 3 columns, else myc (default)\n"
          "  myc              mixed Youngs-centred, 3 x 3 x 3 cells\n"
          "  youngs           weighted gradient, 3 x 3 x 3 cells\n"
          "  elvira           of 27 planes the one that suits the neighbours best\n"
          "  lvira            the plane that suits the neighbours best")
      ->option_text("NAME");
  command
      .add_option_function<std::string>(
          "--boundary",
          [&options](const std::string& text) {
            options.boundary = parse_boundary("--boundary", text);
          },
          "What lies beyond the sides of the domain; one name for all sides, or\n"
          "six: xlo,xhi,ylo,yhi,zlo,zhi\n"
          "  open      unknown: the surface ends at the side (default)\n"
          "  mirror    its mirror image: the surface meets the side at right angles\n"
          "  periodic  the opposite side again; both sides of an axis together. The\n"
          "            surface spans one period, from the first cell centre on\n"
          "  empty     nothing: the surface is closed there\n"
          "  full      material: the surface of the empty part is closed there,\n"
          "            but for edges of the domain where it meets an empty side")
      ->option_text("SIDES");
}

void add_smoothing_options(CLI::App& command, Request& request) {
  command
      .add_flag("--mollify", request.mollify,
                "Smooth the field first, with a kernel that ends at two cells, or at\n"
                "RADIUS cells, 1 to 8")
      ->option_text("[=RADIUS]");
  command
      .add_option_function<std::string>(
          "--smooth",
          [&request](const std::string& text) {
            request.smoothing = parse_smoothing("--smooth", text);
          },
          "Smooth the surface; vertices move, triangles stay:\n"
          "  laplacian[:STEPS]   to the neighbours' mean, 1 step; shrinks\n"
          "  taubin[:STEPS]      to it and back by more, 15 steps; hardly shrinks\n"
          "  flow[:TIME]         by mean curvature for a time of 1 spacing squared\n"
          "  constrained[:TOL]   so that no cell's fraction changes by more than\n"
          "                      0.01; closed surfaces only")
      ->option_text("NAME[:NUMBER]");
}

void add_limit_options(CLI::App& command, Request& request) {
  Options& options = request.options;
  command
      .add_option_function<std::string>(
          "--purity-tolerance",
          [&options](const std::string& text) {
            options.purity_tolerance =
                parse_number("--purity-tolerance", text, kPurityToleranceRange);
          },
          "A fraction so close to 0 or 1 counts as empty or full, 0 to 0.1.\n"
          "Default: 1e-6")
      ->option_text("T");
  command
      .add_option_function<std::string>(
          "--overshoot-bound",
          [&options](const std::string& text) {
            options.overshoot_bound = parse_number("--overshoot-bound", text, kOvershootBoundRange);
          },
          "Fractions so far outside [0, 1] are clamped, farther ones are an\n"
          "error, 0 to 1. Default: 0.1")
      ->option_text("B");
  command
      .add_option_function<std::string>(
          "--clearance",
          [&options](const std::string& text) {
            options.clearance = parse_number("--clearance", text, kClearanceRange);
          },
          "Of vertices from the ends of their edges, over the edge, 1e-13 to\n"
          "0.25. Default: 1e-12")
      ->option_text("C");
  add_threads_option(command, "The mesh does", options.threads);
}

}  // namespace

void add_reconstruct_command(CLI::App& program) {
  const auto request = std::make_shared<Request>();
  CLI::App& command = *program.add_subcommand("reconstruct", kDescription);
  command.footer(kFooter);
  command.add_option("FIELD", request->input.path, "Field of fractions (.npy, .nrrd, .nhdr, raw)")
      ->required();
  command
      .add_option("-o,--output", request->output.path,
                  "Mesh to write (" + mesh_extensions_text() + ")")
      ->required()
      ->option_text("MESH");
  add_method_options(command, *request);
  add_smoothing_options(command, *request);
  add_limit_options(command, *request);
  command.add_flag(
      "--vertex-normals", request->options.vertex_normals,
      "Write a normal with each vertex (not in .stl; .glb and .gltf always have them)");
  command.add_flag("--edge-ids", request->options.edge_ids,
                   "Write the id of its dual edge with each vertex (" +
                       mesh_extensions_text([](const MeshFormat& f) { return f.edge_ids; }) + ")");
  add_surface_options(command, request->output);
  command
      .add_option("--report", request->report_path,
                  "Write facts about field, mesh and work as JSON to FILE;\n"
                  "- is standard output, in place of the summary")
      ->option_text("FILE");
  command.add_flag("--quiet", request->quiet, "Print nothing but errors");
  add_field_options(command, request->input);
  add_reference_options(command, request->reference);
  command.callback([request] {
    request->reference.allow_outside = request->input.allow_outside;
    run(*request);
  });
}

}  // namespace difmesh::cli
