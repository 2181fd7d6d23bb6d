#include "gltf_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "difmesh/error.hpp"
#include "difmesh/io/names.hpp"
#include "difmesh/version.hpp"
#include "flat_numbers.hpp"
#include "gltf_bytes.hpp"
#include "mesh_check.hpp"

namespace difmesh::detail {
namespace {

using Json = GltfDocument::Json;

constexpr int kUint8 = 5121;
constexpr int kUint16 = 5123;
constexpr int kUint32 = 5125;
constexpr int kFloat32 = 5126;
constexpr int kVertexTarget = 34962;
constexpr int kIndexTarget = 34963;
constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr std::array<const char*, 4> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4"};

bool has_short_indices(std::size_t vertices) {
  return vertices <= kMostShortIndices;
}

Json vector_json(const std::array<float, 3>& vector) {
  return {static_cast<double>(vector[0]), static_cast<double>(vector[1]),
          static_cast<double>(vector[2])};
}

std::array<std::array<float, 3>, 2> box_of(const Array<float>& positions) {
  std::array<float, 3> low{positions[0], positions[1], positions[2]};
  std::array<float, 3> high = low;
  for (std::size_t i = 3; i < positions.size(); i += 3) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], positions[i + axis]);
      high[axis] = std::max(high[axis], positions[i + axis]);
    }
  }
  return {low, high};
}

template <class T>
void write_numbers(const GltfDocument::Sink& sink, const T* numbers, std::size_t count) {
  if constexpr (std::endian::native == std::endian::little) {
    sink(numbers, count * sizeof(T));
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      const T number = little_endian(numbers[i]);
      sink(&number, sizeof number);
    }
  }
}

void write_indices(const GltfDocument::Sink& sink, const PackedPrimitive& primitive) {
  const std::size_t count = 3 * primitive.triangles.size();
  if (!has_short_indices(primitive.vertices)) {
    write_numbers(sink, flat_numbers(primitive.triangles), count);
    return;
  }
  Array<std::uint16_t> indices;
  indices.reserve(count);
  for (const Triangle& t : primitive.triangles) {
    for (const std::uint32_t v : t) {
      indices.push_back(static_cast<std::uint16_t>(v));
    }
  }
  write_numbers(sink, indices.data(), count);
}

Json primitive_json(const Json& attributes, int indices) {
  return {{"attributes", attributes}, {"indices", indices}, {"material", 0}, {"mode", 4}};
}

void write_padding(const GltfDocument::Sink& sink, std::uint64_t bytes) {
  constexpr std::array<char, 4> kZeros{};
  sink(kZeros.data(), static_cast<std::size_t>(padded(bytes) - bytes));
}

}  // namespace

GltfDocument::GltfDocument(const std::filesystem::path& path, PackedSurface surface,
                           const WriteMeshOptions& options, int position_bits)
    : surface_(std::move(surface)) {
  json_["asset"] = {{"version", "2.0"}, {"generator", "difmesh " DIFMESH_VERSION}};
  if (options.draco) {
    json_["extensionsUsed"] = Json::array({kDraco});
    json_["extensionsRequired"] = Json::array({kDraco});
  }
  report_.local_origin = surface_.origin;
  report_.position_bits = position_bits;
  add_nodes(options);
  json_["accessors"] = Json::array();
  json_["bufferViews"] = Json::array();
  for (const PackedPrimitive& primitive : surface_.primitives) {
    if (options.draco) {
      compressed_.push_back(encode_draco(path, primitive, *options.draco, position_bits));
      add_compressed(primitive);
    } else {
      add_plain(primitive);
    }
  }
  json_["meshes"] = Json::array();
  json_["meshes"].push_back(
      {{"name", options.name}, {"primitives", primitives_}, {"extras", mesh_extras(options)}});
  json_["materials"] = Json::array();
  const double shade = options.color ? 1.0 : 0.8;
  json_["materials"].push_back({{"pbrMetallicRoughness",
                                 {{"baseColorFactor", {shade, shade, shade, 1.0}},
                                  {"metallicFactor", 0.0},
                                  {"roughnessFactor", 0.6}}},
                                {"doubleSided", true}});
  report_.primitives = static_cast<std::int64_t>(surface_.primitives.size());
}

