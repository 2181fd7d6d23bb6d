// difmesh sample: a shape or a closed mesh in, its field of fractions out.

#include <array>
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.hpp"
#include "difmesh/error.hpp"
#include "difmesh/fractions_from_function.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/shapes.hpp"
#include "long_call.hpp"
#include "names.hpp"
#include "output_file.hpp"
#include "parse.hpp"
#include "sample_grid.hpp"
#include "shape_options.hpp"
#include "stopwatch.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

constexpr const char* kDescription =
    "Makes the field of fractions of a shape or a closed mesh.\n"
    "\n"
    "The body is sphere, ellipsoid, torus, genus, smooth_box or golf_ball, by quadrature to 1e-10 "
    "per\n"
    "cell; or a mesh file, exactly, its parts united where they overlap. Its grid is its\n"
    "bounding box and three cells more on every side. FIELD is .nrrd, which holds origin and "
    "spacing,\n"
    "or .npy, which does not: they are printed.\n";

constexpr const char* kFooter =
    "Examples:\n"
    "  difmesh sample sphere -o sphere.nrrd --cells 64\n"
    "  difmesh sample torus -o torus.npy --spacing 0.05 --tube-radius 0.3 --rotation 30,0,45\n"
    "  difmesh sample part.stl -o part.nrrd --cells 128,64,64 --type float32\n"
    "  difmesh sample part.stl -o low.nrrd --spacing 0.1 --origin 0,0,0\n";

/// Extensions that fields can be written with.
constexpr std::array<std::string_view, 2> kWritten{".npy", ".nrrd"};

constexpr std::array<Named<ScalarType>, 2> kTypes{
    {{"float32", ScalarType::float32}, {"float64", ScalarType::float64}}};

struct Request {
  std::string body;  ///< name of a shape, or path of a mesh
  std::string field_path;
  GridWish grid;
  ShapeInput shape;
  bool flip = false;
  bool allow_outside = false;
  std::optional<double> cracks;  ///< as a share of a column's cross-section
  std::optional<double> tolerance;
  std::optional<double> kink_tolerance;
  std::optional<std::int64_t> max_calls_per_cell;
  std::optional<Overlaps> overlaps;
  ScalarType type = ScalarType::float64;
  int threads = 0;
  bool quiet = false;

  [[nodiscard]] bool is_mesh() const { return is_mesh_file(body); }
};

struct Sample {
  Grid grid;
  Array<double> fractions;
  double fraction_volume = 0.0;
  std::int64_t interfacial_cells = 0;
  std::optional<double> body_volume;
  CoverReport overlap;
  CoverReport inverted;
  CoverReport undecided;
  std::int64_t unresolved_cells = 0;
  double largest_error_estimate = 0.0;
  std::vector<std::string> warnings;  ///< of the mesh's file
};

Sample sample_shape(const Request& request, LongCall& long_call) {
  const Shape shape = request.shape.make(
      parse_shape("SHAPE|MESHFILE", request.body, ", nor a mesh: " + mesh_extensions_text()));
  Sample sample;
  sample.grid = grid_around(shape.bounds(), request.grid);
  FractionsFromFunctionOptions options;
  options.tolerance = request.tolerance.value_or(options.tolerance);
  options.kink_tolerance = request.kink_tolerance.value_or(options.kink_tolerance);
  options.max_calls_per_cell = request.max_calls_per_cell.value_or(options.max_calls_per_cell);
  options.threads = request.threads;
  options.progress = long_call.progress();
  FractionsFromFunction result = fractions_from_shape(sample.grid, shape, options);
  sample.fractions = std::move(result.fractions);
  sample.fraction_volume = result.report.fraction_volume;
  sample.interfacial_cells = result.report.interfacial_cells;
  sample.body_volume = shape.volume();
  sample.unresolved_cells = result.report.unresolved_cells;
  sample.largest_error_estimate = result.report.largest_error_estimate;
  return sample;
}

