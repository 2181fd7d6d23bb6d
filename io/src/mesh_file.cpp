#include "difmesh/io/mesh_file.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "atomic_file.hpp"
#include "difmesh/error.hpp"
#include "input_file.hpp"
#include "mesh_formats.hpp"
#include "text.hpp"

namespace difmesh {
namespace {

constexpr const char* kKnown = "meshes have the extensions .ply, .obj, .off and .stl";

std::optional<MeshFormat> format_of(const std::filesystem::path& path) {
  const std::string extension = detail::extension_of(path);
  if (extension == ".ply") {
    return MeshFormat::ply;
  }
  if (extension == ".obj") {
    return MeshFormat::obj;
  }
  if (extension == ".off") {
    return MeshFormat::off;
  }
  if (extension == ".stl") {
    return MeshFormat::stl;
  }
  return std::nullopt;
}

[[noreturn]] void fail(ErrorCode code, const std::filesystem::path& path,
                       const std::string& matter) {
  throw Error(code, "cannot write " + detail::quoted(path) + ": " + matter);
}

void check_vectors(const std::filesystem::path& path, std::span<const Vec3> vectors,
                   const char* what, double largest) {
  for (std::size_t v = 0; v < vectors.size(); ++v) {
    for (const double component : vectors[v]) {
      if (!(std::abs(component) <= largest)) {
        fail(ErrorCode::invalid_value, path,
             std::string(what) + " of vertex " + std::to_string(v) + " holds " +
                 detail::to_text(component) +
                 (std::isfinite(component) ? ", beyond the range of STL's float32" : ""));
      }
    }
  }
}

void check_mesh(const std::filesystem::path& path, const Mesh& mesh, MeshFormat format) {
  const std::size_t count = mesh.positions.size();
  const auto check_count = [&](std::size_t found, const char* what) {
    if (found != 0 && found != count) {
      fail(ErrorCode::invalid_argument, path,
           std::to_string(found) + " " + what + " for " + std::to_string(count) + " vertices");
    }
  };
  check_count(mesh.normals.size(), "normals");
  check_count(mesh.edge_ids.size(), "edge_ids");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= count) {
        fail(ErrorCode::invalid_argument, path,
             "triangle " + std::to_string(t) + " refers to vertex " + std::to_string(v) + " of " +
                 std::to_string(count));
      }
    }
  }
  const bool stl = format == MeshFormat::stl;
  check_vectors(path, mesh.positions, "the position",
                stl ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max());
  check_vectors(path, mesh.normals, "the normal", std::numeric_limits<double>::max());
  if (stl && mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    fail(ErrorCode::too_large, path,
         std::to_string(mesh.triangles.size()) + " triangles are too many for STL");
  }
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                const WriteMeshOptions& options) {
  const std::optional<MeshFormat> format = options.format ? options.format : format_of(path);
  if (!format) {
    fail(ErrorCode::invalid_argument, path,
         "unknown extension '" + detail::extension_of(path) + "'; " + kKnown);
  }
  check_mesh(path, mesh, *format);
  const bool normals = options.normals && !mesh.normals.empty();
  const bool edge_ids = options.edge_ids && !mesh.edge_ids.empty();
  detail::AtomicFile file(path);
  switch (*format) {
    case MeshFormat::ply:
      detail::write_ply(file, mesh, normals, edge_ids);
      break;
    case MeshFormat::obj:
      detail::write_obj(file, mesh, normals);
      break;
    case MeshFormat::off:
      detail::write_off(file, mesh, normals);
      break;
    case MeshFormat::stl:
      detail::write_stl(file, mesh);
      break;
  }
  file.commit();
}

Mesh read_mesh(const std::filesystem::path& path) {
  const std::optional<MeshFormat> format = format_of(path);
  if (!format) {
    detail::fail_format(path, "unknown extension '" + detail::extension_of(path) + "'; " + kKnown);
  }
  const detail::InputFile file(path);
  switch (*format) {
    case MeshFormat::ply:
      return detail::read_ply(file);
    case MeshFormat::obj:
      return detail::read_obj(file);
    case MeshFormat::off:
      return detail::read_off(file);
    case MeshFormat::stl:
      return detail::read_stl(file);
  }
  return {};
}

}  // namespace difmesh
