#include "planes/plane_fit.hpp"

#include "planes/kernels.hpp"

namespace difmesh::detail {

Vec3 fit_to_neighbours(const NeighbourFractions& hood, const Vec3& start) {
  FitTask task{};
  task.centre = hood.fraction[1][1][1];
  for (int n = 0; n < 27; ++n) {
    const int i = n % 3;
    const int j = n / 3 % 3;
    const int k = n / 9;
    if (n == 13 || !hood.is_there[k][j][i]) {
      continue;
    }
    const int place = task.count++;
    task.fraction[place] = hood.fraction[k][j][i];
    task.shift[0][place] = i - 1;
    task.shift[1][place] = j - 1;
    task.shift[2][place] = k - 1;
  }
  for (std::size_t t = 0; t < 3; ++t) {
    task.m[t] = start[t];
  }
  kernels().fit_plane_to_neighbours(task);
  return {task.m[0], task.m[1], task.m[2]};
}

}  // namespace difmesh::detail
