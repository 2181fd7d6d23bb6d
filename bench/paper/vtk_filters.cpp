#include "vtk_filters.hpp"

#include <vtkCellArray.h>
#include <vtkCurvatures.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <cstddef>

namespace difmesh::paper {
namespace {

VtkSurface from_vtk(vtkPolyData& data) {
  VtkSurface surface;
  const vtkIdType points = data.GetNumberOfPoints();
  surface.positions.resize(static_cast<std::size_t>(points));
  for (vtkIdType p = 0; p < points; ++p) {
    data.GetPoint(p, surface.positions[static_cast<std::size_t>(p)].data());
  }
  vtkCellArray& cells = *data.GetPolys();
  vtkNew<vtkIdList> corners;
  for (cells.InitTraversal(); cells.GetNextCell(corners) != 0;) {
    surface.triangles.push_back({static_cast<std::uint32_t>(corners->GetId(0)),
                                 static_cast<std::uint32_t>(corners->GetId(1)),
                                 static_cast<std::uint32_t>(corners->GetId(2))});
  }
  return surface;
}

vtkSmartPointer<vtkPolyData> to_vtk(const VtkSurface& surface) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(surface.positions.size()));
  for (std::size_t p = 0; p < surface.positions.size(); ++p) {
    points->SetPoint(static_cast<vtkIdType>(p), surface.positions[p].data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : surface.triangles) {
    const vtkIdType corners[3] = {triangle[0], triangle[1], triangle[2]};
    cells->InsertNextCell(3, corners);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

}  // namespace

VtkSurface vtk_contour(double* field, const std::array<std::int64_t, 3>& dims,
                       const std::array<double, 3>& first, double spacing) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(dims[0]), static_cast<int>(dims[1]),
                       static_cast<int>(dims[2]));
  image->SetOrigin(first.data());
  image->SetSpacing(spacing, spacing, spacing);
  vtkNew<vtkDoubleArray> values;
  constexpr int kKeep = 1;  // the array is not VTK's to free
  values->SetArray(field, dims[0] * dims[1] * dims[2], kKeep);
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 0.5);
  filter->ComputeNormalsOff();
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  return from_vtk(*filter->GetOutput());
}

VtkSurface vtk_windowed_sinc(const VtkSurface& surface, int iterations) {
  vtkNew<vtkWindowedSincPolyDataFilter> filter;
  filter->SetInputData(to_vtk(surface));
  filter->SetNumberOfIterations(iterations);
  filter->Update();
  return from_vtk(*filter->GetOutput());
}

std::vector<double> vtk_mean_curvatures(const VtkSurface& surface) {
  vtkNew<vtkCurvatures> filter;
  filter->SetInputData(to_vtk(surface));
  filter->SetCurvatureTypeToMean();
  filter->Update();
  vtkDataArray& values = *filter->GetOutput()->GetPointData()->GetArray("Mean_Curvature");
  std::vector<double> result(surface.positions.size());
  for (std::size_t p = 0; p < result.size(); ++p) {
    result[p] = values.GetTuple1(static_cast<vtkIdType>(p));
  }
  return result;
}

}  // namespace difmesh::paper
