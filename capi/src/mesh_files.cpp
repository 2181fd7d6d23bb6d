#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/io/names.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

difmesh::DracoOptions to_draco(const dif_mesh_write_options& given) {
  difmesh::DracoOptions draco;
  draco.position_bits = given.position_bits;
  draco.cell_size = given.cell_size;
  draco.normal_bits = given.normal_bits;
  draco.generic_bits = given.generic_bits;
  draco.speed = given.draco_speed;
  draco.method =
      capi::to_choice(given.draco_method, draco.method, difmesh::kDracoMethods, "draco_method");
  return draco;
}

difmesh::ColorBy to_color(const dif_mesh_write_options& given) {
  difmesh::ColorBy color{.scalars = given.color_by};
  color.map = capi::to_choice(given.color_map, color.map, difmesh::kColorMaps, "color_map");
  const std::array<double, 2> range{given.color_range[0], given.color_range[1]};
  if (range != std::array<double, 2>{0.0, 0.0}) {
    color.range = range;
  }
  return color;
}

/// Draco's options are for formats that are always compressed too, without `draco`.
bool wants_draco(const dif_mesh_write_options& given, const char* path,
                 const std::string& extension) {
  const difmesh::MeshFormat* const format =
      extension.empty() ? difmesh::mesh_format_of(path) : difmesh::find_mesh_format(extension);
  const bool is_always = format != nullptr && format->compression == difmesh::Compression::always;
  return capi::to_bool(given.draco, "draco") || is_always;
}

difmesh::WriteMeshOptions to_options(const char* path, const dif_mesh_write_options* options) {
  dif_mesh_write_options defaults{};
  dif_mesh_write_options_init(&defaults, sizeof defaults);
  const dif_mesh_write_options given = capi::read_struct(options, defaults, "options");
  difmesh::WriteMeshOptions result;
  result.format = given.format != nullptr ? given.format : "";
  result.normals = capi::to_bool(given.normals, "normals");
  result.edge_ids = capi::to_bool(given.edge_ids, "edge_ids");
  result.scalars = capi::to_bool(given.scalars, "scalars");
  if (given.color_by != nullptr) {
    result.color = to_color(given);
  }
  if (wants_draco(given, path, result.format)) {
    result.draco = to_draco(given);
  }
  result.up = capi::to_choice(given.up, result.up, difmesh::kUpAxes, "up");
  result.metres_per_unit = given.metres_per_unit;
  if (capi::to_bool(given.has_local_origin, "has_local_origin")) {
    result.local_origin = capi::to_vec(given.local_origin);
  }
  result.most_vertices = given.most_vertices;
  if (given.name != nullptr) {
    result.name = given.name;
  }
  return result;
}

dif_mesh_write_report to_report(const difmesh::MeshFileReport& report) {
  dif_mesh_write_report result{};
  result.bytes = report.bytes;
  result.vertices = report.vertices;
  result.triangles = report.triangles;
  result.primitives = report.primitives;
  result.position_bits = report.position_bits;
  result.position_error = report.position_error;
  result.collapsed_triangles = report.collapsed_triangles;
  std::copy(report.local_origin.begin(), report.local_origin.end(), result.local_origin);
  result.warning = capi::kept_warning(report.warnings);
  return result;
}

}  // namespace

dif_status dif_mesh_write(const dif_mesh* mesh, const char* path,
                          const dif_mesh_write_options* options, dif_mesh_write_report* report) {
  return capi::guarded([&] {
    if (report != nullptr) {
      capi::check_output(report, "report");  // before there is a file
    }
    const char* name = &capi::required(path, "path");
    const dif_mesh& source = capi::required(mesh, "mesh");
    const difmesh::MeshFileReport facts = write_mesh(name, source.mesh, to_options(name, options));
    if (report != nullptr) {
      capi::write_output(report, to_report(facts), "report");
    }
  });
}

dif_status dif_mesh_read(const char* path, dif_mesh** mesh) {
  return dif_mesh_read_with(path, nullptr, mesh);
}

dif_status dif_mesh_read_with(const char* path, const dif_mesh_read_options* options,
                              dif_mesh** mesh) {
  return capi::guarded([&] {
    dif_mesh*& handle = capi::out_handle(mesh, "mesh");
    const char* name = &capi::required(path, "path");
    const dif_mesh_read_options given =
        capi::read_struct(options, dif_mesh_read_options{}, "options");
    capi::require_zero(given.reserved, "options");
    const difmesh::ReadMeshOptions chosen{.outside_files =
                                              capi::to_bool(given.outside_files, "outside_files")};
    difmesh::MeshFile read = difmesh::read_mesh_file(name, chosen);
    handle = new dif_mesh{.mesh = std::move(read.mesh), .warnings = std::move(read.warnings)};
  });
}
