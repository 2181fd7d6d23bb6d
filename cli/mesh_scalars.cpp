#include "mesh_scalars.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "difmesh/curvature.hpp"
#include "names.hpp"
#include "parse.hpp"
#include "roughness.hpp"

namespace difmesh::cli {
namespace {

template <std::size_t axis>
Array<double> coordinate(const Mesh& mesh) {
  Array<double> values;
  values.reserve(mesh.positions.size());
  for (const Vec3& position : mesh.positions) {
    values.push_back(position[axis]);
  }
  return values;
}

/// Not a number where a vertex has no curvature; files and colours want numbers.
Array<double> numbers(Array<double> values) {
  for (double& value : values) {
    value = std::isnan(value) ? 0.0 : value;
  }
  return values;
}

Array<double> mean_curvature(const Mesh& mesh) {
  return numbers(curvature(mesh).mean);
}

Array<double> gaussian_curvature(const Mesh& mesh) {
  return numbers(curvature(mesh).gaussian);
}

constexpr std::array<ScalarKind, 6> kKinds{
    {{"x", "coordinate", coordinate<0>},
     {"y", "coordinate", coordinate<1>},
     {"z", "coordinate", coordinate<2>},
     {"angle", "largest angle between neighbouring facets, degrees", largest_angles},
     {"mean_curvature", "positive where bodies are convex, 1 / length", mean_curvature},
     {"gaussian_curvature", "the product of the principal ones, 1 / length^2",
      gaussian_curvature}}};

}  // namespace

std::span<const ScalarKind> scalar_kinds() {
  return kKinds;
}

std::vector<VertexScalar> curvature_scalars(Curvature curvature) {
  return {{"mean_curvature", numbers(std::move(curvature.mean))},
          {"gaussian_curvature", numbers(std::move(curvature.gaussian))}};
}

std::string scalars_name(std::string word) {
  std::replace(word.begin(), word.end(), '-', '_');
  return word;
}

VertexScalar scalars_of(const std::string& option, const std::string& word, const Mesh& mesh) {
  const std::string name = scalars_name(word);
  std::string known;
  for (const VertexScalar& scalars : mesh.scalars) {
    if (scalars.name == name) {
      return scalars;
    }
    known += scalars.name + ", ";
  }
  for (const ScalarKind& kind : kKinds) {
    if (kind.name == name) {
      return {name, kind.of(mesh)};
    }
    known += (&kind == &kKinds.front() ? "" : ", ") + std::string(kind.name);
  }
  const std::string more = word == kErrorName ? "; it needs --shape or --reference" : "";
  throw CLI::ValidationError(option, "'" + word + "' is none of " + known + more);
}

bool has_scalars(const Mesh& mesh, const std::string& name) {
  return std::ranges::find(mesh.scalars, name, &VertexScalar::name) != mesh.scalars.end();
}

ColorMap map_of(const ColorScale& scale, const std::string& name) {
  return scale.map.value_or(name == kErrorName ? ColorMap::cool_warm : ColorMap::viridis);
}

void add_color_scale_options(CLI::App& command, ColorScale& scale) {
  command
      .add_option_function<std::string>(
          "--color-map",
          [&scale](const std::string& text) {
            scale.map = parse_name("--color-map", text, kColorMaps);
          },
          "viridis (default), or cool_warm, which diverges from 0 (default of error)")
      ->option_text("NAME");
  command
      .add_option_function<std::string>(
          "--color-range",
          [&scale](const std::string& text) { scale.range = parse_range("--color-range", text); },
          "Numbers of the first and the last color. Default: all there are")
      ->option_text("LOW,HIGH");
}

}  // namespace difmesh::cli
