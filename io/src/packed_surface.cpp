#include "packed_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "difmesh/error.hpp"
#include "mesh_check.hpp"
#include "text.hpp"
#include "unit_normals.hpp"

namespace difmesh::detail {
namespace {

/// One part of a mesh: `vertices` names those of the whole mesh.
struct Part {
  std::vector<std::uint32_t> vertices;
  Array<Triangle> triangles;
};

/// Parts of at most so many vertices each, in the order of the triangles.
std::vector<Part> split(const Mesh& mesh, std::size_t most_vertices) {
  std::vector<Part> parts(1);
  std::vector<std::uint32_t> place(mesh.positions.size());  // in the last part that has the vertex
  std::vector<std::uint32_t> part_of(mesh.positions.size(), 0xFFFFFFFF);
  for (const Triangle& t : mesh.triangles) {
    const auto is_new = [&](std::uint32_t v) { return part_of[v] != parts.size() - 1; };
    const auto needed = static_cast<std::size_t>(std::count_if(t.begin(), t.end(), is_new));
    if (parts.back().vertices.size() + needed > most_vertices) {
      parts.emplace_back();
    }
    Triangle local{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = t[corner];
      if (is_new(v)) {
        part_of[v] = static_cast<std::uint32_t>(parts.size() - 1);
        place[v] = static_cast<std::uint32_t>(parts.back().vertices.size());
        parts.back().vertices.push_back(v);
      }
      local[corner] = place[v];
    }
    parts.back().triangles.push_back(local);
  }
  return parts;
}

/// Colours of 16 bits for 4096 shares, linear: the eye cannot tell more apart.
class ColorTable {
 public:
  ColorTable(const ColorBy& by, const std::array<double, 2>& range) : low_(range[0]) {
    const double extent = range[1] - range[0];
    scale_ = extent > 0.0 ? static_cast<double>(table_.size() - 1) / extent : 0.0;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(table_.size() - 1);
      const Color color = to_linear(color_of(by.map, share));
      for (std::size_t c = 0; c < 3; ++c) {
        table_[i][c] = static_cast<std::uint16_t>(std::lround(color[c] * 65535.0));
      }
    }
  }
  [[nodiscard]] const std::array<std::uint16_t, 3>& operator()(double value) const {
    const auto last = static_cast<double>(table_.size() - 1);
    // A range without extent has one colour, that of the middle.
    const double place = scale_ > 0.0 ? (value - low_) * scale_ : last / 2.0;
    return table_[static_cast<std::size_t>(std::clamp(place, 0.0, last) + 0.5)];
  }

 private:
  double low_;
  double scale_;
  std::array<std::array<std::uint16_t, 3>, 4096> table_{};
};

std::array<double, 2> range_of(const Array<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

std::array<double, 2> color_range_of(const ColorBy& by, const std::array<double, 2>& range) {
  if (by.range) {
    return *by.range;
  }
  if (by.map == ColorMap::cool_warm) {
    const double size = std::max(std::abs(range[0]), std::abs(range[1]));
    return {-size, size};
  }
  return range;
}

class Packer {
 public:
  explicit Packer(const PackRequest& request)
      : request_(request),
        mesh_(request.mesh),
        options_(request.options),
        scalars_(written_scalars(request.mesh, request.options)) {}

  PackedSurface pack() {
    surface_.origin = request_.origin;
    check_extent();
    if (options_.normals) {
      normals_ = unit_normals(mesh_);
    }
    for (const VertexScalar& scalar : scalars_) {
      surface_.ranges.push_back({scalar.name, range_of(scalar.values)});
    }
    if (options_.color) {
      surface_.color_range =
          color_range_of(*options_.color, surface_.ranges[colored_scalars()].ends);
    }
    if (mesh_.positions.size() <= static_cast<std::size_t>(options_.most_vertices)) {
      std::vector<std::uint32_t> all(mesh_.positions.size());
      std::iota(all.begin(), all.end(), 0U);
      surface_.primitives.push_back(pack_part(all, mesh_.triangles, false));
      return std::move(surface_);
    }
    std::vector<Part> parts = split(mesh_, static_cast<std::size_t>(options_.most_vertices));
    for (Part& part : parts) {
      surface_.primitives.push_back(
          pack_part(part.vertices, std::move(part.triangles), parts.size() > 1));
    }
    return std::move(surface_);
  }

 private:
  [[nodiscard]] std::size_t colored_scalars() const {
    const auto found = std::ranges::find(scalars_, options_.color->scalars, &VertexScalar::name);
    return static_cast<std::size_t>(found - scalars_.begin());
  }

  /// float32 has numbers from 1e-38 to 3e38; a mesh beyond would come out flat or infinite.
  void check_extent() const {
    double largest = 0.0;
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double local = std::abs(mesh_.positions[v][axis] - request_.origin[axis]);
        if (!(local <= std::numeric_limits<float>::max())) {
          fail_write(ErrorCode::invalid_value, request_.path,
                     "the position of vertex " + std::to_string(v) + " is " + to_text(local) +
                         " from the local origin, beyond the range of float32");
        }
        largest = std::max(largest, local);
      }
    }
    if (largest > 0.0 && largest < 1e-30) {
      fail_write(ErrorCode::invalid_value, request_.path,
                 "the mesh is " + to_text(largest) +
                     " in size, below what float32 can resolve; use a larger unit");
    }
  }

