#include <algorithm>
#include <array>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/io/field_file.hpp"

namespace capi = difmesh::capi;

struct dif_field_file {
  difmesh::FieldFile file;
};

namespace {

constexpr std::array kFieldFormats{difmesh::FieldFormat::npy, difmesh::FieldFormat::nrrd};

difmesh::WriteFieldOptions to_options(const dif_field_write_options* options) {
  dif_field_write_options defaults{};
  dif_field_write_options_init(&defaults, sizeof defaults);
  const dif_field_write_options given = capi::read_struct(options, defaults, "options");
  difmesh::WriteFieldOptions result;
  if (given.format != DIF_FIELD_FORMAT_BY_EXTENSION) {
    result.format =
        capi::to_choice(given.format, difmesh::FieldFormat::npy, kFieldFormats, "format");
  }
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
