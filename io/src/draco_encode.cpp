#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "difmesh/error.hpp"
#include "draco_codec.hpp"
#include "mesh_check.hpp"

namespace difmesh::detail {
namespace {

using draco::GeometryAttribute;

GeometryAttribute::Type type_of(const PackedAttribute& attribute) {
  if (attribute.semantic == "POSITION") {
    return GeometryAttribute::POSITION;
  }
  if (attribute.semantic == "NORMAL") {
    return GeometryAttribute::NORMAL;
  }
  return attribute.semantic == "COLOR_0" ? GeometryAttribute::COLOR : GeometryAttribute::GENERIC;
}

/// Colours of 8 bits: 16 would cost more than all the rest.
std::vector<std::uint8_t> bytes_of(const Array<std::uint16_t>& words) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(words.size());
  for (const std::uint16_t word : words) {
    bytes.push_back(static_cast<std::uint8_t>((word + 128U) / 257U));
  }
  return bytes;
}

/// Hands the values over as they lie. \return Draco's index of the attribute
int add_attribute(draco::Mesh& mesh, const PackedAttribute& attribute, std::size_t vertices) {
  const GeometryAttribute::Type type = type_of(attribute);
  std::vector<std::uint8_t> bytes;
  const void* data = attribute.floats.data();
  draco::DataType data_type = draco::DT_FLOAT32;
  std::size_t stride = attribute.bytes_per_vertex();
  if (!attribute.is_float()) {
    data = attribute.words.data();
    data_type = draco::DT_UINT16;
  }
  if (type == GeometryAttribute::COLOR) {
    bytes = bytes_of(attribute.words);
    data = bytes.data();
    data_type = draco::DT_UINT8;
    stride = attribute.components;
  }
  GeometryAttribute described;
  described.Init(type, nullptr, static_cast<std::uint8_t>(attribute.components), data_type,
                 type == GeometryAttribute::COLOR, static_cast<std::int64_t>(stride), 0);
  const int index = mesh.AddAttribute(described, true, static_cast<std::uint32_t>(vertices));
  mesh.attribute(index)->buffer()->Write(0, data, vertices * stride);
  return index;
}

std::unique_ptr<draco::Mesh> to_draco(const PackedPrimitive& primitive) {
  auto mesh = std::make_unique<draco::Mesh>();
  mesh->set_num_points(static_cast<std::uint32_t>(primitive.vertices));
  mesh->SetNumFaces(primitive.triangles.size());
  for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
    draco::Mesh::Face face;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      face[corner] = draco::PointIndex(primitive.triangles[t][corner]);
    }
    mesh->SetFace(draco::FaceIndex(static_cast<std::uint32_t>(t)), face);
  }
  return mesh;
}

/// The box of the positions after the way there and back, by Draco's own arithmetic.
void bound_decoded(const Array<float>& positions, int bits, EncodedDraco& encoded) {
  std::array<float, 3> low{positions[0], positions[1], positions[2]};
  std::array<float, 3> high = low;
  for (std::size_t i = 3; i < positions.size(); i += 3) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], positions[i + axis]);
      high[axis] = std::max(high[axis], positions[i + axis]);
    }
  }
  float range = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  range = range == 0.F ? 1.F : range;
  const auto steps = static_cast<float>((1U << static_cast<unsigned>(bits)) - 1U);
  const float inverse = steps / range;
  const float step = range / steps;
  encoded.low = low;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float whole = std::floor((high[axis] - low[axis]) * inverse + 0.5F);
    encoded.high[axis] = whole * step + low[axis];
  }
  float largest = 0.F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::abs(low[axis]), std::abs(high[axis])});
  }
  // Half a step; and the roundings of float32: of coordinates when they are packed and when the low
  // corner is added again, and of distances from it on the way.
  encoded.position_error =
      0.5 * static_cast<double>(range) / static_cast<double>(steps) +
      2.0 * (static_cast<double>(range) + static_cast<double>(largest)) * 0x1p-24;
}

void add_metadata(draco::Mesh& mesh, const PackedPrimitive& primitive, const Vec3& origin) {
  auto metadata = std::make_unique<draco::GeometryMetadata>();
  metadata->AddEntryString("generator", "difmesh");
  if (origin != Vec3{0, 0, 0}) {
    metadata->AddEntryDoubleArray("difmesh_origin", {origin[0], origin[1], origin[2]});
  }
  mesh.AddMetadata(std::move(metadata));
  for (std::size_t a = 0; a < primitive.attributes.size(); ++a) {
    const PackedAttribute& attribute = primitive.attributes[a];
    if (attribute.semantic[0] == '_') {
      auto named = std::make_unique<draco::AttributeMetadata>();
      named->AddEntryString("name",
                            attribute.scalars.empty() ? attribute.semantic : attribute.scalars);
      mesh.AddAttributeMetadata(static_cast<std::int32_t>(a), std::move(named));
    }
  }
}

int bits_of(const PackedAttribute& attribute, const DracoOptions& options, int position_bits) {
  switch (type_of(attribute)) {
    case GeometryAttribute::POSITION:
      return position_bits;
    case GeometryAttribute::NORMAL:
      return options.normal_bits;
    default:
      return options.generic_bits;
  }
}

}  // namespace

EncodedDraco encode_draco(const std::filesystem::path& path, const PackedPrimitive& primitive,
                          const DracoOptions& options, int position_bits,
                          const std::optional<Vec3>& origin) {
  EncodedDraco encoded;
  const std::unique_ptr<draco::Mesh> mesh = to_draco(primitive);
  draco::ExpertEncoder encoder(*mesh);
  for (const PackedAttribute& attribute : primitive.attributes) {
    const int index = add_attribute(*mesh, attribute, primitive.vertices);
    encoded.ids.push_back(mesh->attribute(index)->unique_id());
    if (attribute.is_float()) {
      encoder.SetAttributeQuantization(index, bits_of(attribute, options, position_bits));
    }
  }
  if (origin) {
    add_metadata(*mesh, primitive, *origin);
  }
  encoder.SetSpeedOptions(options.speed, options.speed);
  encoder.SetEncodingMethod(options.method == DracoMethod::sequential
                                ? draco::MESH_SEQUENTIAL_ENCODING
                                : draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetTrackEncodedProperties(true);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  if (!status.ok()) {
    fail_write(ErrorCode::invalid_value, path,
               "Draco cannot encode the mesh: " + status.error_msg_string());
  }
  encoded.bytes.assign(buffer.data(), buffer.data() + buffer.size());
  encoded.points = encoder.num_encoded_points();
  encoded.faces = encoder.num_encoded_faces();
  bound_decoded(primitive.positions(), position_bits, encoded);
  return encoded;
}

}  // namespace difmesh::detail
