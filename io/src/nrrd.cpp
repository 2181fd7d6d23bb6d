#include "nrrd.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "elements.hpp"
#include "gzip.hpp"
#include "input_file.hpp"
#include "nrrd_geometry.hpp"
#include "nrrd_header.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// The data of an NRRD file: which file, from where, and what is wanted of it.
struct Source {
  const InputFile& file;
  std::int64_t offset;
  std::int64_t bytes;
};

std::string too_short(std::int64_t wanted, std::int64_t found) {
  return "truncated: " + std::to_string(wanted) + " bytes of data wanted, " +
         std::to_string(found) + " found";
}

std::int64_t skip_lines(const InputFile& file, std::int64_t offset, std::int64_t lines) {
  while (lines > 0) {
    const Array<char> text = file.read_text(offset, 1 << 16);
    if (text.empty()) {
      fail_format(file.path(), "truncated: " + std::to_string(lines) +
                                   " lines to skip are missing before the data");
    }
    auto at = text.begin();
    while (lines > 0 && (at = std::find(at, text.end(), '\n')) != text.end()) {
      ++at;
      --lines;
    }
    offset += at - text.begin();
  }
  return offset;
}

void read_raw(const NrrdHeader& header, Source source, FieldFile& field) {
  const std::int64_t room = source.file.size() - source.offset;
  if (header.byte_skip < 0) {
    source.offset += room - source.bytes;
  } else {
    source.offset += std::min(header.byte_skip, room);
  }
  const std::int64_t found = std::min(room, source.file.size() - source.offset);
  if (found < source.bytes) {
    fail_format(source.file.path(), too_short(source.bytes, found));
  }
  field.cells.resize(static_cast<std::size_t>(source.bytes));
  source.file.read(source.offset, field.cells.data(), source.bytes);
}

void read_gzip(const NrrdHeader& header, const Source& source, FieldFile& field) {
  if (header.byte_skip < 0) {
    fail_format(source.file.path(), "'byte skip' of -1 goes with raw data only");
  }
  const std::int64_t most = most_inflated(source.file.size() - source.offset);
  if (header.byte_skip > most || source.bytes > most - header.byte_skip) {
    fail_format(source.file.path(), too_short(source.bytes, source.file.size() - source.offset) +
                                        ", too few even for gzip");
  }
  field.cells.resize(static_cast<std::size_t>(source.bytes));
  inflate_file(source.file, source.offset, header.byte_skip, field.cells.data(), source.bytes);
}

template <class T>
bool parse_element(std::string_view word, std::byte* to) {
  T element{};
  if constexpr (std::is_integral_v<T>) {
    const std::optional<std::int64_t> number = to_integer(word);
    if (!number || *number < 0 || *number > std::numeric_limits<T>::max()) {
      return false;
    }
    element = static_cast<T>(*number);
  } else {
    const std::optional<double> number = to_number(word);
    if (!number) {
      return false;
    }
    element = static_cast<T>(*number);
  }
  std::memcpy(to, &element, sizeof element);
  return true;
}

bool parse_element(ScalarType type, std::string_view word, std::byte* to) {
  switch (type) {
    case ScalarType::float32:
      return parse_element<float>(word, to);
    case ScalarType::float64:
      return parse_element<double>(word, to);
    case ScalarType::uint8:
      return parse_element<std::uint8_t>(word, to);
    case ScalarType::uint16:
      return parse_element<std::uint16_t>(word, to);
  }
  return false;
}

void read_ascii(const NrrdHeader& header, const Source& source, FieldFile& field) {
  if (header.byte_skip < 0) {
    fail_format(source.file.path(), "'byte skip' of -1 goes with raw data only");
  }
  const std::int64_t start = source.offset + std::min(header.byte_skip, source.file.size());
  const Array<char> text = source.file.read_text(start, source.file.size());
  const std::int64_t size = size_of(field.type);
  const std::int64_t wanted = source.bytes / size;
  // A number takes a digit and a space.
  if (wanted > (static_cast<std::int64_t>(text.size()) + 1) / 2) {
    fail_format(source.file.path(), "truncated: " + std::to_string(wanted) + " numbers wanted in " +
                                        std::to_string(text.size()) + " bytes of text");
  }
  field.cells.resize(static_cast<std::size_t>(source.bytes));
  constexpr std::string_view space = " \t\r\n,";
  const std::string_view view(text.data(), text.size());
  std::size_t at = 0;
  for (std::int64_t n = 0; n < wanted; ++n) {
    at = std::min(view.find_first_not_of(space, at), view.size());
    if (at == view.size()) {
      fail_format(source.file.path(), "truncated: " + std::to_string(wanted) + " numbers wanted, " +
                                          std::to_string(n) + " found");
    }
    const std::size_t end = std::min(view.find_first_of(space, at), view.size());
    if (!parse_element(field.type, view.substr(at, end - at), field.cells.data() + n * size)) {
      fail_format(source.file.path(),
                  "number " + std::to_string(n) + " of the data, '" +
                      std::string(view.substr(at, std::min<std::size_t>(end - at, 20))) +
                      "', is none of its type");
    }
    at = end;
  }
}

void read_data(const NrrdHeader& header, const InputFile& file, std::int64_t offset,
               FieldFile& field) {
  const std::int64_t bytes = bytes_promised(file.path(), header.sizes, header.type);
  const Source source{file, skip_lines(file, offset, header.line_skip), bytes};
  switch (header.encoding) {
    case NrrdEncoding::raw:
      read_raw(header, source, field);
      break;
    case NrrdEncoding::gzip:
      read_gzip(header, source, field);
      break;
    case NrrdEncoding::ascii:
      read_ascii(header, source, field);
      return;
  }
  if (header.big_endian.value_or(kBigEndianHost) != kBigEndianHost) {
    swap_bytes(field.cells.data(), bytes, field.type);
  }
}

}  // namespace

FieldFile read_nrrd(const std::filesystem::path& path) {
  const InputFile file(path);
  const NrrdHeader header = read_nrrd_header(file);
  if (!header.big_endian && size_of(header.type) > 1 && header.encoding != NrrdEncoding::ascii) {
    fail_format(path, "the NRRD header has no field 'endian'");
  }
  FieldFile field;
  field.type = header.type;
  (void)bytes_promised(path, header.sizes, header.type);
  place(path, header, field);
  if (header.data_file.empty()) {
    read_data(header, file, header.data_offset, field);
  } else {
    const InputFile data(path.parent_path() / header.data_file);
    read_data(header, data, 0, field);
  }
  return field;
}

void write_nrrd(AtomicFile& file, const FieldView& field, const std::optional<Grid>& grid,
                const WriteFieldOptions& options) {
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
