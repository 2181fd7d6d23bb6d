// Draco's own files.

#include "drc.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "atomic_file.hpp"
#include "difmesh/error.hpp"
#include "draco_codec.hpp"
#include "flat_numbers.hpp"
#include "format_part.hpp"
#include "input_file.hpp"
#include "mesh_check.hpp"
#include "omissions.hpp"
#include "packed_surface.hpp"
#include "text.hpp"
#include "used_part.hpp"

namespace difmesh::detail {
namespace {

double largest_coordinate(const Mesh& mesh) {
  double largest = 0.0;
  for (const Vec3& position : mesh.positions) {
    for (const double coordinate : position) {
      largest = std::max(largest, std::abs(coordinate));
    }
  }
  return largest;
}

/// Most programs know nothing of the origin in the metadata: only where it is needed.
Vec3 drc_origin(const Mesh& mesh, int position_bits) {
  const Vec3 centre = centre_of(mesh.positions);
  double reach = 0.0;
  for (const Vec3& position : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      reach = std::max(reach, std::abs(position[axis] - centre[axis]));
    }
  }
  const double step = 2.0 * reach / (std::exp2(position_bits) - 1.0);
  const bool is_fine = largest_coordinate(mesh) * 0x1p-24 <= step / 8.0;
  return is_fine ? Vec3{0, 0, 0} : centre;
}

/// "_EDGE_ID" of four digits, as glTF has it.
bool is_edge_ids(const DecodedAttribute& attribute) {
  return attribute.name == "_EDGE_ID" && attribute.components == 4 && attribute.is_integer;
}

Array<Vec3> vectors_of(const std::filesystem::path& path, const DecodedAttribute& attribute,
                       const char* what) {
  if (attribute.components != 3) {
    fail_format(path, std::string(what) + " of Draco have " + std::to_string(attribute.components) +
                          " components");
  }
  Array<Vec3> vectors(attribute.values.size() / 3);
  std::copy(attribute.values.begin(), attribute.values.end(), flat_numbers(vectors));
  return vectors;
}

/// Gathers the attributes that a mesh has.
class DrcReader {
 public:
  DrcReader(const std::filesystem::path& path, DecodedDraco decoded)
      : path_(path), decoded_(std::move(decoded)) {}

  MeshFile read() {
    mesh_.mesh.triangles = std::move(decoded_.triangles);
    for (const DecodedAttribute& attribute : decoded_.attributes) {
      add(attribute);
    }
    if (!with_positions_) {
      fail_format(path_, "Draco's data hold no positions");
    }
    move_to_origin();
    leave_out_not_finite(path_, mesh_);
    omissions_.add_to(mesh_.warnings, path_);
    return std::move(mesh_);
  }

 private:
  void add(const DecodedAttribute& attribute) {
    if (attribute.kind == DracoKind::position && !with_positions_) {
      mesh_.mesh.positions = vectors_of(path_, attribute, "positions");
      with_positions_ = true;
    } else if (attribute.kind == DracoKind::normal && mesh_.mesh.normals.empty()) {
      mesh_.mesh.normals = vectors_of(path_, attribute, "normals");
    } else if (is_edge_ids(attribute)) {
      mesh_.mesh.edge_ids = joined_digits(path_, attribute.values, 4);
    } else if (attribute.kind == DracoKind::generic && attribute.components == 1 &&
               !attribute.name.empty()) {
      if (is_finite(attribute, "the attribute " + in_quotes(attribute.name))) {
        mesh_.mesh.scalars.push_back({attribute.name, attribute.values});
      }
    }
  }

  /// Surfaces can do without scalars that are not.
  bool is_finite(const DecodedAttribute& attribute, const std::string& place) {
    if (std::all_of(attribute.values.begin(), attribute.values.end(),
                    [](double value) { return std::isfinite(value); })) {
      return true;
    }
    omissions_.note(place, "is not finite everywhere, and was left out");
    return false;
  }

  void move_to_origin() {
    const Vec3 origin = decoded_.origin.value_or(Vec3{0, 0, 0});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(origin[axis])) {
        fail_format(path_, "the origin in Draco's metadata is not finite");
      }
      for (Vec3& position : mesh_.mesh.positions) {
        position[axis] += origin[axis];
      }
    }
  }

  const std::filesystem::path& path_;
  DecodedDraco decoded_;
  MeshFile mesh_;
  Omissions omissions_;
  bool with_positions_ = false;
};

MeshFileReport write_used(const std::filesystem::path& path, const Mesh& mesh,
                          const WriteMeshOptions& options) {
  const DracoOptions draco = options.draco.value_or(DracoOptions{});
  const int bits = position_bits_of(mesh, draco);
  const Vec3 origin = drc_origin(mesh, bits);
  WriteMeshOptions content = options;
  content.normals = options.normals && !mesh.normals.empty();
  const PackedSurface surface = pack({path, mesh, content, origin});
  const EncodedDraco encoded = encode_draco(path, surface.primitives.front(), draco, bits, origin);
  AtomicFile file(path);
  file.write(encoded.bytes.data(), encoded.bytes.size());
  file.commit();
  return {.bytes = static_cast<std::int64_t>(encoded.bytes.size()),
          .vertices = static_cast<std::int64_t>(encoded.points),
          .triangles = static_cast<std::int64_t>(encoded.faces),
          .primitives = 1,
          .position_bits = bits,
          .position_error = encoded.position_error,
          .local_origin = origin};
}

MeshFileReport write_drc(const std::filesystem::path& path, const Mesh& mesh,
                         const WriteMeshOptions& options) {
  check_draco(path, options.draco.value_or(DracoOptions{}));
  if (mesh.triangles.empty()) {
    fail_write(ErrorCode::invalid_value, path, "the mesh has no triangles to compress");
  }
  const std::optional<Mesh> part = used_part(mesh);
  return write_used(path, part ? *part : mesh, options);
}

MeshFile read_drc(const InputFile& file) {
  const Array<char> bytes = file.read_text(0, file.size());
  return decode_drc(file.path(), bytes);
}

}  // namespace

constinit const FormatPart drc_format{
    .facts = {.extension = ".drc",
              .name = "Draco",
              .normals = true,
              .edge_ids = true,
              .scalars = true,
              .compression = Compression::always,
              .needs = kDracoMissing},
    .read = read_open<read_drc>,
    .write = write_drc,
};

MeshFile decode_drc(const std::filesystem::path& path, std::span<const char> bytes) {
  return DrcReader(path, decode_draco(path, bytes)).read();
}

Array<std::uint64_t> joined_digits(const std::filesystem::path& path, const Array<double>& digits,
                                   std::size_t count) {
  Array<std::uint64_t> numbers(digits.size() / count);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    std::uint64_t number = 0;
    for (std::size_t digit = count; digit-- > 0;) {
      const double value = digits[n * count + digit];
      if (!(value >= 0.0 && value <= 65535.0)) {
        fail_format(path,
                    "a digit of vertex " + std::to_string(n) + "'s number is " + to_text(value));
      }
      number = (number << 16U) | static_cast<std::uint64_t>(value);
    }
    numbers[n] = number;
  }
  return numbers;
}

}  // namespace difmesh::detail
