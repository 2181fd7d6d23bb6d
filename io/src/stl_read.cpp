#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "mesh_formats.hpp"
#include "scanner.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr std::size_t kHeader = 84;  // 80 bytes of anything and the number of triangles
constexpr std::size_t kRecord = 50;  // normal, three corners, two bytes of anything

/// Gives equal positions equal indices, in the order of their first appearance. A hash table with
/// open addresses, at most half full.
class Welder {
 public:
  explicit Welder(const std::filesystem::path& path) : path_(path), slots_(1024, kFree) {}

  std::uint32_t index_of(Vec3 position) {
    for (double& coordinate : position) {
      coordinate += 0.0;  // -0 equals 0 but has other bits
    }
    std::size_t slot = hash(position) & (slots_.size() - 1);
    while (slots_[slot] != kFree) {
      if (positions_[slots_[slot]] == position) {
        return slots_[slot];
      }
      slot = (slot + 1) & (slots_.size() - 1);
    }
    if (positions_.size() >= static_cast<std::size_t>(kMostVertices)) {
      throw Error(ErrorCode::too_large,
                  quoted(path_) + ": more vertices than 32-bit indices can name");
    }
    slots_[slot] = static_cast<std::uint32_t>(positions_.size());
    positions_.push_back(position);
    if (2 * positions_.size() > slots_.size()) {
      grow();
    }
    return static_cast<std::uint32_t>(positions_.size() - 1);
  }

  Array<Vec3> take() { return std::move(positions_); }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFF;

  static std::size_t hash(const Vec3& position) {
    std::uint64_t bits = 0;
    for (const double coordinate : position) {
      // Multiplication and shift of 64-bit words mix the bits well enough for points in space.
      bits = (bits ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9E3779B97F4A7C15U;
      bits ^= bits >> 29U;
    }
    return static_cast<std::size_t>(bits);
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kFree);
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      std::size_t slot = hash(positions_[v]) & (slots_.size() - 1);
      while (slots_[slot] != kFree) {
        slot = (slot + 1) & (slots_.size() - 1);
      }
      slots_[slot] = static_cast<std::uint32_t>(v);
    }
  }

  const std::filesystem::path& path_;
  std::vector<std::uint32_t> slots_;
  Array<Vec3> positions_;
};

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    value |= std::uint32_t{static_cast<unsigned char>(bytes[n])} << (8 * n);
  }
  return value;
}

Mesh read_binary(const std::filesystem::path& path, std::string_view bytes) {
  const std::size_t count = (bytes.size() - kHeader) / kRecord;
  Mesh mesh;
  mesh.triangles.resize(count);
  Welder welder(path);
  for (std::size_t t = 0; t < count; ++t) {
    const char* const corners = bytes.data() + kHeader + t * kRecord + 12;
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3 position{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        position[axis] = std::bit_cast<float>(little_endian(corners + 12 * c + 4 * axis));
        if (!std::isfinite(position[axis])) {
          fail_format(path, "triangle " + std::to_string(t) + " has a corner that is not finite");
        }
      }
      mesh.triangles[t][c] = welder.index_of(position);
    }
  }
  mesh.positions = welder.take();
  return mesh;
}

/// Reads the lines `vertex x y z`, three to an `outer loop`; normals and names do not count.
Mesh read_text(const std::filesystem::path& path, std::string_view text) {
  Scanner lines(path, text, {});
  Mesh mesh;
  Welder welder(path);
  std::vector<std::uint32_t> corners;
  bool ended = false;
  while (lines.next_line()) {
    const std::string keyword = lower_case(lines.word());
    if (keyword == "vertex") {
      const double x = lines.number("a coordinate");
      const double y = lines.number("a coordinate");
      corners.push_back(welder.index_of({x, y, lines.number("a coordinate")}));
    } else if (keyword == "endloop") {
      if (corners.size() != 3) {
        lines.fail("a facet with " + std::to_string(corners.size()) + " corners");
      }
      append_fan(mesh.triangles, corners);
      corners.clear();
    } else if (keyword != "solid" && keyword != "facet" && keyword != "outer" &&
               keyword != "endfacet" && keyword != "endsolid") {
      lines.fail(in_quotes(keyword.substr(0, 40)) + " is no word of STL");
    }
    ended = keyword == "endsolid";
  }
  if (!ended) {
    fail_format(path, "truncated: no endsolid ends the STL text");
  }
  mesh.positions = welder.take();
  return mesh;
}

}  // namespace

ScalarMesh read_stl(const InputFile& file) {
  const Array<char> bytes = file.read_text(0, file.size());
  const std::string_view text(bytes.data(), bytes.size());
  // Binary files may start with "solid" too, so their size decides.
  const std::uint64_t count = text.size() >= kHeader ? little_endian(text.data() + 80) : 0;
  if (text.size() >= kHeader && text.size() == kHeader + kRecord * count) {
    return {read_binary(file.path(), text), {}};
  }
  const std::string_view plain = text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  const std::string_view start = trimmed(plain.substr(0, 80));
  if (lower_case(start.substr(0, 5)) == "solid") {
    return {read_text(file.path(), plain), {}};
  }
  if (text.size() < kHeader) {
    fail_format(file.path(), "no STL file: " + std::to_string(text.size()) +
                                 " bytes that do not start with solid");
  }
  fail_format(file.path(), "truncated or no STL file: " + std::to_string(count) +
                               " triangles are " + std::to_string(kHeader + kRecord * count) +
                               " bytes, " + std::to_string(text.size()) + " found");
}

}  // namespace difmesh::detail
