#include "nrrd.hpp"

#include <array>
#include <string>
#include <string_view>

#include "elements.hpp"
#include "gzip.hpp"
#include "input_file.hpp"
#include "nrrd_data.hpp"
#include "nrrd_geometry.hpp"
#include "nrrd_header.hpp"
#include "text.hpp"
#include "value_cells.hpp"

namespace difmesh::detail {

FieldFile read_nrrd(const std::filesystem::path& path, const ReadFieldOptions& options) {
  const InputFile file(path);
  const NrrdHeader header = read_nrrd_header(file);
  if (!header.big_endian && size_of(header.type) > 1 && header.encoding != NrrdEncoding::ascii) {
    fail_format(path, "the NRRD header has no field 'endian'");
  }
  FieldFile field;
  (void)bytes_promised(path, header.sizes, size_of(header.type));
  place(path, header, options, field);
  set_cells(path, read_nrrd_data(file, header, options.outside_files), options, field);
  return field;
}

void write_nrrd(AtomicFile& file, const FieldView& field, const std::optional<Grid>& grid,
                const WriteFieldOptions& options) {
  if (grid) {
    require_uniform(*grid, "NRRD");
  }
  constexpr std::array<std::string_view, 4> names{"float", "double", "uint8", "uint16"};
  std::string header =
      "NRRD0004\n# Cell-centred field; the space origin is the centre of the first "
      "cell.\ntype: ";
  header += names[static_cast<std::size_t>(*options.type)];
  header += "\ndimension: 3\n";
  if (grid) {
    header += "space dimension: 3\n";
  }
  header += "sizes: " + std::to_string(field.dims[0]) + " " + std::to_string(field.dims[1]) + " " +
            std::to_string(field.dims[2]) + "\n";
  if (grid) {
    const Vec3& low = grid->origin;
    const Vec3& size = grid->spacing;
    header += "space directions: " + to_text(Vec3{size[0], 0, 0}) + " " +
              to_text(Vec3{0, size[1], 0}) + " " + to_text(Vec3{0, 0, size[2]}) + "\n";
    header +=
        "space origin: " +
        to_text(Vec3{low[0] + 0.5 * size[0], low[1] + 0.5 * size[1], low[2] + 0.5 * size[2]}) +
        "\n";
  }
  header += "kinds: domain domain domain\ncenterings: cell cell cell\nendian: little\nencoding: ";
  header += options.gzip ? "gzip\n" : "raw\n";
  if (grid) {
    header += std::string(kLowCornerKey) + ":=" + to_text(grid->origin[0]) + " " +
              to_text(grid->origin[1]) + " " + to_text(grid->origin[2]) + "\n";
  }
  file.write(header + "\n");
  if (!options.gzip) {
    write_elements(field, *options.type,
                   [&](const std::byte* row, std::size_t bytes) { file.write(row, bytes); });
    return;
  }
  GzipWriter gzip(file, options.gzip_level);
  write_elements(field, *options.type,
                 [&](const std::byte* row, std::size_t bytes) { gzip.write(row, bytes); });
  gzip.finish();
}

}  // namespace difmesh::detail
