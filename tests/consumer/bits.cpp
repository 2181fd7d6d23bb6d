// Prints what the library computes to the last bit: builds of every kind have to print the same.
// The fields are made by integers, so that nothing depends on how this file is compiled.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <difmesh/difmesh.hpp>
#include <span>
#include <vector>

namespace {

/// FNV-1a (Fowler, Noll, Vo) over the bytes of arrays.
class Checksum {
 public:
  template <class Range>
  void add(const Range& range) {
    for (const std::byte byte : std::as_bytes(std::span(range))) {
      value_ = (value_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3U;
    }
  }
  [[nodiscard]] unsigned long long value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

/// All combinations of neighbours, in numbers that have no order.
std::vector<double> noise(const difmesh::Grid& grid) {
  std::vector<double> fractions(static_cast<std::size_t>(grid.cell_count()));
  std::uint64_t state = 1;
  for (double& fraction : fractions) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    fraction = static_cast<double>(state >> 48U) / 65536.0;
  }
  return fractions;
}

/// A ball about the middle of the grid whose fractions fall from 1 to 0 across its surface.
std::vector<double> ball(const difmesh::Grid& grid) {
  std::vector<double> fractions;
  const std::int64_t radius = *std::ranges::min_element(grid.dims) - 8;
  for (std::int64_t n = 0; n < grid.cell_count(); ++n) {
    const std::int64_t x = 2 * (n % grid.dims[0]) + 1 - grid.dims[0];
    const std::int64_t y = 2 * (n / grid.dims[0] % grid.dims[1]) + 1 - grid.dims[1];
    const std::int64_t z = 2 * (n / grid.dims[0] / grid.dims[1]) + 1 - grid.dims[2];
    const std::int64_t share = 2 * radius + radius * radius - x * x - y * y - z * z;
    const std::int64_t full = 4 * radius;
    fractions.push_back(static_cast<double>(std::clamp(share, std::int64_t{0}, full)) /
                        static_cast<double>(full));
  }
  return fractions;
}

void print_mesh(const char* name, const difmesh::Mesh& mesh) {
  Checksum checksum;
  checksum.add(mesh.positions);
  checksum.add(mesh.triangles);
  checksum.add(mesh.normals);
  checksum.add(mesh.edge_ids);
  difmesh::Vec3 sum{0.0, 0.0, 0.0};
  for (const difmesh::Vec3& position : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum[axis] += position[axis];
    }
  }
  std::printf("%s: %zu vertices, %zu triangles, sums of positions %a %a %a, checksum %016llx\n",
              name, mesh.positions.size(), mesh.triangles.size(), sum[0], sum[1], sum[2],
              checksum.value());
}

void print_field(const char* name, const difmesh::Array<double>& fractions) {
  Checksum checksum;
  checksum.add(fractions);
  double sum = 0.0;
  for (const double fraction : fractions) {
    sum += fraction;
  }
  std::printf("%s: %zu cells, sum %a, checksum %016llx\n", name, fractions.size(), sum,
              checksum.value());
}

}  // namespace

int main(int argc, char** argv) {
  using difmesh::Side;
  difmesh::Options options;
  options.threads = argc > 1 ? std::atoi(argv[1]) : 0;
  options.vertex_normals = true;
  options.edge_ids = true;

  difmesh::Grid grid{.dims = {61, 49, 47}, .origin = {0.1, -7.0, 3.0}, .spacing = {0.3, 0.5, 0.4}};
  const auto whole = ball(grid);
  const auto round =
      difmesh::reconstruct(difmesh::FieldView::x_fastest(whole.data(), grid.dims), grid, options);
  print_mesh("ball", round.mesh);

  difmesh::FractionsFromMeshOptions back;
  back.threads = options.threads;
  const auto again = fractions_from_mesh(grid, round.mesh.positions, round.mesh.triangles, back);
  print_field("fractions of its mesh", again.fractions);

  grid.dims = {23, 29, 31};
  const auto random = noise(grid);
  const auto field = difmesh::FieldView::x_fastest(random.data(), grid.dims);
  print_mesh("noise", difmesh::reconstruct(field, grid, options).mesh);
  options.boundary = {Side::periodic, Side::periodic, Side::mirror,
                      Side::empty,    Side::full,     Side::open};
  options.normals = difmesh::Normals::myc;
  print_mesh("noise, other sides", difmesh::reconstruct(field, grid, options).mesh);
  options.placement = difmesh::Placement::manson;
  print_mesh("noise, other vertices", difmesh::reconstruct(field, grid, options).mesh);
}