  PackedPrimitive pack_part(const std::vector<std::uint32_t>& vertices, Array<Triangle> triangles,
                            bool with_index) {
    PackedPrimitive primitive;
    primitive.vertices = vertices.size();
    primitive.triangles = std::move(triangles);
    auto& attributes = primitive.attributes;
    attributes.push_back(float_vectors("POSITION", vertices, mesh_.positions, request_.origin));
    if (options_.normals) {
      attributes.push_back(float_vectors("NORMAL", vertices, normals_, {0, 0, 0}));
    }
    for (const VertexScalar& scalar : scalars_) {
      PackedAttribute attribute{.semantic = semantic_of(scalar.name), .scalars = scalar.name};
      attribute.floats.reserve(vertices.size());
      for (const std::uint32_t v : vertices) {
        attribute.floats.push_back(static_cast<float>(scalar.values[v]));
      }
      attributes.push_back(std::move(attribute));
    }
    if (options_.edge_ids && !mesh_.edge_ids.empty()) {
      attributes.push_back(digits("_EDGE_ID", 4, vertices, mesh_.edge_ids.data()));
    }
    if (options_.color) {
      attributes.push_back(colors(vertices));
    }
    if (with_index) {
      attributes.push_back(digits("_VERTEX", 2, vertices, nullptr));
    }
    return primitive;
  }

  static PackedAttribute float_vectors(const char* semantic,
                                       const std::vector<std::uint32_t>& vertices,
                                       const Array<Vec3>& vectors, const Vec3& origin) {
    PackedAttribute attribute{.semantic = semantic, .components = 3};
    attribute.floats.resize(3 * vertices.size());
    float* place = attribute.floats.data();
    for (const std::uint32_t v : vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        *place++ = static_cast<float>(vectors[v][axis] - origin[axis]);
      }
    }
    return attribute;
  }

  /// Whole numbers to the base 65536, lowest digit first; the vertices' indices for no numbers.
  static PackedAttribute digits(const char* semantic, std::size_t count,
                                const std::vector<std::uint32_t>& vertices,
                                const std::uint64_t* numbers) {
    PackedAttribute attribute{.semantic = semantic, .components = count};
    attribute.words.reserve(count * vertices.size());
    for (const std::uint32_t v : vertices) {
      std::uint64_t number = numbers != nullptr ? numbers[v] : v;
      for (std::size_t digit = 0; digit < count; ++digit) {
        attribute.words.push_back(static_cast<std::uint16_t>(number & 0xFFFFU));
        number >>= 16U;
      }
    }
    return attribute;
  }

  [[nodiscard]] PackedAttribute colors(const std::vector<std::uint32_t>& vertices) const {
    const ColorTable table(*options_.color, *surface_.color_range);
    const Array<double>& values = scalars_[colored_scalars()].values;
    PackedAttribute attribute{.semantic = "COLOR_0", .components = 4};
    attribute.words.reserve(4 * vertices.size());
    for (const std::uint32_t v : vertices) {
      const auto& color = table(values[v]);
      attribute.words.insert(attribute.words.end(), color.begin(), color.end());
      attribute.words.push_back(0xFFFF);
    }
    return attribute;
  }

  const PackRequest& request_;
  const Mesh& mesh_;
  const WriteMeshOptions& options_;
  std::span<const VertexScalar> scalars_;
  Array<Vec3> normals_;
  PackedSurface surface_;
};

}  // namespace

Vec3 centre_of(const Array<Vec3>& positions) {
  if (positions.empty()) {
    return {0, 0, 0};
  }
  Vec3 low = positions[0];
  Vec3 high = positions[0];
  for (const Vec3& position : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], position[axis]);
      high[axis] = std::max(high[axis], position[axis]);
    }
  }
  // Halved first: the sum may overflow.
  return {0.5 * low[0] + 0.5 * high[0], 0.5 * low[1] + 0.5 * high[1], 0.5 * low[2] + 0.5 * high[2]};
}

std::string semantic_of(const std::string& name) {
  std::string semantic = "_";
  for (const char c : name) {
    semantic += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return semantic;
}

PackedSurface pack(const PackRequest& request) {
  return Packer(request).pack();
}

}  // namespace difmesh::detail