/// A mesh that is open or inside out is a fault of the file, not of the command line.
[[noreturn]] void fail_mesh(const std::string& path, const Error& error) {
  const ErrorCode code =
      error.code() == ErrorCode::invalid_argument ? ErrorCode::file_format : error.code();
  throw Error(code, "'" + path + "': " + error.what());
}

Bounds bounds_of(const std::string& path, const Mesh& mesh) {
  if (mesh.triangles.empty()) {
    throw Error(ErrorCode::file_format, "'" + path + "': the mesh has no triangles");
  }
  const Measure facts = measure(mesh);
  return {facts.low, facts.high};
}

std::int64_t interfacial_cells(const Array<double>& fractions) {
  std::int64_t cells = 0;
  for (const double fraction : fractions) {
    cells += static_cast<std::int64_t>(fraction > 0.0 && fraction < 1.0);
  }
  return cells;
}

Sample sample_mesh(const Request& request, LongCall& long_call) {
  Sample sample;
  MeshFile read = read_mesh_file(request.body, {.outside_files = request.allow_outside});
  const Mesh& mesh = read.mesh;
  sample.warnings = std::move(read.warnings);
  sample.grid = grid_around(bounds_of(request.body, mesh), request.grid);
  FractionsFromMeshOptions options;
  options.flip = request.flip;
  options.overlaps = request.overlaps.value_or(Overlaps::unite);
  if (request.cracks) {
    options.check_edges = false;
    options.tolerance = *request.cracks;
  }
  options.threads = request.threads;
  options.progress = long_call.progress();
  try {
    FractionsFromMesh result =
        fractions_from_mesh(sample.grid, mesh.positions, mesh.triangles, options);
    sample.fractions = std::move(result.fractions);
    sample.fraction_volume = result.report.fraction_volume;
    sample.body_volume = result.report.mesh_volume;
    sample.overlap = result.report.overlap;
    sample.inverted = result.report.inverted;
    sample.undecided = result.report.undecided;
  } catch (const Error& error) {
    fail_mesh(request.body, error);
  }
  sample.interfacial_cells = interfacial_cells(sample.fractions);
  return sample;
}

/// "0.1 of volume in 7 cells, from (0, 0, 0) to (1, 1, 1), most in cell (1, 2, 3)"
std::string extent_text(const CoverReport& cover) {
  const auto corner = [](const Vec3& p) {
    return "(" + rounded(p[0], 6) + ", " + rounded(p[1], 6) + ", " + rounded(p[2], 6) + ")";
  };
  return rounded(cover.volume, 6) + " of volume in " + count_of(cover.cells, "cell") + ", from " +
         corner(cover.low) + " to " + corner(cover.high) + ", most in cell (" +
         std::to_string(cover.cell[0]) + ", " + std::to_string(cover.cell[1]) + ", " +
         std::to_string(cover.cell[2]) + ")";
}

void print_warnings(const Request& request, const Sample& sample) {
  warn_all(sample.warnings);
  if (sample.overlap.cells > 0) {
    const bool count = request.overlaps == Overlaps::count;
    warn("'" + request.body + "': parts overlap by " + extent_text(sample.overlap) +
         (count ? "; it counts as often as it is covered" : "; it counts once"));
  }
  if (sample.inverted.cells > 0) {
    const bool count = request.overlaps == Overlaps::count;
    warn("'" + request.body + "': pockets are inside out, " + extent_text(sample.inverted) +
         (count ? "; they count negatively" : "; they are outside"));
  }
  if (sample.undecided.largest > FractionsFromMeshOptions{}.tolerance) {
    warn("'" + request.body + "': how often space is covered is undecided, " +
         extent_text(sample.undecided) + "; the fractions may be off by as much");
  }
  if (sample.unresolved_cells > 0) {
    warn("'" + request.body + "': " + count_of(sample.unresolved_cells, "cell") +
         " may miss the tolerance; the largest estimate of an error is " +
         rounded(sample.largest_error_estimate, 3));
  }
  if (sample.interfacial_cells == 0) {
    warn("'" + request.body + "': no cell is partly filled");
  }
}

