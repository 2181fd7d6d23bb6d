#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "mesh_check.hpp"
#include "mesh_formats.hpp"
#include "ply_header.hpp"
#include "scanner.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// Values of a text PLY: one line per item.
class TextValues {
 public:
  TextValues(const std::filesystem::path& path, const PlyHeader& header, std::string_view text)
      : lines_(path, text.substr(header.data_offset), {.lines_before = header.lines}) {}
  void begin_item() {
    if (!lines_.next_line()) {
      lines_.fail("truncated: the data end here");
    }
  }
  void end_item() {
    if (!lines_.word().empty()) {
      lines_.fail("more values than the element has properties");
    }
  }
  double number(PlyType) { return lines_.number("a value"); }
  /// Anything that is no number is NaN: the mesh does not need it.
  double scalar(PlyType) {
    const std::string_view word = lines_.word();
    if (word.empty()) {
      lines_.fail("a value is missing");
    }
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = error == std::errc() && end == word.data() + word.size();
    return is_number ? number : std::numeric_limits<double>::quiet_NaN();
  }
  std::int64_t integer(PlyType) { return lines_.integer("an index or length"); }
  void skip(PlyType) {
    if (lines_.word().empty()) {
      lines_.fail("a value is missing");
    }
  }
  static constexpr std::int64_t smallest_size(PlyType) { return 2; }  // a digit and a space

 private:
  Scanner lines_;
};

template <class T>
T reversed(T value) {
  std::array<std::byte, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof value);
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// Values of a binary PLY.
template <bool kSwap>
class BinaryValues {
 public:
  BinaryValues(const std::filesystem::path& path, const PlyHeader& header, std::string_view text)
      : path_(path), text_(text), at_(header.data_offset) {}
  void begin_item() {}
  void end_item() {}
  double number(PlyType type) { return take<double>(type); }
  double scalar(PlyType type) { return take<double>(type); }
  std::int64_t integer(PlyType type) { return take<std::int64_t>(type); }
  void skip(PlyType type) { (void)bytes(static_cast<std::size_t>(size_of(type))); }
  static constexpr std::int64_t smallest_size(PlyType type) { return size_of(type); }

 private:
  const char* bytes(std::size_t count) {
    if (text_.size() - at_ < count) {
      fail_format(path_, "truncated: " + std::to_string(at_ + count) + " bytes or more wanted, " +
                             std::to_string(text_.size()) + " found");
    }
    return text_.data() + std::exchange(at_, at_ + count);
  }
  template <class T>
  T value() {
    T result{};
    std::memcpy(&result, bytes(sizeof result), sizeof result);
    return kSwap ? reversed(result) : result;
  }
  template <class Result>
  Result take(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return static_cast<Result>(value<std::int8_t>());
      case PlyType::uint8:
        return static_cast<Result>(value<std::uint8_t>());
      case PlyType::int16:
        return static_cast<Result>(value<std::int16_t>());
      case PlyType::uint16:
        return static_cast<Result>(value<std::uint16_t>());
      case PlyType::int32:
        return static_cast<Result>(value<std::int32_t>());
      case PlyType::uint32:
        return static_cast<Result>(value<std::uint32_t>());
      case PlyType::float32:
        return static_cast<Result>(value<float>());
      case PlyType::float64:
        return static_cast<Result>(value<double>());
    }
    return Result{};
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  std::size_t at_;
};

/// What a property of a vertex is to a mesh.
enum class Role : std::uint8_t { x, y, z, nx, ny, nz, id_low, id_high, none };

constexpr std::array<std::string_view, 8> kNames{"x",  "y",  "z",           "nx",
                                                 "ny", "nz", "edge_id_low", "edge_id_high"};

Role role_of(const PlyProperty& property) {
  const auto* const found = std::find(kNames.begin(), kNames.end(), property.name);
  const auto role = static_cast<Role>(found - kNames.begin());
  const bool is_id = role == Role::id_low || role == Role::id_high;
  const bool fits = !property.length_type && (!is_id || property.type == PlyType::uint32);
  return fits ? role : Role::none;
}

/// Whether a property becomes scalars of the mesh: a float under a name that scalars may have, which
/// colours (integers) and lists are not.
bool is_scalar(const PlyProperty& property) {
  const auto is_good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  const bool is_taken = std::find(kNames.begin(), kNames.end(), property.name) != kNames.end();
  return !property.length_type && !is_integer(property.type) && !is_taken &&
         std::all_of(property.name.begin(), property.name.end(), is_good);
}

template <class Values>
class PlyReader {
 public:
  PlyReader(const std::filesystem::path& path, const PlyHeader& header, std::string_view text)
      : path_(path),
        header_(header),
        values_(path, header, text),
        size_(static_cast<std::int64_t>(text.size() - header.data_offset)) {}

