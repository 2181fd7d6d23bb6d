#include <algorithm>
#include <cmath>
#include <difmesh/difmesh.hpp>
#include <iostream>
#include <vector>

int main() {
  const int n = 64;
  std::vector<double> fractions;  // a ball of radius 20 in 64 x 64 x 64 cells of side 1, x fastest
  for (int i = 0; i < n * n * n; ++i) {
    const double r = std::hypot(i % n - 31.5, i / n % n - 31.5, i / n / n - 31.5);
    fractions.push_back(std::clamp(20.5 - r, 0.0, 1.0));
  }
  const difmesh::Grid grid{.dims = {n, n, n}};
  const auto field = difmesh::FieldView::x_fastest(fractions.data(), grid.dims);
  const auto [mesh, report] = difmesh::reconstruct(field, grid);
  std::cout << mesh.positions.size() << " vertices, " << mesh.triangles.size() << " triangles\n"
            << "volume enclosed: " << report.enclosed_volume
            << ", in the cells: " << report.fraction_volume << '\n';
}
