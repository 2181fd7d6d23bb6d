#include "difmesh/io/field_file.hpp"

#include <string>
#include <utility>

#include "atomic_file.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "elements.hpp"
#include "input_file.hpp"
#include "memory.hpp"
#include "npy.hpp"
#include "nrrd.hpp"
#include "text.hpp"
#include "value_cells.hpp"

namespace difmesh {
namespace {

[[noreturn]] void fail_argument(const std::filesystem::path& path, const std::string& matter) {
  throw Error(ErrorCode::invalid_argument, "cannot write " + detail::quoted(path) + ": " + matter);
}

FieldFormat format_for_writing(const std::filesystem::path& path,
                               const WriteFieldOptions& options) {
  if (options.format) {
    return *options.format;
  }
  const std::string extension = detail::extension_of(path);
  if (extension == ".npy") {
    return FieldFormat::npy;
  }
  if (extension == ".nrrd") {
    return FieldFormat::nrrd;
  }
  fail_argument(path, "unknown extension '" + extension + "'; fields are written as .npy or .nrrd");
}

void check_field(const std::filesystem::path& path, const FieldView& field,
                 const std::optional<Grid>& grid, const WriteFieldOptions& options) {
  if (field.data == nullptr) {
    fail_argument(path, "the field has no data");
  }
  for (const std::int64_t dim : field.dims) {
    if (dim < 1) {
      fail_argument(path, "the field has " + detail::to_text(field.dims) + " cells");
    }
  }
  (void)detail::bytes_promised(path, field.dims, size_of(options.type.value_or(field.type)));
  if (grid) {
    validate(*grid);
    if (grid->dims != field.dims) {
      fail_argument(path, "the grid has " + detail::to_text(grid->dims) + " cells, the field " +
                              detail::to_text(field.dims));
    }
  }
  if (options.gzip_level < 1 || options.gzip_level > 9) {
    fail_argument(path, "gzip_level " + std::to_string(options.gzip_level) + " is not 1 to 9");
  }
}

FieldFile read_raw(const std::filesystem::path& path, const RawLayout& layout,
                   const ReadFieldOptions& options) {
  const detail::InputFile file(path);
  const std::int64_t element = size_of(layout.type);
  const std::int64_t bytes = detail::bytes_promised(path, layout.dims, element);
  if (layout.offset > file.size() || file.size() - layout.offset != bytes) {
    detail::fail_format(path, detail::to_text(layout.dims) + " cells of " +
                                  std::to_string(element) + " bytes from byte " +
                                  std::to_string(layout.offset) + " are " + std::to_string(bytes) +
                                  " bytes; the file has " + std::to_string(file.size()) +
                                  " bytes in all");
  }
  detail::RawCells raw{layout.type, layout.big_endian, false, {}};
  detail::make_room(path, raw.bytes, bytes);
  file.read(layout.offset, raw.bytes.data(), bytes);
  FieldFile field;
  field.dims = layout.dims;
  field.strides = {1, layout.dims[0], layout.dims[0] * layout.dims[1]};
  detail::set_cells(path, std::move(raw), options, field);
  detail::override_grid(options, field);
  return field;
}

}  // namespace

FieldView FieldFile::view() const {
  return {cells.data() + first * size_of(type), type, dims, strides};
}

Grid FieldFile::grid() const {
  return {dims, origin.value_or(Vec3{0.0, 0.0, 0.0}), spacing.value_or(Vec3{1.0, 1.0, 1.0})};
}

std::vector<double> read_faces(const std::filesystem::path& path) {
  const DefaultFloatEnvironment environment;
  return detail::naming_file(path, [&] { return detail::read_faces_npy(path); });
}

FieldFile read_field(const std::filesystem::path& path, const ReadFieldOptions& options) {
  const DefaultFloatEnvironment environment;
  detail::check_options(path, options);
  const std::string extension = detail::extension_of(path);
  if (extension == ".npy") {
    return detail::naming_file(path, [&] { return detail::read_npy(path, options); });
  }
  if (extension == ".nrrd" || extension == ".nhdr") {
    return detail::naming_file(path, [&] { return detail::read_nrrd(path, options); });
  }
  if (extension == ".raw") {
    detail::fail_format(path, "a raw file tells neither its size nor its type: give a layout");
  }
  detail::fail_format(path, "unknown extension '" + extension +
                                "'; fields are read from .npy, .nrrd, .nhdr and, with a layout, "
                                "raw files");
}

FieldFile read_field(const std::filesystem::path& path, const RawLayout& layout,
                     const ReadFieldOptions& options) {
  const DefaultFloatEnvironment environment;
  for (const std::int64_t dim : layout.dims) {
    if (dim < 1 || layout.offset < 0) {
      throw Error(ErrorCode::invalid_argument,
                  "layout of " + detail::quoted(path) + ": " + detail::to_text(layout.dims) +
                      " cells from byte " + std::to_string(layout.offset) +
                      "; each must be at least 1, the byte at least 0");
    }
  }
  detail::check_options(path, options);
  return detail::naming_file(path, [&] { return read_raw(path, layout, options); });
}

void write_field(const std::filesystem::path& path, const FieldView& field,
                 const std::optional<Grid>& grid, const WriteFieldOptions& options) {
  const DefaultFloatEnvironment environment;
  check_field(path, field, grid, options);
  WriteFieldOptions chosen = options;
  chosen.type = options.type.value_or(field.type);
  const FieldFormat format = format_for_writing(path, options);
  detail::AtomicFile file(path);
  if (format == FieldFormat::npy) {
    detail::write_npy(file, field, *chosen.type);
  } else {
    detail::write_nrrd(file, field, grid, chosen);
  }
  file.commit();
}

}  // namespace difmesh