  ScalarMesh read() {
    for (const PlyElement& element : header_.elements) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips" && element.count > 0) {
        fail_format(path_, "triangle strips; only faces can be read");
      } else {
        skip_element(element);
      }
    }
    if (!vertices_seen_) {
      fail_format(path_, "the PLY header has no element 'vertex'");
    }
    drop_what_is_no_number();
    return {std::move(mesh_), std::move(scalars_)};
  }

 private:
  static bool holds_corners(const PlyElement& element, const PlyProperty& property) {
    return element.name == "face" && property.length_type &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  /// Before memory is taken: can the file hold that many?
  void check_count(const PlyElement& element) const {
    std::int64_t smallest = 0;
    for (const PlyProperty& property : element.properties) {
      smallest += Values::smallest_size(property.length_type.value_or(property.type));
      smallest += holds_corners(element, property) ? 3 * Values::smallest_size(property.type) : 0;
    }
    if (smallest > 0 && element.count > size_ / smallest + 1) {
      fail_format(path_, "truncated: " + std::to_string(element.count) + " of element '" +
                             element.name + "' wanted in " + std::to_string(size_) + " bytes");
    }
    if (element.name == "vertex" && element.count > kMostVertices) {
      throw Error(ErrorCode::too_large, quoted(path_) + ": " + std::to_string(element.count) +
                                            " vertices are more than 32-bit indices can name");
    }
  }

  void read_vertices(const PlyElement& element) {
    std::vector<Role> roles;
    std::array<int, 9> seen{};
    for (const PlyProperty& property : element.properties) {
      roles.push_back(role_of(property));
      ++seen[static_cast<std::size_t>(roles.back())];
      scalars_of_.push_back(is_scalar(property) ? static_cast<int>(scalars_.size()) : -1);
      if (is_scalar(property)) {
        scalars_.push_back({property.name, {}});
      }
    }
    if (vertices_seen_ || seen[0] != 1 || seen[1] != 1 || seen[2] != 1) {
      fail_format(path_, vertices_seen_ ? "two elements 'vertex'"
                                        : "vertices need each of x, y and z once");
    }
    vertices_seen_ = true;
    const auto count = static_cast<std::size_t>(element.count);
    mesh_.positions.resize(count);
    mesh_.normals.resize(seen[3] == 1 && seen[4] == 1 && seen[5] == 1 ? count : 0);
    mesh_.edge_ids.resize(seen[6] == 1 && seen[7] == 1 ? count : 0);
    for (VertexScalars& scalars : scalars_) {
      scalars.values.resize(count);
    }
    for (std::size_t v = 0; v < count; ++v) {
      read_vertex(element, roles, v);
    }
  }

  /// Scalars are finite, and their names differ.
  void drop_what_is_no_number() {
    std::vector<VertexScalars> kept;
    for (VertexScalars& scalars : scalars_) {
      const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const VertexScalars& other) {
        return other.name == scalars.name;
      });
      const bool is_finite = std::all_of(scalars.values.begin(), scalars.values.end(),
                                         [](double value) { return std::isfinite(value); });
      if (is_new && is_finite) {
        kept.push_back(std::move(scalars));
      }
    }
    scalars_ = std::move(kept);
  }

  void read_vertex(const PlyElement& element, const std::vector<Role>& roles, std::size_t v) {
    std::array<double, 6> numbers{};
    std::array<std::uint64_t, 2> id{};
    values_.begin_item();
    for (std::size_t p = 0; p < roles.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      const auto role = static_cast<std::size_t>(roles[p]);
      if (scalars_of_[p] >= 0) {
        scalars_[static_cast<std::size_t>(scalars_of_[p])].values[v] =
            values_.scalar(property.type);
      } else if (roles[p] == Role::none) {
        skip_property(property);
      } else if (role < numbers.size()) {
        numbers[role] = values_.number(property.type);
        if (!std::isfinite(numbers[role])) {
          fail_format(path_,
                      "vertex " + std::to_string(v) + ": " + property.name + " is not finite");
        }
      } else {
        const std::int64_t half = values_.integer(property.type);
        if (half < 0 || half > std::numeric_limits<std::uint32_t>::max()) {
          fail_format(path_, "vertex " + std::to_string(v) + ": " + property.name + " is " +
                                 std::to_string(half));
        }
        id[role - numbers.size()] = static_cast<std::uint64_t>(half);
      }
    }
    values_.end_item();
    mesh_.positions[v] = {numbers[0], numbers[1], numbers[2]};
    if (!mesh_.normals.empty()) {
      mesh_.normals[v] = {numbers[3], numbers[4], numbers[5]};
    }
    if (!mesh_.edge_ids.empty()) {
      mesh_.edge_ids[v] = id[0] + (id[1] << 32U);
    }
  }

  void read_faces(const PlyElement& element) {
    const auto lists = std::count_if(
        element.properties.begin(), element.properties.end(),
        [&](const PlyProperty& property) { return holds_corners(element, property); });
    if (!vertices_seen_ || (lists != 1 && element.count > 0)) {
      fail_format(path_, vertices_seen_ ? "faces need one list vertex_indices"
                                        : "faces stand before the vertices");
    }
    mesh_.triangles.reserve(static_cast<std::size_t>(element.count));
    for (std::int64_t n = 0; n < element.count; ++n) {
      values_.begin_item();
      for (const PlyProperty& property : element.properties) {
        if (holds_corners(element, property)) {
          read_corners(property, n);
        } else {
          skip_property(property);
        }
      }
      values_.end_item();
    }
  }

  void read_corners(const PlyProperty& property, std::int64_t n) {
    const std::int64_t length = values_.integer(*property.length_type);
    if (length < 3 || !is_integer(property.type)) {
      fail_format(path_, "face " + std::to_string(n) + " has " + std::to_string(length) +
                             " corners, or corners that are no integers");
    }
    corners_.clear();
    for (std::int64_t c = 0; c < length; ++c) {
      const std::int64_t v = values_.integer(property.type);
      if (v < 0 || v >= static_cast<std::int64_t>(mesh_.positions.size())) {
        fail_format(path_, "face " + std::to_string(n) + " refers to vertex " + std::to_string(v) +
                               " of " + std::to_string(mesh_.positions.size()));
      }
      corners_.push_back(static_cast<std::uint32_t>(v));
    }
    append_fan(mesh_.triangles, corners_);
  }

  void skip_property(const PlyProperty& property) {
    const std::int64_t length =
        property.length_type ? values_.integer(*property.length_type) : std::int64_t{1};
    if (length < 0) {
      fail_format(path_, "a list '" + property.name + "' of length " + std::to_string(length));
    }
    for (std::int64_t n = 0; n < length; ++n) {
      values_.skip(property.type);
    }
  }

  void skip_element(const PlyElement& element) {
    // Items without properties take no place; there may be 2^63 of them.
    for (std::int64_t n = 0; !element.properties.empty() && n < element.count; ++n) {
      values_.begin_item();
      for (const PlyProperty& property : element.properties) {
        skip_property(property);
      }
      values_.end_item();
    }
  }

  const std::filesystem::path& path_;
  const PlyHeader& header_;
  Values values_;
  std::int64_t size_;
  bool vertices_seen_ = false;
  std::vector<std::uint32_t> corners_;
  Mesh mesh_;
  std::vector<VertexScalars> scalars_;
  std::vector<int> scalars_of_;  ///< which of them a property of the vertices is; -1: none
};

