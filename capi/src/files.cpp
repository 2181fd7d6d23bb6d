#include <algorithm>
#include <optional>
#include <string>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

struct dif_field_file {
  difmesh::FieldFile file;
};

namespace {

/// The constant number `value` of an enumeration that counts from 1; 0 stands for none.
template <class Enum>
std::optional<Enum> to_format(std::int32_t value, Enum last) {
  const std::int32_t most = static_cast<std::int32_t>(last) + 1;
  if (value < 0 || value > most) {
    capi::fail_argument("format is " + std::to_string(value) + "; 0 to " + std::to_string(most) +
                        " are possible");
  }
  return value == 0 ? std::nullopt : std::optional(static_cast<Enum>(value - 1));
}
static_assert(static_cast<int>(difmesh::MeshFormat::ply) + 1 == DIF_MESH_FORMAT_PLY &&
              static_cast<int>(difmesh::MeshFormat::obj) + 1 == DIF_MESH_FORMAT_OBJ &&
              static_cast<int>(difmesh::MeshFormat::off) + 1 == DIF_MESH_FORMAT_OFF &&
              static_cast<int>(difmesh::MeshFormat::stl) + 1 == DIF_MESH_FORMAT_STL &&
              static_cast<int>(difmesh::MeshFormat::glb) + 1 == DIF_MESH_FORMAT_GLB &&
              static_cast<int>(difmesh::MeshFormat::gltf) + 1 == DIF_MESH_FORMAT_GLTF &&
              static_cast<int>(difmesh::MeshFormat::drc) + 1 == DIF_MESH_FORMAT_DRC &&
              static_cast<int>(difmesh::FieldFormat::npy) + 1 == DIF_FIELD_FORMAT_NPY &&
              static_cast<int>(difmesh::FieldFormat::nrrd) + 1 == DIF_FIELD_FORMAT_NRRD);

difmesh::WriteMeshOptions to_options(const dif_mesh_write_options* options) {
  dif_mesh_write_options defaults{};
  dif_mesh_write_options_init(&defaults, sizeof defaults);
  const dif_mesh_write_options given = capi::read_struct(options, defaults, "options");
  capi::require_zero(given.reserved, "options");
  difmesh::WriteMeshOptions result;
  result.format = to_format(given.format, difmesh::MeshFormat::drc);
  result.normals = capi::to_bool(given.normals, "normals");
  result.edge_ids = capi::to_bool(given.edge_ids, "edge_ids");
  return result;
}

difmesh::WriteFieldOptions to_options(const dif_field_write_options* options) {
  dif_field_write_options defaults{};
  dif_field_write_options_init(&defaults, sizeof defaults);
  const dif_field_write_options given = capi::read_struct(options, defaults, "options");
  difmesh::WriteFieldOptions result;
  result.format = to_format(given.format, difmesh::FieldFormat::nrrd);
  if (given.type != 0) {
    result.type = capi::to_scalar_type(given.type);
  }
  result.gzip = capi::to_bool(given.gzip, "gzip");
  result.gzip_level = given.gzip_level;
  return result;
}

difmesh::RawLayout to_layout(const dif_raw_layout* layout) {
  dif_raw_layout defaults{};
  dif_raw_layout_init(&defaults, sizeof defaults);
  const dif_raw_layout given = capi::read_struct(layout, defaults, "layout");
  return {capi::to_index(given.dims), capi::to_scalar_type(given.type),
          capi::to_bool(given.big_endian, "big_endian"), given.offset};
}

}  // namespace

dif_status dif_mesh_write(const dif_mesh* mesh, const char* path,
                          const dif_mesh_write_options* options) {
  return capi::guarded([&] {
    write_mesh(&capi::required(path, "path"), capi::required(mesh, "mesh").mesh,
               to_options(options));
  });
}

dif_status dif_mesh_read(const char* path, dif_mesh** mesh) {
  return capi::guarded([&] {
    dif_mesh*& handle = capi::out_handle(mesh, "mesh");
    handle = new dif_mesh{difmesh::read_mesh(&capi::required(path, "path")), std::nullopt};
  });
}

dif_status dif_field_read(const char* path, const dif_raw_layout* layout, dif_field_file** file) {
  return capi::guarded([&] {
    dif_field_file*& handle = capi::out_handle(file, "file");
    const char* name = &capi::required(path, "path");
    handle = new dif_field_file{layout == nullptr ? difmesh::read_field(name)
                                                  : difmesh::read_field(name, to_layout(layout))};
  });
}

void dif_field_file_free(dif_field_file* file) {
  delete file;
}

dif_status dif_field_file_field(const dif_field_file* file, dif_field* field) {
  return capi::guarded([&] {
    const difmesh::FieldFile& read = capi::required(file, "file").file;
    const difmesh::FieldView view = read.view();
    const difmesh::Grid grid = read.grid();
    dif_field result{};
    result.data = view.data;
    result.type = capi::from_scalar_type(view.type);
    std::copy(view.dims.begin(), view.dims.end(), result.dims);
    std::copy(view.strides.begin(), view.strides.end(), result.strides);
    std::copy(grid.origin.begin(), grid.origin.end(), result.origin);
    std::copy(grid.spacing.begin(), grid.spacing.end(), result.spacing);
    capi::write_output(field, result, "field");
  });
}

dif_status dif_field_write(const dif_field* field, const char* path,
                           const dif_field_write_options* options) {
  return capi::guarded([&] {
    const char* name = &capi::required(path, "path");
    const auto [view, grid] = capi::to_field(field);
    write_field(name, view, grid, to_options(options));
  });
}
