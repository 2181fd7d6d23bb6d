#include "mesh_check.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "text.hpp"

namespace difmesh::detail {
namespace {

void check_vectors(const std::filesystem::path& path, std::span<const Vec3> vectors,
                   const char* what, const char* format) {
  const double largest =
      format != nullptr ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  for (std::size_t v = 0; v < vectors.size(); ++v) {
    for (const double component : vectors[v]) {
      if (!(std::abs(component) <= largest)) {
        std::string matter = what;
        matter += " of vertex " + std::to_string(v) + " holds " + to_text(component);
        if (std::isfinite(component)) {
          matter += ", beyond the range of ";
          matter += format;
          matter += "'s float32";
        }
        fail_write(ErrorCode::invalid_value, path, matter);
      }
    }
  }
}

}  // namespace

void fail_write(ErrorCode code, const std::filesystem::path& path, const std::string& matter) {
  throw Error(code, "cannot write " + quoted(path) + ": " + matter);
}

void check_mesh(const std::filesystem::path& path, const Mesh& mesh, const char* format) {
  const std::size_t count = mesh.positions.size();
  const auto check_count = [&](std::size_t found, const char* what) {
    if (found != 0 && found != count) {
      fail_write(
          ErrorCode::invalid_argument, path,
          std::to_string(found) + " " + what + " for " + std::to_string(count) + " vertices");
    }
  };
  check_count(mesh.normals.size(), "normals");
  check_count(mesh.edge_ids.size(), "edge_ids");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= count) {
        fail_write(ErrorCode::invalid_argument, path,
                   "triangle " + std::to_string(t) + " refers to vertex " + std::to_string(v) +
                       " of " + std::to_string(count));
      }
    }
  }
  check_vectors(path, mesh.positions, "the position", format);
  check_vectors(path, mesh.normals, "the normal", nullptr);
}

}  // namespace difmesh::detail