template <class T>
void put(AtomicFile& file, T value) {
  value = std::endian::native == std::endian::big ? reversed(value) : value;
  file.write(&value, sizeof value);
}

void write_header(AtomicFile& file, const Mesh& mesh, const PlyContent& content) {
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(mesh.positions.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\n";
  if (content.normals) {
    header += "property double nx\nproperty double ny\nproperty double nz\n";
  }
  if (content.edge_ids) {
    header += "property uint edge_id_low\nproperty uint edge_id_high\n";
  }
  for (const VertexScalars& scalars : content.scalars) {
    header += "property double " + scalars.name + "\n";
  }
  // Some readers know signed indices only: unsigned ones where nothing else holds them.
  const bool large = mesh.positions.size() >= std::size_t{1} << 31U;
  file.write(header + "element face " + std::to_string(mesh.triangles.size()) +
             "\nproperty list uchar " + (large ? "uint" : "int") + " vertex_indices\nend_header\n");
}

}  // namespace

ScalarMesh read_ply(const InputFile& file) {
  const Array<char> bytes = file.read_text(0, file.size());
  const std::string_view text = plain_text(file.path(), {bytes.data(), bytes.size()});
  const PlyHeader header = parse_ply_header(file.path(), text);
  if (header.encoding == PlyEncoding::text) {
    return PlyReader<TextValues>(file.path(), header, text).read();
  }
  const bool swap =
      (header.encoding == PlyEncoding::big_endian) != (std::endian::native == std::endian::big);
  if (swap) {
    return PlyReader<BinaryValues<true>>(file.path(), header, text).read();
  }
  return PlyReader<BinaryValues<false>>(file.path(), header, text).read();
}

void check_ply_names(const std::filesystem::path& path, const std::vector<VertexScalars>& scalars) {
  for (const VertexScalars& one : scalars) {
    if (std::find(kNames.begin(), kNames.end(), one.name) != kNames.end()) {
      fail_write(ErrorCode::invalid_argument, path,
                 "the name '" + one.name + "' of scalars is taken by a property of the mesh");
    }
  }
}

void write_ply(AtomicFile& file, const Mesh& mesh, const PlyContent& content) {
  write_header(file, mesh, content);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (const double coordinate : mesh.positions[v]) {
      put(file, coordinate);
    }
    for (std::size_t axis = 0; content.normals && axis < 3; ++axis) {
      put(file, mesh.normals[v][axis]);
    }
    if (content.edge_ids) {
      put(file, static_cast<std::uint32_t>(mesh.edge_ids[v]));
      put(file, static_cast<std::uint32_t>(mesh.edge_ids[v] >> 32U));
    }
    for (const VertexScalars& scalars : content.scalars) {
      put(file, scalars.values[v]);
    }
  }
  for (const Triangle& t : mesh.triangles) {
    put(file, std::uint8_t{3});
    for (const std::uint32_t v : t) {
      put(file, v);
    }
  }
}

}  // namespace difmesh::detail
