#pragma once
// VTK's contours, smoothing and curvature. Apart from the rest because VTK 9.1's headers are not
// C++20.

#include <array>
#include <cstdint>
#include <vector>

namespace difmesh::paper {

struct VtkSurface {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// vtkFlyingEdges3D at 1/2 of a field, x fastest, whose first value is at `first` and the next ones
/// `spacing` apart; with triangles counter-clockwise seen from lower values.
/// \param field not changed, though VTK asks for what it could change
[[nodiscard]] VtkSurface vtk_contour(double* field, const std::array<std::int64_t, 3>& dims,
                                     const std::array<double, 3>& first, double spacing);

/// vtkWindowedSincPolyDataFilter with its defaults, but for the number of iterations.
[[nodiscard]] VtkSurface vtk_windowed_sinc(const VtkSurface& surface, int iterations);

/// vtkCurvatures: mean curvature of each vertex.
[[nodiscard]] std::vector<double> vtk_mean_curvatures(const VtkSurface& surface);

}  // namespace difmesh::paper
