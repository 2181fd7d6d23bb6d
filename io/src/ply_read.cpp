#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "format_part.hpp"
#include "mesh_check.hpp"
#include "ply_header.hpp"
#include "ply_values.hpp"
#include "polygons.hpp"
#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

/// What a property of a vertex is to a mesh.
enum class Role : std::uint8_t { x, y, z, nx, ny, nz, id_low, id_high, none };

Role role_of(const PlyProperty& property) {
  const auto* const found = std::find(kPlyNames.begin(), kPlyNames.end(), property.name);
  const auto role = static_cast<Role>(found - kPlyNames.begin());
  const bool is_id = role == Role::id_low || role == Role::id_high;
  const bool fits = !property.length_type && (!is_id || property.type == PlyType::uint32);
  return fits ? role : Role::none;
}

/// Whether a property becomes scalars of the mesh: a float under a name that scalars may have,
/// which colours (integers) and lists are not.
bool is_scalar(const PlyProperty& property) {
  const auto is_good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  const bool is_taken =
      std::find(kPlyNames.begin(), kPlyNames.end(), property.name) != kPlyNames.end();
  return !property.length_type && !is_integer(property.type) && !is_taken &&
         std::all_of(property.name.begin(), property.name.end(), is_good);
}

template <class Values>
class PlyReader {
 public:
  PlyReader(const std::filesystem::path& path, const PlyHeader& header, std::string_view text)
      : path_(path),
        header_(header),
        values_(Values(path, header, text)),
        size_(static_cast<std::int64_t>(text.size() - header.data_offset)) {}

