#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "difmesh/error.hpp"
#include "draco_codec.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// Flat regular grids pack best: 69 triangles to the byte were measured, of 8 million in 11 bits.
/// Beyond this a few bytes could ask for all of the memory.
constexpr std::uint64_t kMostPerByte = 1000;

/// Reads the start of Draco's data: header, and the counts of connectivity.
class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& path, std::span<const char> bytes)
      : path_(path), bytes_(bytes) {}

  DracoCounts counts() {
    for (const char letter : {'D', 'R', 'A', 'C', 'O'}) {
      if (byte() != static_cast<std::uint8_t>(letter)) {
        fail_format(path_, "no data of Draco");
      }
    }
    const unsigned major = byte();
    version_ = 256U * major + byte();
    const std::uint8_t geometry = byte();
    const std::uint8_t method = byte();
    const unsigned flag_byte = byte();
    const unsigned flags = flag_byte + 256U * byte();
    if (geometry == 0) {  // whose versions are others
      fail_format(path_, "a point cloud of Draco, which has no triangles");
    }
    if (version_ < 0x0100 || version_ > 0x0202) {
      fail_format(path_, "Draco's data of version " + std::to_string(version_ >> 8U) + "." +
                             std::to_string(version_ & 0xFFU) + "; 1.0 to 2.2 can be read");
    }
    if (geometry != 1 || method > 1) {
      fail_format(path_, "no mesh of Draco");
    }
    if (version_ >= 0x0103 && (flags & 0x8000U) != 0) {
      skip_metadata();
    }
    return method == 0 ? sequential() : edgebreaker();
  }

 private:
  DracoCounts sequential() {
    DracoCounts counts;
    counts.faces = number_since(0x0202);
    counts.points = number_since(0x0202);
    return counts;
  }
  DracoCounts edgebreaker() {
    (void)byte();  // how the surface is walked
    if (version_ < 0x0202) {
      (void)number_since(0x0200);  // an older count of vertices
    }
    DracoCounts counts;
    counts.points = number_since(0x0200);
    counts.faces = number_since(0x0200);
    return counts;
  }
  /// Of variable length since that version, of four bytes before.
  std::uint64_t number_since(unsigned version) {
    if (version_ >= version) {
      return varint();
    }
    std::uint64_t number = byte();
    for (unsigned shift = 8; shift < 32; shift += 8) {
      number |= static_cast<std::uint64_t>(byte()) << shift;
    }
    return number;
  }

  void skip_metadata() {
    const std::uint64_t attributes = varint();
    for (std::uint64_t a = 0; a < attributes; ++a) {
      (void)varint();  // the attribute's id
      skip_entries();
    }
    skip_entries();
  }

  void skip_entries() {
    const std::uint64_t entries = varint();
    for (std::uint64_t e = 0; e < entries; ++e) {
      skip(byte());
      skip(varint());
    }
    if (varint() > 0) {
      fail_format(path_, "metadata of Draco within metadata are not supported");
    }
  }

  std::uint8_t byte() {
    if (at_ >= bytes_.size()) {
      fail_format(path_, "truncated: Draco's data end in their header");
    }
    return static_cast<std::uint8_t>(bytes_[at_++]);
  }
  void skip(std::uint64_t count) {
    if (count > bytes_.size() - at_) {
      fail_format(path_, "truncated: Draco's data end in their metadata");
    }
    at_ += static_cast<std::size_t>(count);
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      const std::uint8_t part = byte();
      value |= static_cast<std::uint64_t>(part & 0x7FU) << shift;
      if (part < 0x80) {
        return value;
      }
    }
    fail_format(path_, "a number in Draco's header is too long");
  }

  const std::filesystem::path& path_;
  std::span<const char> bytes_;
  std::size_t at_ = 0;
  unsigned version_ = 0;  ///< 256 for each major one
};

DracoKind kind_of(const draco::PointAttribute& attribute) {
  switch (attribute.attribute_type()) {
    case draco::GeometryAttribute::POSITION:
      return DracoKind::position;
    case draco::GeometryAttribute::NORMAL:
      return DracoKind::normal;
    case draco::GeometryAttribute::GENERIC:
      return DracoKind::generic;
    default:
      return DracoKind::other;
  }
}

std::string name_of(const draco::Mesh& mesh, int index) {
  std::string name;
  const draco::AttributeMetadata* const metadata = mesh.GetAttributeMetadataByAttributeId(index);
  if (metadata == nullptr || !metadata->GetEntryString("name", &name)) {
    return {};
  }
  return name;
}

