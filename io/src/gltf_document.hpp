#pragma once
/// \file gltf_document.hpp
/// What a glTF file says and holds, before it gets a container.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "difmesh/io/mesh_file_report.hpp"
#include "draco_codec.hpp"
#include "packed_surface.hpp"

namespace difmesh::detail {

/// Describes a packed surface, and compresses it where asked to.
class GltfDocument {
 public:
  using Json = nlohmann::ordered_json;
  using Sink = std::function<void(const void* data, std::size_t bytes)>;

  GltfDocument(const std::filesystem::path& path, PackedSurface surface,
               const WriteMeshOptions& options, int position_bits);

  [[nodiscard]] std::uint64_t data_bytes() const { return data_bytes_; }
  /// The text; `uri` holds the data where they are not in a .glb.
  [[nodiscard]] std::string json(std::string uri) const;
  /// The data, data_bytes() in all, in portions.
  void write_data(const Sink& sink) const;
  /// All but the size of the file.
  [[nodiscard]] MeshFileReport report() const;

 private:
  void add_plain(const PackedPrimitive& primitive);
  void add_compressed(const PackedPrimitive& primitive);
  int add_view(std::uint64_t bytes, int target);
  int add_accessor(Json accessor);
  Json attribute_accessor(const PackedAttribute& attribute, std::size_t vertices) const;
  void add_nodes(const WriteMeshOptions& options);
  Json mesh_extras(const WriteMeshOptions& options) const;

  PackedSurface surface_;
  std::vector<EncodedDraco> compressed_;  ///< one per primitive, or none
  Json json_;
  Json primitives_ = Json::array();
  std::uint64_t data_bytes_ = 0;
  MeshFileReport report_;
};

}  // namespace difmesh::detail
