#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/io/field_file.hpp"
#include "difmesh/io/names.hpp"

namespace capi = difmesh::capi;

struct dif_field_file {
  difmesh::FieldFile file;
};

namespace {

difmesh::WriteFieldOptions to_options(const dif_field_write_options* options) {
  dif_field_write_options defaults{};
  dif_field_write_options_init(&defaults, sizeof defaults);
  const dif_field_write_options given = capi::read_struct(options, defaults, "options");
  difmesh::WriteFieldOptions result;
  if (given.format != DIF_FIELD_FORMAT_BY_EXTENSION) {
    result.format =
        capi::to_choice(given.format, difmesh::FieldFormat::npy, difmesh::kFieldFormats, "format");
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
  return {capi::to_index(given.dims), capi::to_value_type(given.type),
          capi::to_bool(given.big_endian, "big_endian"), given.offset};
}

difmesh::ReadFieldOptions to_options(const dif_field_read_options* options) {
  dif_field_read_options defaults{};
  dif_field_read_options_init(&defaults, sizeof defaults);
  const dif_field_read_options given = capi::read_struct(options, defaults, "options");
  difmesh::ReadFieldOptions result;
  if (capi::to_bool(given.has_origin, "has_origin")) {
    result.origin = capi::to_vec(given.origin);
  }
  if (capi::to_bool(given.has_spacing, "has_spacing")) {
    result.spacing = capi::to_vec(given.spacing);
  }
  if (capi::to_bool(given.has_full_value, "has_full_value")) {
    result.values = {given.empty_value, given.full_value};
  }
  result.outside_files = capi::to_bool(given.outside_files, "outside_files");
  capi::required_array(given.labels, given.label_count, "labels");
  result.labels.assign(given.labels, given.labels + given.label_count);
  return result;
}

}  // namespace

dif_status dif_field_read(const char* path, const dif_raw_layout* layout, dif_field_file** file) {
  return dif_field_read_with(path, layout, nullptr, file);
}

dif_status dif_field_read_with(const char* path, const dif_raw_layout* layout,
                               const dif_field_read_options* options, dif_field_file** file) {
  return capi::guarded([&] {
    dif_field_file*& handle = capi::out_handle(file, "file");
    const char* name = &capi::required(path, "path");
    const difmesh::ReadFieldOptions chosen = to_options(options);
    handle = new dif_field_file{layout == nullptr
                                    ? difmesh::read_field(name, chosen)
                                    : difmesh::read_field(name, to_layout(layout), chosen)};
  });
}

dif_status dif_field_file_warning(const dif_field_file* file, int64_t index, const char** text) {
  return capi::guarded([&] {
    const std::vector<std::string>& warnings = capi::required(file, "file").file.warnings;
    capi::required(text, "text");
    if (index < 0) {
      capi::fail_argument("index is " + std::to_string(index) + "; it must not be negative");
    }
    const bool known = index < static_cast<std::int64_t>(warnings.size());
    *text = known ? warnings[static_cast<std::size_t>(index)].c_str() : nullptr;
  });
}

dif_status dif_field_file_type(const dif_field_file* file, int32_t* type) {
  return capi::guarded([&] {
    const difmesh::FieldFile& read = capi::required(file, "file").file;
    capi::required(type, "type") = capi::from_value_type(read.file_type);
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