DecodedAttribute decoded(const std::filesystem::path& path, const draco::Mesh& mesh, int index) {
  const draco::PointAttribute& from = *mesh.attribute(index);
  DecodedAttribute to;
  to.id = from.unique_id();
  to.kind = kind_of(from);
  to.components = static_cast<std::size_t>(from.num_components());
  to.is_integer = draco::IsDataTypeIntegral(from.data_type());
  to.name = name_of(mesh, index);
  // A bool that is neither 0 nor 1 must not even be loaded.
  if (from.data_type() == draco::DT_BOOL || from.data_type() == draco::DT_INVALID) {
    fail_format(path, "an attribute of Draco is of a type that vertices do not have");
  }
  if (to.components < 1 || to.components > 4) {
    fail_format(path, "an attribute of Draco has " + std::to_string(to.components) + " components");
  }
  const std::size_t points = mesh.num_points();
  const std::size_t stored = from.buffer()->data_size();
  const auto stride = static_cast<std::size_t>(from.byte_stride());
  to.values.resize(points * to.components);
  std::array<double, 4> values{};
  for (std::size_t p = 0; p < points; ++p) {
    const auto place = from.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(p)));
    if (place.value() >= from.size() || (place.value() + std::size_t{1}) * stride > stored ||
        !from.ConvertValue<double>(place, static_cast<std::int8_t>(to.components), values.data())) {
      fail_format(path, "an attribute of Draco has no value for point " + std::to_string(p));
    }
    std::copy_n(values.begin(), to.components,
                to.values.begin() + static_cast<std::ptrdiff_t>(p * to.components));
  }
  return to;
}

std::optional<Vec3> origin_of(const draco::Mesh& mesh) {
  std::vector<double> origin;
  if (mesh.GetMetadata() == nullptr ||
      !mesh.GetMetadata()->GetEntryDoubleArray("difmesh_origin", &origin) || origin.size() != 3) {
    return std::nullopt;
  }
  return Vec3{origin[0], origin[1], origin[2]};
}

void copy_triangles(const std::filesystem::path& path, const draco::Mesh& from,
                    Array<Triangle>& to) {
  to.reserve(from.num_faces());
  for (std::uint32_t f = 0; f < from.num_faces(); ++f) {
    const draco::Mesh::Face& face = from.face(draco::FaceIndex(f));
    const Triangle triangle{face[0].value(), face[1].value(), face[2].value()};
    for (const std::uint32_t corner : triangle) {
      if (corner >= from.num_points()) {
        fail_format(path, "face " + std::to_string(f) + " of Draco refers to point " +
                              std::to_string(corner) + " of " + std::to_string(from.num_points()));
      }
    }
    to.push_back(triangle);
  }
}

}  // namespace

DracoCounts draco_counts(const std::filesystem::path& path, std::span<const char> bytes) {
  const DracoCounts counts = HeaderReader(path, bytes).counts();
  if (std::max(counts.faces, counts.points) > kMostPerByte * bytes.size()) {
    fail_format(path, "Draco's data promise " + std::to_string(counts.faces) + " faces and " +
                          std::to_string(counts.points) + " points in " +
                          std::to_string(bytes.size()) + " bytes");
  }
  return counts;
}

DecodedDraco decode_draco(const std::filesystem::path& path, std::span<const char> bytes,
                          std::span<const std::uint32_t> ids) {
  (void)draco_counts(path, bytes);
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  draco::StatusOr<std::unique_ptr<draco::Mesh>> result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) {
    fail_format(path, "Draco cannot decode the mesh: " + result.status().error_msg_string());
  }
  const std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
  DecodedDraco to;
  to.points = mesh->num_points();
  to.origin = origin_of(*mesh);
  copy_triangles(path, *mesh, to.triangles);
  for (int index = 0; index < mesh->num_attributes(); ++index) {
    const draco::PointAttribute& attribute = *mesh->attribute(index);
    const bool wanted = ids.empty()
                            ? kind_of(attribute) != DracoKind::other
                            : std::find(ids.begin(), ids.end(), attribute.unique_id()) != ids.end();
    if (wanted) {
      to.attributes.push_back(decoded(path, *mesh, index));
    }
  }
  return to;
}

}  // namespace difmesh::detail
