#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/io/draco_file.hpp"
#include "difmesh/io/gltf_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/io/mesh_file_report.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

using difmesh::ColourMap;
using difmesh::DracoMethod;
using difmesh::MeshFormat;
using difmesh::UpAxis;
using difmesh::VertexScalars;

constexpr std::array kFormats{MeshFormat::ply, MeshFormat::obj,  MeshFormat::off, MeshFormat::stl,
                              MeshFormat::glb, MeshFormat::gltf, MeshFormat::drc};
constexpr std::array kDracoMethods{DracoMethod::edgebreaker, DracoMethod::sequential};
constexpr std::array kColourMaps{ColourMap::viridis, ColourMap::cool_warm};
constexpr std::array kUpAxes{UpAxis::y, UpAxis::z};

bool is_gltf(std::optional<MeshFormat> format) {
  return format == MeshFormat::glb || format == MeshFormat::gltf;
}

/// Instead of the io library's own words, so that callers can tell.
void check_parts(std::optional<MeshFormat> format, bool draco) {
  if (is_gltf(format) && dif_has(DIF_PART_GLTF) == 0) {
    throw capi::Failure(DIF_ERROR_UNSUPPORTED, "this build of the library has no glTF");
  }
  if ((draco || format == MeshFormat::drc) && dif_has(DIF_PART_DRACO) == 0) {
    throw capi::Failure(DIF_ERROR_UNSUPPORTED, "this build of the library has no Draco");
  }
}

/// The options of a call, and the format that they or the path ask for.
struct Request {
  dif_mesh_write_options given;
  std::optional<MeshFormat> format;
  bool normals;
  bool edge_ids;
  std::vector<VertexScalars> scalars;
};

/// Wishes that would be passed over in silence.
void check_format(const Request& request, const char* path) {
  const dif_mesh_write_options& given = request.given;
  const auto check = [&](bool is_wish, bool has, const char* name, const char* formats) {
    if (is_wish && !has) {
      capi::fail_argument(std::string(name) + " is set, but '" + path + "' is written as no " +
                          formats);
    }
  };
  const bool gltf = is_gltf(request.format);
  check(capi::to_bool(given.draco, "draco"), gltf || request.format == MeshFormat::drc, "draco",
        "glTF nor Draco");
  check(given.colour_by != nullptr, gltf, "colour_by", "glTF");
  const UpAxis up = capi::to_choice(given.up, UpAxis::y, kUpAxes, "up");
  check(up != UpAxis::y, gltf, "up", "glTF");
  check(given.metres_per_unit != 1.0, gltf, "metres_per_unit", "glTF");
}

Request to_request(const dif_mesh& mesh, const char* path, const dif_mesh_write_options* options) {
  dif_mesh_write_options defaults{};
  dif_mesh_write_options_init(&defaults, sizeof defaults);
  const dif_mesh_write_options given = capi::read_struct(options, defaults, "options");
  capi::require_zero(given.reserved, "options");
  Request request{given,
                  difmesh::mesh_format_of(path),
                  capi::to_bool(given.normals, "normals"),
                  capi::to_bool(given.edge_ids, "edge_ids"),
                  {}};
  if (given.format != DIF_MESH_FORMAT_BY_EXTENSION) {
    request.format = capi::to_choice(given.format, MeshFormat::ply, kFormats, "format");
  }
  if (capi::to_bool(given.scalars, "scalars")) {
    for (const capi::Scalars& scalars : mesh.scalars) {
      request.scalars.push_back({scalars.name, scalars.values});
    }
  }
  check_format(request, path);
  check_parts(request.format, given.draco == 1);
  return request;
}

difmesh::DracoOptions to_draco(const dif_mesh_write_options& given) {
  difmesh::DracoOptions draco;
  draco.position_bits = given.position_bits;
  draco.cell_size = given.cell_size;
  draco.normal_bits = given.normal_bits;
  draco.generic_bits = given.generic_bits;
  draco.speed = given.draco_speed;
  draco.method = capi::to_choice(given.draco_method, draco.method, kDracoMethods, "draco_method");
  return draco;
}

difmesh::ColourBy to_colour(const dif_mesh_write_options& given) {
  difmesh::ColourBy colour{.scalars = given.colour_by};
  colour.map = capi::to_choice(given.colour_map, colour.map, kColourMaps, "colour_map");
  const std::array<double, 2> range{given.colour_range[0], given.colour_range[1]};
  if (range != std::array<double, 2>{0.0, 0.0}) {
    colour.range = range;
  }
  return colour;
}

difmesh::WriteGltfOptions to_gltf(Request request) {
  const dif_mesh_write_options& given = request.given;
  difmesh::WriteGltfOptions gltf;
  gltf.normals = request.normals;
  gltf.edge_ids = request.edge_ids;
  gltf.scalars = std::move(request.scalars);
  if (given.colour_by != nullptr) {
    gltf.colour = to_colour(given);
  }
  if (given.draco == 1) {
    gltf.draco = to_draco(given);
  }
  gltf.up = capi::to_choice(given.up, gltf.up, kUpAxes, "up");
  gltf.metres_per_unit = given.metres_per_unit;
  if (capi::to_bool(given.has_local_origin, "has_local_origin")) {
    gltf.local_origin = capi::to_vec(given.local_origin);
  }
  gltf.most_vertices = given.most_vertices;
  if (given.name != nullptr) {
    gltf.name = given.name;
  }
  gltf.binary = request.format == MeshFormat::glb;
  return gltf;
}

difmesh::MeshFileReport write(const char* path, const difmesh::Mesh& mesh, Request request) {
  if (is_gltf(request.format)) {
    return write_gltf(path, mesh, to_gltf(std::move(request)));
  }
  if (request.format == MeshFormat::drc) {
    return write_drc(path, mesh,
                     {.normals = request.normals,
                      .edge_ids = request.edge_ids,
                      .scalars = std::move(request.scalars),
                      .draco = to_draco(request.given)});
  }
  return write_mesh(path, mesh,
                    {.format = request.format,
                     .normals = request.normals,
                     .edge_ids = request.edge_ids,
                     .scalars = std::move(request.scalars)});
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
  return result;
}

dif_mesh to_mesh(difmesh::ScalarMesh read) {
  dif_mesh mesh{.mesh = std::move(read.mesh), .warnings = std::move(read.warnings)};
  for (VertexScalars& scalars : read.scalars) {
    mesh.scalars.push_back({std::move(scalars.name), std::move(scalars.values)});
  }
  return mesh;
}

}  // namespace

dif_status dif_mesh_write(const dif_mesh* mesh, const char* path,
                          const dif_mesh_write_options* options) {
  return dif_mesh_write_reported(mesh, path, options, nullptr);
}

dif_status dif_mesh_write_reported(const dif_mesh* mesh, const char* path,
                                   const dif_mesh_write_options* options,
                                   dif_mesh_write_report* report) {
  return capi::guarded([&] {
    if (report != nullptr) {
      capi::check_output(report, "report");  // before there is a file
    }
    const char* name = &capi::required(path, "path");
    const dif_mesh& source = capi::required(mesh, "mesh");
    const difmesh::MeshFileReport facts =
        write(name, source.mesh, to_request(source, name, options));
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
    check_parts(difmesh::mesh_format_of(name), false);
    handle = new dif_mesh(to_mesh(difmesh::read_scalar_mesh(name, chosen)));
  });
}