  MeshFile read() {
    for (const PlyElement& element : header_.elements) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (!holds_triangles(element)) {
        skip_element(element);
        note_left_out(element);
      } else if (vertices_seen_) {
        read_triangles(element);
      } else {
        postponed_.emplace_back(&element, *values_);
        skip_element(element);
      }
    }
    if (!vertices_seen_) {
      fail_format(path_, "the PLY header has no element 'vertex'");
    }
    if (const std::string tail = values_->tail(); !tail.empty()) {
      add_warning(result_.warnings, path_, tail);
    }
    for (const auto& [element, values] : postponed_) {
      values_.emplace(values);
      read_triangles(*element);
    }
    cut_polygons(path_, polygons_, result_);
    drop_what_is_no_number();
    return std::move(result_);
  }

 private:
  static bool holds_triangles(const PlyElement& element) {
    return element.name == "face" || element.name == "tristrips";
  }

  /// The list of corners: known by its name, or by being the only list of integers.
  const PlyProperty* corner_list(const PlyElement& element) const {
    constexpr std::array<std::string_view, 5> names{"vertex_indices", "vertex_index",
                                                    "vertex_indexes", "vertices", "indices"};
    const PlyProperty* named = nullptr;
    const PlyProperty* list = nullptr;
    int named_count = 0;
    int list_count = 0;
    for (const PlyProperty& property : element.properties) {
      if (property.length_type && is_integer(property.type)) {
        list = &property;
        ++list_count;
        if (std::find(names.begin(), names.end(), property.name) != names.end()) {
          named = &property;
          ++named_count;
        }
      }
    }
    return named_count == 1 ? named : named_count == 0 && list_count == 1 ? list : nullptr;
  }

  /// Before memory is taken: can the file hold that many?
  void check_count(const PlyElement& element) const {
    const PlyProperty* const corners = holds_triangles(element) ? corner_list(element) : nullptr;
    const int fewest = element.name == "face" ? 3 : 0;
    std::int64_t smallest = 0;
    for (const PlyProperty& property : element.properties) {
      smallest += Values::smallest_size(property.length_type.value_or(property.type));
      smallest += &property == corners ? fewest * Values::smallest_size(property.type) : 0;
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

  Mesh& mesh() { return result_.mesh; }
  std::vector<VertexScalar>& scalars() { return result_.mesh.scalars; }

  void read_vertices(const PlyElement& element) {
    std::vector<Role> roles;
    std::array<int, 9> seen{};
    for (const PlyProperty& property : element.properties) {
      roles.push_back(role_of(property));
      ++seen[static_cast<std::size_t>(roles.back())];
      scalars_of_.push_back(is_scalar(property) ? static_cast<int>(scalars().size()) : -1);
      if (is_scalar(property)) {
        scalars().push_back({property.name, {}});
      }
    }
    if (vertices_seen_ || seen[0] != 1 || seen[1] != 1 || seen[2] != 1) {
      fail_format(path_, vertices_seen_ ? "two elements 'vertex'"
                                        : "vertices need each of x, y and z once");
    }
    vertices_seen_ = true;
    const auto count = static_cast<std::size_t>(element.count);
    mesh().positions.resize(count);
    mesh().normals.resize(seen[3] == 1 && seen[4] == 1 && seen[5] == 1 ? count : 0);
    mesh().edge_ids.resize(seen[6] == 1 && seen[7] == 1 ? count : 0);
    for (VertexScalar& one : scalars()) {
      one.values.resize(count);
    }
    for (std::size_t v = 0; v < count; ++v) {
      read_vertex(element, roles, v);
    }
  }

  /// The mesh does not need normals; scalars are finite, and their names differ.
  void drop_what_is_no_number() {
    if (!normals_are_finite_) {
      mesh().normals.clear();
      add_warning(result_.warnings, path_, "normals that are not finite: all normals left out");
    }
    std::vector<VertexScalar> kept;
    for (VertexScalar& one : scalars()) {
      const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const VertexScalar& other) {
        return other.name == one.name;
      });
      const bool is_finite = std::all_of(one.values.begin(), one.values.end(),
                                         [](double value) { return std::isfinite(value); });
      if (is_new && is_finite) {
        kept.push_back(std::move(one));
      } else {
        add_warning(result_.warnings, path_,
                    "scalars " + in_quotes(one.name) +
                        (is_new ? " that are not finite left out" : " left out, a second time"));
      }
    }
    scalars() = std::move(kept);
  }

  void read_vertex(const PlyElement& element, const std::vector<Role>& roles, std::size_t v) {
    std::array<double, 6> numbers{};
    std::array<std::uint64_t, 2> id{};
    values_->begin_item();
    for (std::size_t p = 0; p < roles.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      const auto role = static_cast<std::size_t>(roles[p]);
      if (scalars_of_[p] >= 0) {
        scalars()[static_cast<std::size_t>(scalars_of_[p])].values[v] =
            values_->scalar(property.type);
      } else if (roles[p] == Role::none) {
        skip_property(property);
      } else if (role < numbers.size()) {
        numbers[role] = role < 3 ? coordinate(property, v) : values_->scalar(property.type);
      } else {
        id[role - numbers.size()] = half_id(property, v);
      }
    }
    values_->end_item();
    mesh().positions[v] = {numbers[0], numbers[1], numbers[2]};
    if (!mesh().normals.empty()) {
      mesh().normals[v] = {numbers[3], numbers[4], numbers[5]};
      normals_are_finite_ = normals_are_finite_ && std::isfinite(numbers[3]) &&
                            std::isfinite(numbers[4]) && std::isfinite(numbers[5]);
    }
    if (!mesh().edge_ids.empty()) {
      mesh().edge_ids[v] = id[0] + (id[1] << 32U);
    }
  }

  double coordinate(const PlyProperty& property, std::size_t v) {
    const double number = values_->number(property.type);
    if (!std::isfinite(number)) {
      fail_format(path_, "vertex " + std::to_string(v) + ": " + property.name + " is not finite");
    }
    return number;
  }

  std::uint64_t half_id(const PlyProperty& property, std::size_t v) {
    const std::int64_t half = values_->integer(property.type);
    if (half < 0 || half > std::numeric_limits<std::uint32_t>::max()) {
      fail_format(path_, "vertex " + std::to_string(v) + ": " + property.name + " is " +
                             std::to_string(half));
    }
    return static_cast<std::uint64_t>(half);
  }

  /// Of faces and of strips.
  void read_triangles(const PlyElement& element) {
    const PlyProperty* const corners = corner_list(element);
    if (corners == nullptr && element.count > 0) {
      fail_format(path_, "element '" + element.name + "' needs one list vertex_indices");
    }
    const bool strips = element.name == "tristrips";
    mesh().triangles.reserve(strips ? 0 : static_cast<std::size_t>(element.count));
    for (std::int64_t n = 0; corners != nullptr && n < element.count; ++n) {
      values_->begin_item();
      for (const PlyProperty& property : element.properties) {
        if (&property != corners) {
          skip_property(property);
        } else if (strips) {
          read_strip(property, n);
        } else {
          read_face(property, n);
        }
      }
      values_->end_item();
    }
  }

  void read_face(const PlyProperty& property, std::int64_t n) {
    const std::int64_t length = values_->integer(*property.length_type);
    if (length < 3) {
      fail_format(path_,
                  "face " + std::to_string(n) + " has " + std::to_string(length) + " corners");
    }
    corners_.clear();
    for (std::int64_t c = 0; c < length; ++c) {
      corners_.push_back(corner(values_->integer(property.type), "face", n));
    }
    polygons_.add(mesh().triangles, corners_);
  }

  std::uint32_t corner(std::int64_t v, const char* what, std::int64_t n) const {
    if (v < 0 || v >= static_cast<std::int64_t>(result_.mesh.positions.size())) {
      fail_format(path_, std::string(what) + " " + std::to_string(n) + " refers to vertex " +
                             std::to_string(v) + " of " +
                             std::to_string(result_.mesh.positions.size()));
    }
    return static_cast<std::uint32_t>(v);
  }

  /// Each corner makes a triangle with the two before it, every other one the other way round; -1
  /// begins anew. Triangles with a corner twice are how strips go round a bend.
  void read_strip(const PlyProperty& property, std::int64_t n) {
    const std::int64_t length = values_->integer(*property.length_type);
    if (length < 0) {
      fail_format(path_,
                  "strip " + std::to_string(n) + " has the length " + std::to_string(length));
    }
    Triangle last{};
    std::int64_t since = 0;  // the last -1
    for (std::int64_t c = 0; c < length; ++c) {
      const std::int64_t v = values_->integer(property.type);
      if (v == -1) {
        since = 0;
        continue;
      }
      last = {last[1], last[2], corner(v, "strip", n)};
      const bool is_thin = last[0] == last[1] || last[1] == last[2] || last[2] == last[0];
      if (++since >= 3 && !is_thin) {
        const bool turned = since % 2 == 0;
        corners_ = {last[turned ? 1 : 0], last[turned ? 0 : 1], last[2]};
        polygons_.add(mesh().triangles, corners_);
      }
    }
  }

  void skip_property(const PlyProperty& property) {
    const std::int64_t length =
        property.length_type ? values_->integer(*property.length_type) : std::int64_t{1};
    if (length < 0) {
      fail_format(path_, "a list '" + property.name + "' of length " + std::to_string(length));
    }
    for (std::int64_t n = 0; n < length; ++n) {
      values_->skip(property.type);
    }
  }

  void skip_element(const PlyElement& element) {
    // Items without properties take no place; there may be 2^63 of them.
    for (std::int64_t n = 0; !element.properties.empty() && n < element.count; ++n) {
      values_->begin_item();
      for (const PlyProperty& property : element.properties) {
        skip_property(property);
      }
      values_->end_item();
    }
  }

  void note_left_out(const PlyElement& element) {
    if (element.count > 0) {
      add_warning(result_.warnings, path_,
                  "element " + in_quotes(element.name) + " left out, " +
                      count_of(static_cast<std::uint64_t>(element.count), "item"));
    }
  }

  const std::filesystem::path& path_;
  const PlyHeader& header_;
  std::optional<Values> values_;
  std::int64_t size_;
  bool vertices_seen_ = false;
  bool normals_are_finite_ = true;
  /// Elements of triangles that stand before the vertices, with the place of their values.
  std::vector<std::pair<const PlyElement*, Values>> postponed_;
  std::vector<std::uint32_t> corners_;
  Polygons polygons_;
  MeshFile result_;
  std::vector<int> scalars_of_;  ///< which of them a property of the vertices is; -1: none
};

}  // namespace

MeshFile read_ply(const InputFile& file) {
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

}  // namespace difmesh::detail
