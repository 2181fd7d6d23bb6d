#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>

#include "difmesh/error.hpp"
#include "format_part.hpp"
#include "mesh_check.hpp"
#include "ply_values.hpp"

namespace difmesh::detail {
namespace {

template <class T>
void put(ByteOutput& output, T value) {
  value = std::endian::native == std::endian::big ? reversed(value) : value;
  output.write(&value, sizeof value);
}

class PlyEncoder : public MeshEncoder {
 public:
  explicit PlyEncoder(EncoderRequest request) : request_(std::move(request)) {
    for (const std::string& name : contents().scalars) {
      if (std::find(kPlyNames.begin(), kPlyNames.end(), name) != kPlyNames.end()) {
        fail_write(ErrorCode::invalid_argument, request_.path,
                   "the name '" + name + "' of scalars is taken by a property of the mesh");
      }
    }
  }

  [[nodiscard]] std::size_t vertex_sections() const override { return 1; }

  void header(ByteOutput& output, const MeshCounts& counts) override {
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(counts.vertices) +
                       "\nproperty double x\nproperty double y\nproperty double z\n";
    if (contents().normals) {
      text += "property double nx\nproperty double ny\nproperty double nz\n";
    }
    if (contents().edge_ids) {
      text += "property uint edge_id_low\nproperty uint edge_id_high\n";
    }
    for (const std::string& name : contents().scalars) {
      text += "property double " + name + "\n";
    }
    // Some readers know signed indices only: unsigned ones where nothing else holds them.
    const bool large = counts.vertices >= std::uint64_t{1} << 31U;
    output.write(text + "element face " + std::to_string(counts.triangles) +
                 "\nproperty list uchar " + (large ? "uint" : "int") +
                 " vertex_indices\nend_header\n");
  }

  void vertices(ByteOutput& output, std::size_t /*section*/, const MeshPortion& portion) override {
    for (std::size_t v = 0; v < portion.positions.size(); ++v) {
      for (const double coordinate : portion.positions[v]) {
        put(output, coordinate);
      }
      for (std::size_t axis = 0; contents().normals && axis < 3; ++axis) {
        put(output, portion.normals[v][axis]);
      }
      if (contents().edge_ids) {
        put(output, static_cast<std::uint32_t>(portion.edge_ids[v]));
        put(output, static_cast<std::uint32_t>(portion.edge_ids[v] >> 32U));
      }
      for (std::size_t n = 0; n < contents().scalars.size(); ++n) {
        put(output, portion.scalars[n].values[v]);
      }
    }
  }

  void triangles(ByteOutput& output, const MeshPortion& portion) override {
    for (const Triangle& t : portion.triangles) {
      put(output, std::uint8_t{3});
      for (const std::uint32_t v : t) {
        put(output, v);
      }
    }
  }

 private:
  [[nodiscard]] const MeshContents& contents() const { return request_.contents; }

  EncoderRequest request_;
};

}  // namespace

constinit const FormatPart ply_format{
    .facts = {.extension = ".ply",
              .name = "PLY",
              .exact = true,
              .normals = true,
              .edge_ids = true,
              .scalars = true},
    .read = read_open<read_ply>,
    .encoder = make_encoder<PlyEncoder>,
};

}  // namespace difmesh::detail
