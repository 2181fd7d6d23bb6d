#include "npy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "elements.hpp"
#include "input_file.hpp"
#include "memory.hpp"
#include "text.hpp"
#include "value_cells.hpp"

namespace difmesh::detail {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::int64_t kLongestHeader = 65536;  // numpy itself refuses more than 10,000
constexpr std::size_t kMostAxes = 16;

struct NpyHeader {
  std::string type;  ///< such as <f8
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
  std::int64_t data_offset = 0;
};

/// Parses the header's Python dictionary: string keys, and values that are a string, True, False or
/// a tuple of integers. Nothing nests, so nothing recurs.
class DictParser {
 public:
  DictParser(const std::filesystem::path& path, std::string_view text) : path_(path), rest_(text) {}

  NpyHeader parse() {
    expect('{');
    while (!accept('}')) {
      const std::string key = string();
      expect(':');
      value_of(key);
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    if (!trimmed(rest_).empty()) {
      fail("more after the dictionary");
    }
    if (seen_ != 7) {
      fail("it needs each of 'descr', 'fortran_order' and 'shape'");
    }
    return header_;
  }

 private:
  [[noreturn]] void fail(const std::string& matter) const {
    fail_format(path_, "bad .npy header: " + matter);
  }

  void value_of(const std::string& key) {
    if (key == "descr") {
      first_time(key, 1);
      if (peek() == '[') {
        fail("a structured type, whose elements have several numbers; save one of its fields");
      }
      header_.type = string();
    } else if (key == "fortran_order") {
      first_time(key, 2);
      header_.fortran_order = boolean();
    } else if (key == "shape") {
      first_time(key, 4);
      tuple();
    } else {
      fail("unknown key '" + key + "'");
    }
  }

  void first_time(const std::string& key, unsigned bit) {
    if ((seen_ & bit) != 0) {
      fail(in_quotes(key) + " twice");
    }
    seen_ |= bit;
  }

  char peek() {
    while (!rest_.empty() && (rest_[0] == ' ' || rest_[0] == '\n' || rest_[0] == '\t')) {
      rest_.remove_prefix(1);
    }
    return rest_.empty() ? '\0' : rest_[0];
  }

  bool accept(char wanted) {
    const bool there = peek() == wanted && !rest_.empty();
    rest_.remove_prefix(there ? 1 : 0);
    return there;
  }

  void expect(char wanted) {
    if (!accept(wanted)) {
      fail(std::string("'") + wanted + "' wanted " +
           (rest_.empty() ? std::string("at the end") : "before '" + excerpt() + "'"));
    }
  }

  [[nodiscard]] std::string excerpt() const { return std::string(rest_.substr(0, 20)); }

  std::string string() {
    const char quote = peek();
    const std::size_t end = quote == '\'' || quote == '"' ? rest_.find(quote, 1) : rest_.npos;
    if (end == rest_.npos) {
      fail("a string wanted before '" + excerpt() + "'");
    }
    const std::string text(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    return text;
  }

  bool boolean() {
    peek();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (rest_.starts_with(word)) {
        rest_.remove_prefix(word.size());
        return value;
      }
    }
    fail("True or False wanted before '" + excerpt() + "'");
  }

  void tuple() {
    expect('(');
    while (!accept(')')) {
      peek();
      const std::size_t digits = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
      const std::optional<std::int64_t> dim = to_integer(rest_.substr(0, digits));
      if (!dim) {
        fail("a dimension wanted before '" + excerpt() + "'");
      }
      header_.shape.push_back(*dim);
      rest_.remove_prefix(digits);
      rest_.remove_prefix(rest_.starts_with('L') ? 1 : 0);  // as Python 2 wrote long integers
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
  }

  const std::filesystem::path& path_;
  std::string_view rest_;
  NpyHeader header_;
  unsigned seen_ = 0;
};

NpyHeader read_header(const InputFile& file) {
  const Array<char> start = file.read_text(0, 12);
  if (!std::string_view(start.data(), start.size()).starts_with(kMagic)) {
    fail_format(file.path(), "no .npy file: it does not start with \\x93NUMPY");
  }
  const auto byte = [&](std::size_t at) {
    if (at >= start.size()) {
      fail_format(file.path(), "truncated in the .npy header");
    }
    return std::int64_t{static_cast<unsigned char>(start[at])};
  };
  const std::int64_t version = byte(6);
  if (version < 1 || version > 3) {
    fail_format(file.path(), "version " + std::to_string(version) + "." + std::to_string(byte(7)) +
                                 " of .npy; 1.0, 2.0 and 3.0 can be read");
  }
  std::int64_t length = byte(8) + (byte(9) << 8);
  if (version > 1) {
    length += (byte(10) << 16) + (byte(11) << 24);
  }
  const std::int64_t offset = version == 1 ? 10 : 12;
  if (length > kLongestHeader) {
    fail_format(file.path(), "a .npy header of " + std::to_string(length) + " bytes");
  }
  if (offset + length > file.size()) {
    fail_format(file.path(), "truncated in the .npy header: " + std::to_string(offset + length) +
                                 " bytes wanted, " + std::to_string(file.size()) + " found");
  }
  const Array<char> text = file.read_text(offset, length);
  NpyHeader header = DictParser(file.path(), {text.data(), text.size()}).parse();
  header.data_offset = offset + length;
  return header;
}

struct ElementType {
  ValueType value = ValueType::float64;
  bool big_endian = false;
  bool boolean = false;
  bool half = false;  ///< f2; `value` is uint16 then
};

struct NamedType {
  std::string_view name;
  ValueType type;
};
constexpr std::array kTypes{
    NamedType{"f4", ValueType::float32}, NamedType{"f8", ValueType::float64},
    NamedType{"f2", ValueType::uint16},  NamedType{"b1", ValueType::uint8},
    NamedType{"u1", ValueType::uint8},   NamedType{"u2", ValueType::uint16},
    NamedType{"u4", ValueType::uint32},  NamedType{"u8", ValueType::uint64},
    NamedType{"i1", ValueType::int8},    NamedType{"i2", ValueType::int16},
    NamedType{"i4", ValueType::int32},   NamedType{"i8", ValueType::int64}};

ElementType element_type(const std::filesystem::path& path, const std::string& name) {
  const std::string kind = name.empty() ? "" : name.substr(1);
  const char order = name.empty() ? '\0' : name[0];
  const auto known = std::find_if(kTypes.begin(), kTypes.end(),
                                  [&](const NamedType& type) { return type.name == kind; });
  if (kind.starts_with('O')) {
    fail_format(path, "elements of type '" + name +
                          "', that is, pickled objects of Python; save an array of numbers");
  }
  if (known == kTypes.end() || !(order == '<' || order == '>' || order == '=' ||
                                 (order == '|' && size_of(known->type) == 1))) {
    fail_format(path, "elements of type '" + name +
                          "'; f2, f4, f8, u1 to u8, i1 to i8 and b1, little or big endian, can "
                          "be read");
  }
  return {known->type, order == '>' || (order == '=' && kBigEndianHost), kind == "b1",
          kind == "f2"};
}

/// IEEE 754's numbers of 16 bits.
float from_half(std::uint16_t half) {
  const float sign = (half & 0x8000U) != 0 ? -1.0F : 1.0F;
  const int exponent = static_cast<int>(half >> 10U & 0x1fU);
  const auto digits = static_cast<float>(half & 0x3ffU);
  if (exponent == 0x1f) {
    return digits == 0.0F ? sign * std::numeric_limits<float>::infinity()
                          : std::numeric_limits<float>::quiet_NaN();
  }
  return exponent == 0 ? sign * std::ldexp(digits, -24)
                       : sign * std::ldexp(digits + 1024.0F, exponent - 25);
}

/// The same numbers as float32.
RawCells widened(const std::filesystem::path& path, RawCells raw) {
  const std::size_t count = raw.bytes.size() / 2;
  if (raw.big_endian != kBigEndianHost) {
    swap_bytes(raw.bytes.data(), static_cast<std::int64_t>(raw.bytes.size()), 2);
  }
  RawCells wide{ValueType::float32, kBigEndianHost, false, {}};
  make_room(path, wide.bytes, static_cast<std::int64_t>(4 * count));
  for (std::size_t n = 0; n < count; ++n) {
    std::uint16_t half = 0;
    std::memcpy(&half, raw.bytes.data() + 2 * n, sizeof half);
    const float number = from_half(half);
    std::memcpy(wide.bytes.data() + 4 * n, &number, sizeof number);
  }
  return wide;
}

/// Shape [k,j,i] to dims x, y, z, by three of its axes.
Index3 dims_of(const std::filesystem::path& path, const NpyHeader& header) {
  const std::size_t rank = header.shape.size();
  const auto axes =
      rank <= kMostAxes ? axes_of_field(header.shape, std::vector<bool>(rank, true)) : std::nullopt;
  if (!axes) {
    fail_format(path, "an array of rank " + std::to_string(rank) +
                          "; a field has rank 3, indexed [k,j,i], and further axes of one element "
                          "only where it is clear which they are");
  }
  return {header.shape[(*axes)[2]], header.shape[(*axes)[1]], header.shape[(*axes)[0]]};
}

/// The elements behind a header, so many as it promises, and nothing else.
RawCells read_elements(const InputFile& file, const std::filesystem::path& path,
                       const NpyHeader& header, const Index3& dims) {
  const ElementType type = element_type(path, header.type);
  const std::int64_t bytes = bytes_promised(path, dims, size_of(type.value));
  const std::int64_t found = file.size() - header.data_offset;
  if (found != bytes) {
    fail_format(path, (found < bytes ? "truncated: " : "too long: ") + to_text(dims) +
                          " cells of type '" + header.type + "' are " + std::to_string(bytes) +
                          " bytes after the header, " + std::to_string(found) + " found");
  }
  RawCells raw{type.value, type.big_endian, type.boolean, {}};
  make_room(path, raw.bytes, bytes);
  file.read(header.data_offset, raw.bytes.data(), bytes);
  return type.half ? widened(path, std::move(raw)) : std::move(raw);
}

}  // namespace

std::vector<double> read_faces_npy(const std::filesystem::path& path) {
  const InputFile file(path);
  const NpyHeader header = read_header(file);
  if (header.shape.size() != 1 || header.shape[0] < 2) {
    fail_format(path, "an array of rank " + std::to_string(header.shape.size()) +
                          "; the faces of an axis have rank 1, and are two or more");
  }
  const std::int64_t count = header.shape[0];
  RawCells raw = read_elements(file, path, header, {count, 1, 1});
  std::vector<double> faces(static_cast<std::size_t>(count));
  with_value_type(raw.type, [&]<class T>(T) {
    if (raw.big_endian != kBigEndianHost) {
      swap_bytes(raw.bytes.data(), static_cast<std::int64_t>(raw.bytes.size()), sizeof(T));
    }
    for (std::size_t n = 0; n < faces.size(); ++n) {
      T value;
      std::memcpy(&value, raw.bytes.data() + n * sizeof(T), sizeof(T));
      faces[n] = static_cast<double>(value);
    }
  });
  return faces;
}

FieldFile read_npy(const std::filesystem::path& path, const ReadFieldOptions& options) {
  const InputFile file(path);
  const NpyHeader header = read_header(file);
  FieldFile field;
  field.dims = dims_of(path, header);
  // Refuses sizes whose products are beyond 63 bits.
  RawCells raw = read_elements(file, path, header, field.dims);
  const auto [nx, ny, nz] = field.dims;
  field.strides = header.fortran_order ? Index3{nz * ny, nz, 1} : Index3{1, nx, nx * ny};
  set_cells(path, std::move(raw), options, field);
  override_grid(options, field);
  return field;
}

void write_npy(AtomicFile& file, const FieldView& field, ScalarType type) {
  constexpr std::array<std::string_view, 4> names{"<f4", "<f8", "|u1", "<u2"};
  const auto [nx, ny, nz] = field.dims;
  std::string header = "{'descr': '" + std::string(names[static_cast<std::size_t>(type)]) +
                       "', 'fortran_order': False, 'shape': (" + std::to_string(nz) + ", " +
                       std::to_string(ny) + ", " + std::to_string(nx) + "), }";
  // The data start at a multiple of 64 bytes, for those who map the file into memory.
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  file.write(kMagic);
  const std::array<char, 4> version_and_length{1, 0, static_cast<char>(header.size() & 255U),
                                               static_cast<char>(header.size() >> 8U)};
  file.write(version_and_length.data(), version_and_length.size());
  file.write(header);
  write_elements(field, type,
                 [&](const std::byte* row, std::size_t bytes) { file.write(row, bytes); });
}

}  // namespace difmesh::detail
