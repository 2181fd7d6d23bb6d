#pragma once
/// \file box_union.hpp
/// How much of a cell boxes cover once and again, found by cutting it at all their faces.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "support/mesh_field.hpp"
#include "support/triangle_meshes.hpp"
#include "support/vec3.hpp"

namespace difmesh::test {

/// A box along the axes.
struct Box {
  Vec3 low;
  Vec3 high;
};

[[nodiscard]] inline TriangleMesh mesh_of(const std::vector<Box>& boxes) {
  TriangleMesh mesh;
  for (const Box& box : boxes) {
    mesh.append(box_mesh(box.low, box.high));
  }
  return mesh;
}

/// Shares of a cell covered at least once, and covered again, by cutting it at all faces.
struct Shares {
  double once = 0.0;
  double again = 0.0;
};
[[nodiscard]] inline Shares shares_of(const Grid& grid, const Index3& cell,
                                      const std::vector<Box>& boxes) {
  std::array<std::vector<double>, 3> cuts;
  for (std::size_t a = 0; a < 3; ++a) {
    const double low = low_of(grid, a, cell[a]);
    const double high = low_of(grid, a, cell[a] + 1);
    cuts[a] = {low, high};
    for (const Box& box : boxes) {
      cuts[a].push_back(std::clamp(box.low[a], low, high));
      cuts[a].push_back(std::clamp(box.high[a], low, high));
    }
    std::sort(cuts[a].begin(), cuts[a].end());
  }
  Shares shares;
  for (std::size_t k = 1; k < cuts[2].size(); ++k) {
    for (std::size_t j = 1; j < cuts[1].size(); ++j) {
      for (std::size_t i = 1; i < cuts[0].size(); ++i) {
        const std::array<std::size_t, 3> at{i, j, k};
        double volume = 1.0;
        std::array<double, 3> middle{};
        for (std::size_t a = 0; a < 3; ++a) {
          volume *= (cuts[a][at[a]] - cuts[a][at[a] - 1]) / grid.spacing[a];
          middle[a] = 0.5 * (cuts[a][at[a]] + cuts[a][at[a] - 1]);
        }
        const auto covers = [&](const Box& box) {
          bool inside = true;
          for (std::size_t a = 0; a < 3; ++a) {
            inside = inside && box.low[a] < middle[a] && middle[a] < box.high[a];
          }
          return inside;
        };
        const auto times = std::count_if(boxes.begin(), boxes.end(), covers);
        shares.once += times > 0 ? volume : 0.0;
        shares.again += times > 1 ? static_cast<double>(times - 1) * volume : 0.0;
      }
    }
  }
  return shares;
}

}  // namespace difmesh::test
