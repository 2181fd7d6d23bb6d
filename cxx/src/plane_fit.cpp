#include "plane_fit.hpp"

#include "kernels.hpp"

namespace difmesh::detail {

Vec3 fit_to_neighbours(const NeighbourFractions& hood, const Vec3& start) {
  FitTask task{};
  int n = 0;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i, ++n) {
        task.fraction[n] = hood.fraction[k][j][i];
        task.is_there[n] = hood.is_there[k][j][i] ? 1.0 : 0.0;
      }
    }
  }
  for (std::size_t t = 0; t < 3; ++t) {
    task.m[t] = start[t];
  }
  kernels().fit_plane_to_neighbours(task);
  return {task.m[0], task.m[1], task.m[2]};
}

}  // namespace difmesh::detail
