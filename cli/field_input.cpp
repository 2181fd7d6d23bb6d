#include "field_input.hpp"

#include <algorithm>
#include <limits>

#include "names.hpp"
#include "parse.hpp"
#include "text.hpp"

namespace difmesh::cli {
namespace {

void add_geometry_options(CLI::App& command, FieldInput& input) {
  command
      .add_option_function<std::string>(
          "--origin",
          [&input](const std::string& text) { input.origin = parse_vector("--origin", text); },
          "Low corner of the first cell; one value stands for all three.\n"
          "Default: what the file tells, else 0 (.npy and raw tell nothing)")
      ->option_text("X,Y,Z")
      ->group("Grid");
  command
      .add_option_function<std::string>(
          "--spacing",
          [&input](const std::string& text) { input.spacing = parse_spacing("--spacing", text); },
          "Sizes of a cell; one value stands for all three.\n"
          "Default: what the file tells, else 1")
      ->option_text("DX,DY,DZ")
      ->group("Grid");
  command
      .add_option_function<std::string>(
          "--edges",
          [&input](const std::string& text) {
            const std::vector<std::string_view> words = split_at_commas(text);
            if (words.size() != 3) {
              throw CLI::ValidationError("--edges", "'" + text + "'" +
                                                        ": three files wanted, for x, "
                                                        "y and z; nothing stands for an axis "
                                                        "that is uniform");
            }
            std::copy(words.begin(), words.end(), input.edges.begin());
          },
          "Stretched axes: .npy files with the faces between cells, one more than cells, in\n"
          "place of --origin and --spacing along the axis; an axis without file is uniform")
      ->option_text("X.npy,Y.npy,Z.npy")
      ->group("Grid");
}

void add_value_options(CLI::App& command, FieldInput& input) {
  CLI::Option* const full =
      command
          .add_option_function<std::string>(
              "--full-value",
              [&input](const std::string& text) {
                input.full_value = parse_number("--full-value", text);
              },
              "The value that stands for 1; values beyond count as 1.\n"
              "Default: the largest value of the type for integers, 1 for floats")
          ->option_text("V");
  CLI::Option* const empty = command
                                 .add_option_function<std::string>(
                                     "--empty-value",
                                     [&input](const std::string& text) {
                                       input.empty_value = parse_number("--empty-value", text);
                                     },
                                     "The value that stands for 0, with --full-value. Default: 0")
                                 ->option_text("V");
  CLI::Option* const label =
      command
          .add_option_function<std::string>(
              "--label",
              [&input](const std::string& text) {
                for (const std::string_view word : split_at_commas(text)) {
                  input.labels.push_back(parse_integer("--label", word,
                                                       std::numeric_limits<std::int64_t>::min(),
                                                       std::numeric_limits<std::int64_t>::max()));
                }
              },
              "Segmentations: cells with one of these values are full, all others\n"
              "empty")
          ->option_text("N[,M...]");
  empty->needs(full);
  label->excludes(full);
  for (CLI::Option* const option : {full, empty, label}) {
    option->group("Values");
  }
}

void add_raw_options(CLI::App& command, FieldInput& input) {
  CLI::Option* const dims =
      command
          .add_option_function<std::string>(
              "--raw-dims",
              [&input](const std::string& text) {
                input.raw_dims = parse_dims("--raw-dims", text);
              },
              "Read FIELD as a raw file of so many cells, x fastest, then y, then z")
          ->option_text("NX,NY,NZ");
  CLI::Option* const type = command
                                .add_option_function<std::string>(
                                    "--raw-type",
                                    [&input](const std::string& text) {
                                      input.raw_type = parse_name("--raw-type", text, kValueTypes);
                                    },
                                    "Its elements: float32, float64, int8 to int64 or uint8 to\n"
                                    "uint64")
                                ->option_text("TYPE");
  CLI::Option* const order = command.add_flag("--raw-big-endian", input.raw_big_endian,
                                              "Its bytes are in big-endian order");
  CLI::Option* const offset = command
                                  .add_option_function<std::string>(
                                      "--raw-offset",
                                      [&input](const std::string& text) {
                                        input.raw_offset =
                                            parse_integer("--raw-offset", text, 0,
                                                          std::numeric_limits<std::int64_t>::max());
                                      },
                                      "Bytes before its first element")
                                  ->option_text("BYTES");
  dims->needs(type);
  type->needs(dims);
  for (CLI::Option* const option : {dims, type, order, offset}) {
    option->group("Raw files");
    if (option != dims) {
      option->needs(dims);
    }
  }
}

template <class Value>
Source source_of(const std::optional<Value>& asked, const std::optional<Value>& told) {
  return asked ? Source::command_line : told ? Source::file : Source::assumed;
}

}  // namespace

void add_field_options(CLI::App& command, FieldInput& input) {
  add_geometry_options(command, input);
  add_value_options(command, input);
  add_raw_options(command, input);
  command.add_flag("--allow-outside", input.allow_outside, kAllowOutsideHelp)->group("Files");
}

double least_edge(const Grid& grid) {
  return std::min({grid.least_width(0), grid.least_width(1), grid.least_width(2)});
}

void FieldInput::check() const {
  if (is_stretched(0) && is_stretched(1) && is_stretched(2) && (origin || spacing)) {
    throw CLI::ValidationError(
        origin ? "--origin" : "--spacing",
        "--edges tells it already: all three axes have their files of faces");
  }
}

LoadedField load_field(const FieldInput& input) {
  input.check();
  ReadFieldOptions options{.origin = input.origin,
                           .spacing = input.spacing,
                           .labels = input.labels,
                           .outside_files = input.allow_outside};
  if (input.full_value) {
    options.values = {input.empty_value.value_or(0.0), *input.full_value};
  }
  LoadedField field;
  if (input.is_raw()) {
    const RawLayout layout{*input.raw_dims, *input.raw_type, input.raw_big_endian,
                           input.raw_offset};
    field.file = read_field(input.path, layout, options);
  } else {
    field.file = read_field(input.path, options);
  }
  field.grid = field.file.grid();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (input.is_stretched(axis)) {
      field.grid.faces[axis] = read_faces(input.edges[axis]);
    }
  }
  if (!field.grid.is_uniform()) {
    validate(field.grid);
  }
  field.origin_from = source_of(input.origin, field.file.origin);
  field.spacing_from = source_of(input.spacing, field.file.spacing);
  return field;
}