/// As options for the commands that read the field.
std::string with_commas(const Vec3& vector) {
  return exact(vector[0]) + "," + exact(vector[1]) + "," + exact(vector[2]);
}

void print_summary(const Request& request, const Sample& sample, double seconds) {
  const Grid& grid = sample.grid;
  std::ostream& out = std::cout;
  print_fact(out, "field", request.field_path);
  print_fact(out, "type", name_of(kTypes, request.type));
  print_fact(out, "cells",
             dims_text(grid.dims) + ", interfacial: " + std::to_string(sample.interfacial_cells));
  print_fact(out, "origin", exact(grid.origin));
  print_fact(out, "spacing", exact(grid.spacing));
  if (!has_extension(request.field_path, {{".nrrd"}})) {
    print_fact(out, "read it with",
               "--origin " + with_commas(grid.origin) + " --spacing " + with_commas(grid.spacing));
  }
  print_fact(out, "fraction volume",
             exact(sample.fraction_volume) + "  (sum of fraction x cell volume)");
  if (sample.body_volume) {
    print_fact(out, request.is_mesh() ? "mesh volume" : "exact volume",
               exact(*sample.body_volume) +
                   (request.grid.origin ? "  (of the whole, within the grid or not)" : ""));
  }
  print_fact(out, "seconds", rounded(seconds, 3));
}

void check_request(const Request& request) {
  if (request.is_mesh() && !request.shape.given.empty()) {
    throw CLI::ValidationError(request.shape.given.front(),
                               "'" + request.body + "' is a mesh, it has no such parameter");
  }
  const std::pair<bool, const char*> of_shapes[] = {
      {request.tolerance.has_value(), "--tolerance"},
      {request.kink_tolerance.has_value(), "--kink-tolerance"},
      {request.max_calls_per_cell.has_value(), "--max-calls-per-cell"}};
  for (const auto& [given, option] : of_shapes) {
    if (request.is_mesh() && given) {
      throw CLI::ValidationError(option, "meshes have exact fractions; it is for shapes");
    }
  }
  if (!request.is_mesh() && request.flip) {
    throw CLI::ValidationError("--flip", "only meshes can be inside out");
  }
  if (!request.is_mesh() && request.overlaps) {
    throw CLI::ValidationError("--overlaps", "only meshes can have parts that overlap");
  }
  if (!request.is_mesh() && request.cracks) {
    throw CLI::ValidationError("--cracks", "only meshes can have cracks");
  }
  const bool with_cells = request.grid.cells || request.grid.cells_by_axis;
  if (with_cells == request.grid.spacing.has_value()) {
    throw CLI::ValidationError(
        "--cells", with_cells ? "cannot be used together with --spacing" : "needed, or --spacing");
  }
  if (!has_extension(request.field_path, kWritten)) {
    throw CLI::ValidationError(
        "--output", "'" + request.field_path +
                        "' has an unknown extension; fields are written as " + joined(kWritten));
  }
  check_output("--output", request.field_path, request.is_mesh() ? request.body : "");
}

void run(const Request& request) {
  check_request(request);
  Stopwatch watch;
  LongCall long_call("sampling", request.quiet);
  const Sample sample =
      request.is_mesh() ? sample_mesh(request, long_call) : sample_shape(request, long_call);
  long_call.done();
  WriteFieldOptions write;
  write.type = request.type;
  write_field(request.field_path, FieldView::x_fastest(sample.fractions.data(), sample.grid.dims),
              sample.grid, write);
  if (!request.quiet) {
    print_warnings(request, sample);
    print_summary(request, sample, watch.lap());
  }
}

void read_cells(GridWish& grid, const std::string& text) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (split_at_commas(text).size() == 1) {
    grid.cells = parse_integer("--cells", text, 1, kMost);
  } else {
    grid.cells_by_axis = parse_dims("--cells", text);
  }
}

