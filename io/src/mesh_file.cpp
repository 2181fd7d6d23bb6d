#include "difmesh/io/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "atomic_file.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/io/draco_file.hpp"
#include "difmesh/io/gltf_file.hpp"
#include "gltf_write.hpp"
#include "input_file.hpp"
#include "memory.hpp"
#include "mesh_check.hpp"
#include "mesh_formats.hpp"
#include "packed_surface.hpp"
#include "text.hpp"

namespace difmesh {
namespace {

constexpr const char* kKnown =
    "meshes have the extensions .ply, .obj, .off, .stl, .glb, .gltf and .drc";

struct KnownFormat {
  std::string_view extension;
  MeshFormat format;
};

constexpr std::array<KnownFormat, 7> kFormats{{{".ply", MeshFormat::ply},
                                               {".obj", MeshFormat::obj},
                                               {".off", MeshFormat::off},
                                               {".stl", MeshFormat::stl},
                                               {".glb", MeshFormat::glb},
                                               {".gltf", MeshFormat::gltf},
                                               {".drc", MeshFormat::drc}}};

/// Whether a triangle's area is not exactly 0, as measure() sees it.
bool has_area(const std::array<Vec3, 3>& corners) {
  Vec3 u{};
  Vec3 v{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = corners[1][axis] - corners[0][axis];
    v[axis] = corners[2][axis] - corners[0][axis];
  }
  return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

/// What float32 does to the triangles.
void report_rounding(const Mesh& mesh, MeshFileReport& report) {
  for (const Triangle& triangle : mesh.triangles) {
    std::array<Vec3, 3> exact{};
    std::array<Vec3, 3> rounded{};
    for (std::size_t c = 0; c < 3; ++c) {
      exact[c] = mesh.positions[triangle[c]];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rounded[c][axis] = static_cast<double>(static_cast<float>(exact[c][axis]));
        report.position_error =
            std::max(report.position_error, std::abs(exact[c][axis] - rounded[c][axis]));
      }
    }
    report.collapsed_triangles += has_area(exact) && !has_area(rounded) ? 1 : 0;
  }
}

MeshFileReport write_tables(const std::filesystem::path& path, const Mesh& mesh,
                            const WriteMeshOptions& options, MeshFormat format) {
  const bool stl = format == MeshFormat::stl;
  detail::check_mesh(path, mesh, stl ? "STL" : nullptr);
  if (stl && mesh.triangles.size() > std::numeric_limits<std::int32_t>::max()) {
    detail::fail_write(ErrorCode::too_large, path,
                       std::to_string(mesh.triangles.size()) + " triangles are too many for STL");
  }
  detail::check_scalars(path, mesh, options.scalars);
  if (format == MeshFormat::ply) {
    detail::check_ply_names(path, options.scalars);
  }
  const bool normals = options.normals && !mesh.normals.empty();
  const bool edge_ids = options.edge_ids && !mesh.edge_ids.empty();
  detail::AtomicFile file(path);
  switch (format) {
    case MeshFormat::ply:
      detail::write_ply(file, mesh, {normals, edge_ids, options.scalars});
      break;
    case MeshFormat::obj:
      detail::write_obj(file, mesh, normals);
      break;
    case MeshFormat::off:
      detail::write_off(file, mesh, normals);
      break;
    default:
      detail::write_stl(file, mesh);
      break;
  }
  file.commit();
  MeshFileReport report{.bytes = file.size(),
                        .vertices = static_cast<std::int64_t>(stl ? 3 * mesh.triangles.size()
                                                                  : mesh.positions.size()),
                        .triangles = static_cast<std::int64_t>(mesh.triangles.size()),
                        .primitives = 1};
  if (stl) {
    report_rounding(mesh, report);
  }
  return report;
}

ScalarMesh read_tables(const std::filesystem::path& path, MeshFormat format) {
  const detail::InputFile file(path);
  switch (format) {
    case MeshFormat::ply:
      return detail::read_ply(file);
    case MeshFormat::obj:
      return detail::read_obj(file);
    case MeshFormat::off:
      return detail::read_off(file);
    default:
      return detail::read_stl(file);
  }
}

}  // namespace

MeshFileReport write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                          const WriteMeshOptions& options) {
  const DefaultFloatEnvironment environment;
  const std::optional<MeshFormat> format = options.format ? options.format : mesh_format_of(path);
  if (!format) {
    detail::fail_write(ErrorCode::invalid_argument, path,
                       "unknown extension '" + detail::extension_of(path) + "'; " + kKnown);
  }
  switch (*format) {
    case MeshFormat::glb:
    case MeshFormat::gltf:
      return detail::write_gltf_as(
          path, mesh,
          {.normals = options.normals, .edge_ids = options.edge_ids, .scalars = options.scalars},
          *format == MeshFormat::glb);
    case MeshFormat::drc:
      return write_drc(
          path, mesh,
          {.normals = options.normals, .edge_ids = options.edge_ids, .scalars = options.scalars});
    default:
      return write_tables(path, mesh, options, *format);
  }
}

Mesh read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
  return read_scalar_mesh(path, options).mesh;
}

ScalarMesh read_scalar_mesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
  const DefaultFloatEnvironment environment;
  const std::optional<MeshFormat> format = mesh_format_of(path);
  if (!format) {
    detail::fail_format(path, "unknown extension '" + detail::extension_of(path) + "'; " + kKnown);
  }
  if (*format == MeshFormat::glb || *format == MeshFormat::gltf) {
    return read_gltf(path, options);
  }
  if (*format == MeshFormat::drc) {
    return read_drc(path);
  }
  return detail::naming_file(path, [&] { return read_tables(path, *format); });
}

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
  const std::string extension = detail::extension_of(path);
  for (const KnownFormat& known : kFormats) {
    if (known.extension == extension) {
      return known.format;
    }
  }
  return std::nullopt;
}

}  // namespace difmesh
