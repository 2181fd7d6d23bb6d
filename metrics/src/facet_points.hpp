#pragma once
// Where a facet is measured.

#include <array>
#include <cstdint>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// Weights of the rule for triangles that is exact for cubics: of each corner, each edge mid-point,
/// and the centroid.
inline constexpr double kCornerShare = 1.0 / 20.0;
inline constexpr double kMiddleShare = 2.0 / 15.0;
inline constexpr double kCentroidShare = 9.0 / 20.0;

/// Points of a triangle that is cut into parts² equal ones: their corners, edge mid-points and
/// centroids, less the triangle's own corners. point(weights, share) gets the barycentric weights
/// of each and its weight in the rule put together from the parts; the triangle's own corners have
/// kCornerShare / parts² each in it.
template <class Point>
void for_each_facet_point(std::int64_t parts, const Point& point) {
  const double part_share = 1.0 / static_cast<double>(parts * parts);
  const std::int64_t steps = 2 * parts;
  const double step = 1.0 / static_cast<double>(steps);
  const auto weights = [](double i, double j, double k, double unit) {
    return Vec3{i * unit, j * unit, k * unit};
  };
  for (std::int64_t i = 0; i <= steps; ++i) {
    for (std::int64_t j = 0; j <= steps - i; ++j) {
      const std::int64_t k = steps - i - j;
      const int sides = (i == 0 ? 1 : 0) + (j == 0 ? 1 : 0) + (k == 0 ? 1 : 0);
      if (sides == 2) {
        continue;
      }
      // Six parts meet at a corner and two along an edge, half as many on a side of the triangle.
      const bool corner = i % 2 == 0 && j % 2 == 0;
      const double share = (corner ? 6.0 * kCornerShare : 2.0 * kMiddleShare) * part_share;
      point(weights(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k), step),
            sides == 1 ? 0.5 * share : share);
    }
  }
  // In units of parts, one that stands like the triangle has its centroid at (i, j, k) + 1/3 each,
  // with i + j + k = parts - 1; one that stands on its head + 2/3, with parts - 2.
  const double third = 1.0 / (3.0 * static_cast<double>(parts));
  for (const std::int64_t head : {std::int64_t{1}, std::int64_t{2}}) {
    for (std::int64_t i = 0; i <= parts - head; ++i) {
      for (std::int64_t j = 0; j <= parts - head - i; ++j) {
        const std::int64_t k = parts - head - i - j;
        point(weights(static_cast<double>(3 * i + head), static_cast<double>(3 * j + head),
                      static_cast<double>(3 * k + head), third),
              kCentroidShare * part_share);
      }
    }
  }
}

}  // namespace difmesh::detail
