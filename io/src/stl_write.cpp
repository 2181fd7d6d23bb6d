#include <array>
#include <bit>
#include <cmath>
#include <string_view>

#include "mesh_formats.hpp"

namespace difmesh::detail {
namespace {

constexpr std::size_t kHeader = 80;
constexpr std::size_t kRecord = 50;  // normal, three corners, two bytes of anything
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

}  // namespace

void write_stl(AtomicFile& file, const Mesh& mesh) {
  std::array<char, kHeader + 4> header{};
  kTitle.copy(header.data(), kHeader);
  Bytes(header.data() + kHeader).put(static_cast<std::uint32_t>(mesh.triangles.size()));
  file.write(header.data(), header.size());
  for (const Triangle& triangle : mesh.triangles) {
    std::array<char, kRecord> record{};
    Bytes bytes(record.data());
    bytes.put(facet_normal(mesh.positions[triangle[0]], mesh.positions[triangle[1]],
                           mesh.positions[triangle[2]]));
    for (const std::uint32_t v : triangle) {
      bytes.put(mesh.positions[v]);
    }
    file.write(record.data(), record.size());
  }
}

}  // namespace difmesh::detail
