#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "mesh_check.hpp"
#include "mesh_formats.hpp"
#include "ply_values.hpp"

namespace difmesh::detail {
namespace {

template <class T>
void put(AtomicFile& file, T value) {
  value = std::endian::native == std::endian::big ? reversed(value) : value;
  file.write(&value, sizeof value);
}

void write_header(AtomicFile& file, const Mesh& mesh, const PlyContent& content) {
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(mesh.positions.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\n";
  if (content.normals) {
    header += "property double nx\nproperty double ny\nproperty double nz\n";
  }
  if (content.edge_ids) {
    header += "property uint edge_id_low\nproperty uint edge_id_high\n";
  }
  for (const VertexScalars& scalars : content.scalars) {
    header += "property double " + scalars.name + "\n";
  }
  // Some readers know signed indices only: unsigned ones where nothing else holds them.
  const bool large = mesh.positions.size() >= std::size_t{1} << 31U;
  file.write(header + "element face " + std::to_string(mesh.triangles.size()) +
             "\nproperty list uchar " + (large ? "uint" : "int") + " vertex_indices\nend_header\n");
}

}  // namespace

void check_ply_names(const std::filesystem::path& path, const std::vector<VertexScalars>& scalars) {
  for (const VertexScalars& one : scalars) {
    if (std::find(kPlyNames.begin(), kPlyNames.end(), one.name) != kPlyNames.end()) {
      fail_write(ErrorCode::invalid_argument, path,
                 "the name '" + one.name + "' of scalars is taken by a property of the mesh");
    }
  }
}

void write_ply(AtomicFile& file, const Mesh& mesh, const PlyContent& content) {
  write_header(file, mesh, content);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (const double coordinate : mesh.positions[v]) {
      put(file, coordinate);
    }
    for (std::size_t axis = 0; content.normals && axis < 3; ++axis) {
      put(file, mesh.normals[v][axis]);
    }
    if (content.edge_ids) {
      put(file, static_cast<std::uint32_t>(mesh.edge_ids[v]));
      put(file, static_cast<std::uint32_t>(mesh.edge_ids[v] >> 32U));
    }
    for (const VertexScalars& scalars : content.scalars) {
      put(file, scalars.values[v]);
    }
  }
  for (const Triangle& t : mesh.triangles) {
    put(file, std::uint8_t{3});
    for (const std::uint32_t v : t) {
      put(file, v);
    }
  }
}

}  // namespace difmesh::detail
