#include "shape_options.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "difmesh/error.hpp"
#include "names.hpp"
#include "parse.hpp"

namespace difmesh::cli {
namespace {

using Kinds = unsigned;  ///< a bit per kind

constexpr Kinds bit(ShapeKind kind) {
  return 1U << static_cast<unsigned>(kind);
}

constexpr Kinds kAll = ~0U;
constexpr Kinds kWithSemiAxes = bit(ShapeKind::ellipsoid) | bit(ShapeKind::smooth_box);
constexpr Kinds kWithRadius =
    bit(ShapeKind::sphere) | bit(ShapeKind::torus) | bit(ShapeKind::golf_ball);

/// One option of the command line: which shapes have it, how it is read and reported.
struct Parameter {
  std::string_view name;  ///< in reports; with dashes, the option
  Kinds kinds;
  const char* option_text;
  const char* help;
  void (*read)(ShapeOptions& to, const std::string& option, const std::string& text);
  Json (*json)(const ShapeOptions& from);
};

template <Vec3 ShapeOptions::*member>
constexpr Parameter vector_parameter(std::string_view name, Kinds kinds, const char* option_text,
                                     const char* help) {
  return {name,
          kinds,
          option_text,
          help,
          [](ShapeOptions& to, const std::string& option, const std::string& text) {
            to.*member = parse_vector(option, text);
          },
          [](const ShapeOptions& from) { return Json(from.*member); }};
}

template <double ShapeOptions::*member>
constexpr Parameter number_parameter(std::string_view name, Kinds kinds, const char* option_text,
                                     const char* help) {
  return {name,
          kinds,
          option_text,
          help,
          [](ShapeOptions& to, const std::string& option, const std::string& text) {
            to.*member = parse_number(option, text);
          },
          [](const ShapeOptions& from) { return Json(from.*member); }};
}

constexpr Parameter dimples_parameter() {
  return {"dimples",
          bit(ShapeKind::golf_ball),
          "N",
          "golf_ball: how many, 1 to 5000. Default: 333",
          [](ShapeOptions& to, const std::string& option, const std::string& text) {
            to.dimples = parse_integer(option, text, 1, std::numeric_limits<std::int32_t>::max());
          },
          [](const ShapeOptions& from) { return Json(from.dimples); }};
}

constexpr std::array<Parameter, 10> kParameters{
    {vector_parameter<&ShapeOptions::centre>("centre", kAll, "X,Y,Z", "Its centre. Default: 0,0,0"),
     vector_parameter<&ShapeOptions::rotation_degrees>(
         "rotation", kAll, "RX,RY,RZ",
         "Degrees by which it is turned about its centre: about the x axis,\n"
         "then y, then z, all fixed. Default: 0,0,0"),
     number_parameter<&ShapeOptions::radius>(
         "radius", kWithRadius, "R", "sphere, golf_ball, and centre line of the torus. Default: 1"),
     number_parameter<&ShapeOptions::tube_radius>("tube_radius", bit(ShapeKind::torus), "R",
                                                  "torus: of its tube. Default: 0.4"),
     vector_parameter<&ShapeOptions::semi_axes>("semi_axes", kWithSemiAxes, "A,B,C",
                                                "ellipsoid, smooth_box. Default: 1,0.8,0.6"),
     number_parameter<&ShapeOptions::exponent>(
         "exponent", bit(ShapeKind::smooth_box), "P",
         "smooth_box: |x/a|^P + |y/b|^P + |z/c|^P = 1, 2 to 64. Default: 8"),
     number_parameter<&ShapeOptions::scale>("scale", bit(ShapeKind::genus), "S",
                                            "genus: its size. Default: 1"),
     dimples_parameter(),
     number_parameter<&ShapeOptions::dimple_radius>(
         "dimple_radius", bit(ShapeKind::golf_ball), "R",
         "golf_ball: of their rims, over its radius. Default: 0.08"),
     number_parameter<&ShapeOptions::dimple_depth>(
         "dimple_depth", bit(ShapeKind::golf_ball), "D",
         "golf_ball: of their bottoms, over its radius. Default: 0.012")}};

std::string option_of(const Parameter& parameter) {
  std::string option = "--" + std::string(parameter.name);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

bool has(ShapeKind kind, const Parameter& parameter) {
  return (parameter.kinds & bit(kind)) != 0;
}

std::string options_of(ShapeKind kind) {
  std::string options;
  for (const Parameter& parameter : kParameters) {
    if (has(kind, parameter)) {
      options += (options.empty() ? "" : ", ") + option_of(parameter);
    }
  }
  return options;
}

}  // namespace

Shape ShapeInput::make(ShapeKind kind) const {
  for (const Parameter& parameter : kParameters) {
    const std::string option = option_of(parameter);
    if (!has(kind, parameter) && std::find(given.begin(), given.end(), option) != given.end()) {
      throw CLI::ValidationError(
          option, "the shape " + std::string(shape_name(kind)) + " has only " + options_of(kind));
    }
  }
  ShapeOptions complete = options;
  complete.kind = kind;
  return make_shape(complete);
}

void add_shape_options(CLI::App& command, ShapeInput& input) {
  for (const Parameter& parameter : kParameters) {
    const std::string option = option_of(parameter);
    command
        .add_option_function<std::string>(
            option,
            [&input, option, read = parameter.read](const std::string& text) {
              read(input.options, option, text);
              input.given.push_back(option);
            },
            parameter.help)
        ->option_text(parameter.option_text)
        ->group("Shape");
  }
}

ShapeKind parse_shape(const std::string& option, std::string_view name,
                      const std::string& else_wanted) {
  try {
    return shape_kind(name);
  } catch (const Error&) {
    throw CLI::ValidationError(
        option, "'" + std::string(name) + "' is none of " + joined(shape_names()) + else_wanted);
  }
}

Json shape_json(const Shape& shape) {
  const ShapeKind kind = shape.options().kind;
  Json json{{"name", shape_name(kind)}};
  for (const Parameter& parameter : kParameters) {
    if (has(kind, parameter)) {
      json[std::string(parameter.name)] = parameter.json(shape.options());
    }
  }
  return json;
}

}  // namespace difmesh::cli
