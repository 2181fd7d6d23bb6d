#include "field_input.hpp"

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
                                      input.raw_type = parse_name("--raw-type", text, kScalarTypes);
                                    },
                                    "Its elements: float32, float64, uint8 or uint16.\n"
                                    "Integers are fractions of the largest value of the type")
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
  add_raw_options(command, input);
}

LoadedField load_field(const FieldInput& input) {
  LoadedField field;
  if (input.is_raw()) {
    field.file = read_field(
        input.path, {*input.raw_dims, *input.raw_type, input.raw_big_endian, input.raw_offset});
  } else {
    field.file = read_field(input.path);
  }
  field.grid = field.file.grid();
  field.grid.origin = input.origin.value_or(field.grid.origin);
  field.grid.spacing = input.spacing.value_or(field.grid.spacing);
  field.origin_from = source_of(input.origin, field.file.origin);
  field.spacing_from = source_of(input.spacing, field.file.spacing);
  return field;
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

std::string with_source(const Vec3& vector, Source source) {
  return exact(vector) + (source == Source::assumed ? "  (assumed, the file tells none)" : "");
}

}  // namespace difmesh::cli
