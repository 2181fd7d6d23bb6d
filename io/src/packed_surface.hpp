#pragma once
/// \file packed_surface.hpp
/// A mesh as glTF and Draco take it: float32 about a local origin, in primitives of limited size.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "difmesh/io/gltf_file.hpp"

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

struct PackedSurface {
  Vec3 origin{0, 0, 0};
  std::vector<PackedPrimitive> primitives;
  /// Least and greatest value of each of the scalars.
  std::vector<std::array<double, 2>> ranges;
  std::optional<std::array<double, 2>> colour_range;
};

/// What becomes of a mesh whose arrays were checked by check_mesh().
struct PackRequest {
  const std::filesystem::path& path;  ///< for messages
  const Mesh& mesh;
  const WriteGltfOptions& options;
  Vec3 origin{0, 0, 0};
};

/// The centre of the bounding box of the positions; 0 for none.
[[nodiscard]] Vec3 centre_of(const Array<Vec3>& positions);
/// `_NAME` in capitals.
[[nodiscard]] std::string semantic_of(const std::string& name);
/// \throw Error invalid_argument, invalid_value as write_gltf() says
void check_scalars(const std::filesystem::path& path, const Mesh& mesh,
                   const std::vector<VertexScalars>& scalars);
/// \throw Error invalid_value for positions that float32 cannot hold
[[nodiscard]] PackedSurface pack(const PackRequest& request);

}  // namespace difmesh::detail