/// The root node turns and scales; the node below moves. Two, because the translation must be the
/// local origin as it is, in float64.
void GltfDocument::add_nodes(const WriteMeshOptions& options) {
  const bool has_root = options.up == UpAxis::z || options.metres_per_unit != 1.0;
  json_["scene"] = 0;
  json_["scenes"] = Json::array({{{"nodes", {0}}}});
  json_["nodes"] = Json::array();
  if (has_root) {
    Json root = {{"name", "frame"}, {"children", {1}}};
    if (options.up == UpAxis::z) {
      root["rotation"] = {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
    }
    if (options.metres_per_unit != 1.0) {
      root["scale"] =
          Json::array({options.metres_per_unit, options.metres_per_unit, options.metres_per_unit});
    }
    root["extras"] = {{"difmesh",
                       {{"frame", true},
                        {"up", options.up == UpAxis::z ? "z" : "y"},
                        {"metres_per_unit", options.metres_per_unit}}}};
    json_["nodes"].push_back(std::move(root));
  }
  Json node = {{"name", options.name}, {"mesh", 0}};
  if (surface_.origin != Vec3{0, 0, 0}) {
    node["translation"] = surface_.origin;
  }
  json_["nodes"].push_back(std::move(node));
}

Json GltfDocument::mesh_extras(const WriteMeshOptions& options) const {
  Json extras = Json::object();
  for (const ScalarRange& range : surface_.ranges) {
    extras["scalars"][semantic_of(range.name)] = {
        {"name", range.name}, {"low", range.ends[0]}, {"high", range.ends[1]}};
  }
  if (options.color) {
    extras["COLOR_0"] = {{"attribute", semantic_of(options.color->scalars)},
                         {"map", name_of(kColorMaps, options.color->map)},
                         {"low", (*surface_.color_range)[0]},
                         {"high", (*surface_.color_range)[1]}};
  }
  if (options.draco) {
    extras["position_bits"] = report_.position_bits;
    extras["position_error"] = report_.position_error;
  }
  extras["split"] = surface_.primitives.size() > 1;
  return {{"difmesh", std::move(extras)}};
}

int GltfDocument::add_view(std::uint64_t bytes, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", data_bytes_}, {"byteLength", bytes}};
  if (target != 0) {
    view["target"] = target;
  }
  data_bytes_ += padded(bytes);
  json_["bufferViews"].push_back(std::move(view));
  return static_cast<int>(json_["bufferViews"].size()) - 1;
}

int GltfDocument::add_accessor(Json accessor) {
  json_["accessors"].push_back(std::move(accessor));
  return static_cast<int>(json_["accessors"].size()) - 1;
}

Json GltfDocument::attribute_accessor(const PackedAttribute& attribute,
                                      std::size_t vertices) const {
  const bool is_color = attribute.semantic == "COLOR_0";
  const int word = is_color && !compressed_.empty() ? kUint8 : kUint16;
  Json accessor = {{"componentType", attribute.is_float() ? kFloat32 : word},
                   {"count", vertices},
                   {"type", kTypes[attribute.components - 1]}};
  if (is_color) {
    accessor["normalized"] = true;
  }
  return accessor;
}

void GltfDocument::add_plain(const PackedPrimitive& primitive) {
  Json attributes = Json::object();
  for (const PackedAttribute& attribute : primitive.attributes) {
    Json accessor = attribute_accessor(attribute, primitive.vertices);
    accessor["bufferView"] =
        add_view(primitive.vertices * attribute.bytes_per_vertex(), kVertexTarget);
    if (attribute.semantic == "POSITION") {
      const auto box = box_of(attribute.floats);
      accessor["min"] = vector_json(box[0]);
      accessor["max"] = vector_json(box[1]);
    }
    attributes[attribute.semantic] = add_accessor(std::move(accessor));
  }
  const bool is_short = has_short_indices(primitive.vertices);
  const std::size_t count = 3 * primitive.triangles.size();
  const int view = add_view(count * (is_short ? 2U : 4U), kIndexTarget);
  const int indices = add_accessor({{"bufferView", view},
                                    {"componentType", is_short ? kUint16 : kUint32},
                                    {"count", count},
                                    {"type", "SCALAR"}});
  primitives_.push_back(primitive_json(attributes, indices));
  report_.vertices += static_cast<std::int64_t>(primitive.vertices);
  report_.triangles += static_cast<std::int64_t>(primitive.triangles.size());
  for (const float coordinate : primitive.positions()) {
    // Half a step of float32, and the rounding of the difference to the origin.
    const double rounding = (0x1p-24 + 0x1p-52) * std::abs(static_cast<double>(coordinate));
    report_.position_error = std::max(report_.position_error, rounding);
  }
}

/// Accessors without views say what comes out of Draco's data, whose counts may differ from ours.
void GltfDocument::add_compressed(const PackedPrimitive& primitive) {
  const EncodedDraco& encoded = compressed_.back();
  Json attributes = Json::object();
  Json ids = Json::object();
  for (std::size_t a = 0; a < primitive.attributes.size(); ++a) {
    const PackedAttribute& attribute = primitive.attributes[a];
    Json accessor = attribute_accessor(attribute, encoded.points);
    if (attribute.semantic == "POSITION") {
      accessor["min"] = vector_json(encoded.low);
      accessor["max"] = vector_json(encoded.high);
    }
    attributes[attribute.semantic] = add_accessor(std::move(accessor));
    ids[attribute.semantic] = encoded.ids[a];
  }
  const int indices =
      add_accessor({{"componentType", has_short_indices(encoded.points) ? kUint16 : kUint32},
                    {"count", 3 * encoded.faces},
                    {"type", "SCALAR"}});
  Json json = primitive_json(attributes, indices);
  json["extensions"][kDraco] = {{"bufferView", add_view(encoded.bytes.size(), 0)},
                                {"attributes", std::move(ids)}};
  primitives_.push_back(std::move(json));
  report_.vertices += static_cast<std::int64_t>(encoded.points);
  report_.triangles += static_cast<std::int64_t>(encoded.faces);
  report_.position_error = std::max(report_.position_error, encoded.position_error);
}

std::string GltfDocument::json(std::string uri) const {
  Json document = json_;
  Json buffer = {{"byteLength", data_bytes_}};
  if (!uri.empty()) {
    buffer["uri"] = std::move(uri);
  }
  document["buffers"] = Json::array();
  document["buffers"].push_back(std::move(buffer));
  // Names come from the caller; bytes that are no UTF-8 become U+FFFD.
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void GltfDocument::write_data(const Sink& sink) const {
  for (const EncodedDraco& encoded : compressed_) {
    sink(encoded.bytes.data(), encoded.bytes.size());
    write_padding(sink, encoded.bytes.size());
  }
  if (!compressed_.empty()) {
    return;
  }
  for (const PackedPrimitive& primitive : surface_.primitives) {
    for (const PackedAttribute& attribute : primitive.attributes) {
      write_numbers(sink, attribute.floats.data(), attribute.floats.size());
      write_numbers(sink, attribute.words.data(), attribute.words.size());
      // Every attribute of a vertex takes a multiple of four bytes.
    }
    write_indices(sink, primitive);
    const std::uint64_t size = has_short_indices(primitive.vertices) ? 2 : 4;
    write_padding(sink, 3 * primitive.triangles.size() * size);
  }
}

MeshFileReport GltfDocument::report() const {
  return report_;
}

}  // namespace difmesh::detail
