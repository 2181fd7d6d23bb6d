#include "mesh/vertex_patch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/vector3.hpp"

namespace difmesh::detail {
namespace {

// Twice what a patch has coefficients: half a neighbourhood of two rings, as on a boundary, has
// less.
constexpr std::size_t kEnoughNeighbours = 12;
constexpr int kMostExtraRings = 4;

}  // namespace

PatchFit VertexPatch::operator()(std::uint32_t vertex) {
  is_widened_ = false;
  walk_.start(vertex);
  for (int ring = 0; ring < surface_.rings; ++ring) {
    walk_.add_ring();
  }
  const Vec3& area = surface_.areas[vertex];
  const double size = std::max({std::abs(area[0]), std::abs(area[1]), std::abs(area[2])});
  if (!(size > 0.0) || !std::isfinite(size)) {
    return {};
  }
  const Vec3 normal = unit({area[0] / size, area[1] / size, area[2] / size});
  for (int extra = 0;; ++extra) {
    if (walk_.vertices().size() > kEnoughNeighbours) {
      const PatchFit fitted = fit(normal);
      if (fitted.is_determined) {
        return fitted;
      }
    }
    if (extra == kMostExtraRings || !walk_.add_ring()) {
      return fit(normal);
    }
    is_widened_ = true;
  }
}

PatchFit VertexPatch::fit(const Vec3& normal) {
  points_.assign(surface_.positions, walk_.vertices());
  const double unit = points_.unit();
  if (!(unit > 0.0) || !std::isfinite(unit)) {
    return {};
  }
  PatchFit fitted = fit_patch(points_.points(), normal);
  fitted.mean /= unit;
  fitted.half_difference /= unit;
  fitted.height *= unit;
  fitted.is_determined =
      fitted.is_determined && std::isfinite(fitted.mean) && std::isfinite(fitted.half_difference);
  return fitted;
}

}  // namespace difmesh::detail