std::string scale_warning(const FieldInput& input, const FieldFile& file) {
  const bool as_it_is = !input.full_value && input.labels.empty();
  if (!as_it_is || !is_integer(file.file_type) || file.file_type != value_type_of(file.type)) {
    return "";
  }
  const std::string doubt = doubt_of_scale(ValueView(file.view()), "--full-value or --label");
  return doubt.empty() ? "" : "'" + input.path + "': " + doubt;
}

const char* name_of(Source source) {
  switch (source) {
    case Source::command_line:
      return "command line";
    case Source::file:
      return "file";
    case Source::assumed:
      break;
  }
  return "assumed";
}

Json edges_json(const Grid& grid) {
  Json edges = Json::array();
  for (const std::vector<double>& faces : grid.faces) {
    edges.push_back(faces.empty() ? Json() : Json(faces));
  }
  return edges;
}

Json uniform_json(const Grid& grid, const Vec3& vector) {
  Json numbers = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    numbers.push_back(grid.is_uniform(axis) ? Json(vector[axis]) : Json());
  }
  return numbers;
}

void print_axes(std::ostream& out, const LoadedField& field) {
  const Grid& grid = field.grid;
  const auto print_uniform = [&](const char* name, const Vec3& vector, Source source) {
    std::string text;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      text += (axis == 0 ? "" : " ") + (grid.is_uniform(axis) ? exact(vector[axis]) : "-");
    }
    print_fact(out, name,
               text + (source == Source::assumed ? "  (assumed, the file tells none)" : ""));
  };
  if (grid.is_uniform(0) || grid.is_uniform(1) || grid.is_uniform(2)) {
    print_uniform("origin", grid.origin, field.origin_from);
    print_uniform("spacing", grid.spacing, field.spacing_from);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!grid.is_uniform(axis)) {
      print_fact(out, (std::string("faces in ") + "xyz"[axis]).c_str(),
                 exact(grid.faces[axis].front()) + " to " + exact(grid.faces[axis].back()) +
                     ", the least width " + exact(grid.least_width(axis)));
    }
  }
}

}  // namespace difmesh::cli
