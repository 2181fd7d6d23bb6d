#pragma once
/// \file packed_surface.hpp
/// A mesh as glTF and Draco take it: float32 about a local origin, in primitives of limited size.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "difmesh/io/write_mesh_options.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// One attribute of the vertices; its numbers are in one of the arrays.
struct PackedAttribute {
  std::string semantic;  ///< POSITION, NORMAL, COLOR_0, _EDGE_ID, _VERTEX or _NAME
  std::size_t components = 1;
  Array<float> floats = {};
  Array<std::uint16_t> words = {};
  std::string scalars = {};  ///< the name of the scalars that _NAME holds

  [[nodiscard]] bool is_float() const { return words.empty(); }
  [[nodiscard]] std::size_t bytes_per_vertex() const {
    return components * (is_float() ? sizeof(float) : sizeof(std::uint16_t));
  }
};

struct PackedPrimitive {
  std::size_t vertices = 0;
  Array<Triangle> triangles;
  std::vector<PackedAttribute> attributes;  ///< POSITION first

  [[nodiscard]] const Array<float>& positions() const { return attributes.front().floats; }
};

/// Least and greatest value of scalars.
struct ScalarRange {
  std::string name;
  std::array<double, 2> ends{};
};

struct PackedSurface {
  Vec3 origin{0, 0, 0};
  std::vector<PackedPrimitive> primitives;
  std::vector<ScalarRange> ranges;  ///< of each of the scalars written
  std::optional<std::array<double, 2>> color_range;
};

/// What becomes of a mesh that check_portion() and check_scalars() took.
struct PackRequest {
  const std::filesystem::path& path;  ///< for messages
  const Mesh& mesh;
  const WriteMeshOptions& options;
  Vec3 origin{0, 0, 0};
};

/// The scalars of a mesh that the options ask for.
[[nodiscard]] inline std::span<const VertexScalar> written_scalars(
    const Mesh& mesh, const WriteMeshOptions& options) {
  return options.scalars ? std::span<const VertexScalar>(mesh.scalars)
                         : std::span<const VertexScalar>();
}
/// The centre of the bounding box of the positions; 0 for none.
[[nodiscard]] Vec3 centre_of(const Array<Vec3>& positions);
/// `_NAME` in capitals.
[[nodiscard]] std::string semantic_of(const std::string& name);
/// \throw Error invalid_value for positions that float32 cannot hold
[[nodiscard]] PackedSurface pack(const PackRequest& request);

}  // namespace difmesh::detail
