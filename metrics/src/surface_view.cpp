#include "surface_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "difmesh/error.hpp"

namespace difmesh::detail {
namespace {

// Scales beyond have no inverse in float64.
constexpr int kGreatestExponent = 1000;
// A flat box may be far from the origin along its missing axis: coordinates keep below 2^this.
constexpr int kRoomForOffset = 500;

[[noreturn]] void throw_invalid(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, "distance: " + message);
}

}  // namespace

Box box_of(std::span<const Vec3> positions) noexcept {
  Box box{positions[0], positions[0]};
  for (const Vec3& p : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

double scale_of(const Box& a, const Box& b) noexcept {
  double half_side = 0.0;
  double furthest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = std::min(a.low[axis], b.low[axis]);
    const double high = std::max(a.high[axis], b.high[axis]);
    half_side = std::max(half_side, 0.5 * high - 0.5 * low);
    furthest = std::max({furthest, std::abs(low), std::abs(high)});
  }
  if (half_side == 0.0) {
    return 1.0;
  }
  const int exponent = std::max(std::ilogb(half_side), std::ilogb(furthest) - kRoomForOffset);
  return std::ldexp(1.0, -std::clamp(exponent, -kGreatestExponent, kGreatestExponent));
}

void check_surface(const SurfaceView& surface) {
  const std::string name = surface.name;
  if (surface.triangles.empty()) {
    throw_invalid("the " + name + " is empty: it has no triangles");
  }
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    const Vec3& p = surface.positions[v];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
      throw_invalid("the position of vertex " + std::to_string(v) + " of the " + name +
                    " is not finite");
    }
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (const std::uint32_t v : surface.triangles[t]) {
      if (v >= surface.positions.size()) {
        throw_invalid("triangle " + std::to_string(t) + " of the " + name + " refers to vertex " +
                      std::to_string(v) + ", but there are " +
                      std::to_string(surface.positions.size()) + " vertices");
      }
    }
  }
}

}  // namespace difmesh::detail
