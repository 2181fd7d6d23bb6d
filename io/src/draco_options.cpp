// The part of compression that needs no Draco: options and their meaning.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "difmesh/error.hpp"
#include "draco_codec.hpp"
#include "mesh_check.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr int kMostBits = 24;        // float32 has no more digits
constexpr int kMostChosenBits = 21;  // beyond, float32's own roundings outweigh half a step
constexpr double kShareOfCell = 1e-3;

double mean_edge_length(const Mesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3& a = mesh.positions[t[corner]];
      const Vec3& b = mesh.positions[t[(corner + 1) % 3]];
      sum += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }
  }
  return mesh.triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

double longest_side(const Array<Vec3>& positions) {
  double longest = 0.0;
  for (std::size_t axis = 0; axis < 3 && !positions.empty(); ++axis) {
    const auto [low, high] =
        std::minmax_element(positions.begin(), positions.end(),
                            [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    longest = std::max(longest, (*high)[axis] - (*low)[axis]);
  }
  return longest;
}

}  // namespace

void check_draco(const std::filesystem::path& path, const DracoOptions& options) {
  const auto check = [&](const char* name, int value, int least, int most) {
    if (value < least || value > most) {
      fail_write(ErrorCode::invalid_argument, path,
                 std::string(name) + " is " + std::to_string(value) + ", not " +
                     std::to_string(least) + " to " + std::to_string(most));
    }
  };
  check("position_bits", options.position_bits, 0, kMostBits);
  check("normal_bits", options.normal_bits, 2, kMostBits);
  check("generic_bits", options.generic_bits, 1, kMostBits);
  check("speed", options.speed, 0, 10);
  if (!(options.cell_size >= 0.0) || !std::isfinite(options.cell_size)) {
    fail_write(ErrorCode::invalid_argument, path,
               "cell_size is " + to_text(options.cell_size) + ", no length");
  }
}

int position_bits_of(const Mesh& mesh, const DracoOptions& options) {
  if (options.position_bits > 0) {
    return options.position_bits;
  }
  const double cell = options.cell_size > 0.0 ? options.cell_size : mean_edge_length(mesh);
  const double half_steps = longest_side(mesh.positions) / (2.0 * kShareOfCell * cell);
  int bits = 1;
  while (bits < kMostChosenBits && !(std::exp2(bits) - 1.0 >= half_steps)) {
    ++bits;
  }
  return bits;
}

}  // namespace difmesh::detail
