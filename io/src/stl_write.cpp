#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "difmesh/error.hpp"
#include "format_part.hpp"
#include "mesh_check.hpp"
#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

constexpr std::size_t kHeader = 80;
constexpr std::size_t kRecord = 50;  // normal, three corners, two bytes of anything
// Of the mean edge, by which coordinates may be off without a warning: as much as second-order
// vertices are on coarse grids.
constexpr double kCoarse = 0.01;
// Readers take a file that starts with "solid" for text.
constexpr std::string_view kTitle = "difmesh: binary STL";

/// Bytes of STL: little endian whatever the machine.
class Bytes {
 public:
  explicit Bytes(char* place) : place_(place) {}

  void put(std::uint32_t number) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      *place_++ = static_cast<char>(number >> shift & 0xFFU);
    }
  }
  void put(const Vec3& vector) {
    for (const double component : vector) {
      put(std::bit_cast<std::uint32_t>(static_cast<float>(component)));
    }
  }

 private:
  char* place_;
};

/// Unit normal by the right-hand rule, 0 for a triangle without area.
Vec3 facet_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Vec3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  Vec3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::hypot(n[0], n[1], n[2]);
  for (double& component : n) {
    component = length > 0.0 ? component / length : 0.0;
  }
  return n;
}

/// Whether a triangle's area is not exactly 0, as measure() sees it.
bool has_area(const std::array<Vec3, 3>& corners) {
  Vec3 u{};
  Vec3 v{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = corners[1][axis] - corners[0][axis];
    v[axis] = corners[2][axis] - corners[0][axis];
  }
  return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

double length_between(const Vec3& from, const Vec3& to) {
  const Vec3 edge{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  return std::sqrt(edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2]);
}

class StlEncoder : public MeshEncoder {
 public:
  explicit StlEncoder(EncoderRequest request) : request_(std::move(request)) {}

  [[nodiscard]] std::size_t vertex_sections() const override { return 0; }

  void header(ByteOutput& output, const MeshCounts& counts) override {
    check_count(counts.triangles);
    std::array<char, kHeader + 4> bytes{};
    kTitle.copy(bytes.data(), kHeader);
    Bytes(bytes.data() + kHeader).put(static_cast<std::uint32_t>(counts.triangles));
    output.write(bytes.data(), bytes.size());
  }

  void vertices(ByteOutput&, std::size_t, const MeshPortion&) override {}

  void triangles(ByteOutput& output, const MeshPortion& portion) override {
    triangles_ += portion.triangles.size();
    check_count(triangles_);
    std::span<const Vec3> positions = portion.positions;
    if (!request_.is_whole) {
      positions_.insert(positions_.end(), positions.begin(), positions.end());
      positions = positions_;
    }
    for (const Triangle& triangle : portion.triangles) {
      const std::array<Vec3, 3> corners{positions[triangle[0]], positions[triangle[1]],
                                        positions[triangle[2]]};
      std::array<char, kRecord> record{};
      Bytes bytes(record.data());
      bytes.put(facet_normal(corners[0], corners[1], corners[2]));
      for (const Vec3& corner : corners) {
        bytes.put(corner);
      }
      output.write(record.data(), record.size());
    }
    note_rounding(positions, portion.triangles);
  }

  void complete(MeshFileReport& report) const override {
    report.vertices = 3 * report.triangles;
    report.position_error = position_error_;
    report.collapsed_triangles = collapsed_triangles_;
    warn(report);
  }

 private:
  /// Of rounding that shows.
  void warn(MeshFileReport& report) const {
    const double edge =
        edges_ / (3.0 * static_cast<double>(std::max<std::uint64_t>(1, triangles_)));
    if (!(position_error_ > kCoarse * edge) && collapsed_triangles_ == 0) {
      return;
    }
    std::string matter = "coordinates are off by up to " + to_text(position_error_) +
                         " in float32, where edges are " + to_text(edge) + " long on average";
    if (collapsed_triangles_ > 0) {
      matter += ", and " + std::to_string(collapsed_triangles_) + " of " +
                count_of(triangles_, "triangle") + " collapse";
    }
    add_warning(report.warnings, request_.path, matter + "; PLY, OBJ and OFF keep all digits");
  }

  void check_count(std::uint64_t triangles) const {
    if (triangles > std::numeric_limits<std::int32_t>::max()) {
      fail_write(ErrorCode::too_large, request_.path,
                 std::to_string(triangles) + " triangles are too many for STL");
    }
  }

  /// What float32 does to the triangles. In a loop of its own, as the compiler keeps the numbers of
  /// this one and those of the writing in registers then.
  void note_rounding(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    double position_error = position_error_;
    double edges = edges_;
    std::int64_t collapsed = 0;
    for (const Triangle& triangle : triangles) {
      std::array<Vec3, 3> exact{};
      std::array<Vec3, 3> rounded{};
      for (std::size_t c = 0; c < 3; ++c) {
        exact[c] = positions[triangle[c]];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          rounded[c][axis] = static_cast<double>(static_cast<float>(exact[c][axis]));
          position_error = std::max(position_error, std::abs(exact[c][axis] - rounded[c][axis]));
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        edges += length_between(exact[c], exact[(c + 1) % 3]);
      }
      collapsed += has_area(exact) && !has_area(rounded) ? 1 : 0;
    }
    position_error_ = position_error;
    edges_ = edges;
    collapsed_triangles_ += collapsed;
  }

  EncoderRequest request_;
  Array<Vec3> positions_;  ///< so far; empty where the mesh comes as one portion
  std::uint64_t triangles_ = 0;
  double position_error_ = 0.0;
  double edges_ = 0.0;  ///< their lengths together
  std::int64_t collapsed_triangles_ = 0;
};

}  // namespace

constinit const FormatPart stl_format{
    .facts = {.extension = ".stl", .name = "STL"},
    .float32_positions = true,
    .read = read_open<read_stl>,
    .encoder = make_encoder<StlEncoder>,
};

}  // namespace difmesh::detail