void add_grid_options(CLI::App& command, GridWish& grid) {
  command
      .add_option_function<std::string>(
          "--cells", [&grid](const std::string& text) { read_cells(grid, text); },
          "Number of cells, the margin included: N along the longest side, all\n"
          "cells being cubes, or three numbers")
      ->option_text("N|NX,NY,NZ")
      ->group("Grid");
  command
      .add_option_function<std::string>(
          "--spacing",
          [&grid](const std::string& text) { grid.spacing = parse_spacing("--spacing", text); },
          "Sizes of a cell in place of --cells; one value stands for all three")
      ->option_text("DX,DY,DZ")
      ->group("Grid");
  command
      .add_option_function<std::string>(
          "--origin",
          [&grid](const std::string& text) { grid.origin = parse_vector("--origin", text); },
          "Low corner of the first cell; what lies before it is cut off.\n"
          "Default: three cells before the body, which is in the middle")
      ->option_text("X,Y,Z")
      ->group("Grid");
}

void add_accuracy_options(CLI::App& command, Request& request) {
  const auto add_tolerance = [&command](const char* option, std::optional<double>& tolerance,
                                        const char* help) {
    command
        .add_option_function<std::string>(
            option,
            [option, &tolerance](const std::string& text) {
              tolerance = parse_number(option, text, {1e-13, 1e-2});
            },
            help)
        ->option_text("ERROR")
        ->group("Accuracy of shapes");
  };
  add_tolerance("--tolerance", request.tolerance,
                "Error aimed at in the fraction of each cell, 1e-13 to 0.01 (1e-10)");
  add_tolerance("--kink-tolerance", request.kink_tolerance,
                "The same where the shape has an edge, if that is larger (1e-5)");
  command
      .add_option_function<std::string>(
          "--max-calls-per-cell",
          [&request](const std::string& text) {
            request.max_calls_per_cell =
                parse_integer("--max-calls-per-cell", text, 1000, 1'000'000'000);
          },
          "Evaluations after which a cell is estimated and counts as unresolved (200000)")
      ->option_text("N")
      ->group("Accuracy of shapes");
}

}  // namespace

void add_sample_command(CLI::App& program) {
  const auto request = std::make_shared<Request>();
  CLI::App& command = *program.add_subcommand("sample", kDescription);
  command.footer(kFooter);
  command
      .add_option("SHAPE|MESHFILE", request->body,
                  "Name of a shape, or closed mesh (" + mesh_extensions_text() + ")")
      ->required();
  command.add_option("-o,--output", request->field_path, "Field to write (.nrrd, .npy)")
      ->required()
      ->option_text("FIELD");
  command.add_flag("--allow-outside", request->allow_outside, kAllowOutsideHelp);
  command.add_flag("--flip", request->flip,
                   "Meshes: triangles are clockwise seen from outside, turn them");
  command
      .add_option_function<std::string>(
          "--cracks",
          [request](const std::string& text) {
            request->cracks = parse_number("--cracks", text, {1e-12, 0.25});
          },
          "Meshes: let edges pass that do not match, as at T-junctions and small cracks, if no\n"
          "column of cells gapes by more than this share of its cross-section, 1e-12 to 0.25")
      ->option_text("SHARE");
  command
      .add_option_function<std::string>(
          "--overlaps",
          [request](const std::string& text) {
            request->overlaps = parse_name("--overlaps", text, kOverlaps);
          },
          "Meshes: where parts overlap, union (default) counts space once, refuse fails, and\n"
          "count counts it as often as it is covered, so that fractions may exceed 1")
      ->option_text("HOW");
  command
      .add_option_function<std::string>(
          "--type",
          [request](const std::string& text) {
            request->type = parse_name("--type", text, kTypes);
          },
          "Elements of FIELD: float32 or float64 (default)")
      ->option_text("TYPE");
  add_threads_option(command, "The field does", request->threads);
  command.add_flag("--quiet", request->quiet, "Print nothing but errors");
  add_grid_options(command, request->grid);
  add_shape_options(command, request->shape);
  add_accuracy_options(command, *request);
  command.callback([request] { run(*request); });
}

}  // namespace difmesh::cli
