#include "flying_edges.hpp"

#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

namespace difmesh::bench {

struct FlyingEdges::Image {
  vtkNew<vtkImageData> data;
};

FlyingEdges::FlyingEdges(std::vector<float>& field, int n) : image_(new Image) {
  image_->data->SetDimensions(n, n, n);
  vtkNew<vtkFloatArray> values;
  values->SetArray(field.data(), static_cast<vtkIdType>(field.size()), 1);
  image_->data->GetPointData()->SetScalars(values);
}

FlyingEdges::~FlyingEdges() = default;

long long FlyingEdges::run() {
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(image_->data);
  filter->SetValue(0, 0.5);
  filter->ComputeNormalsOff();
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  return filter->GetOutput()->GetNumberOfPoints();
}

void FlyingEdges::set_threads(int threads) {
  vtkSMPTools::Initialize(threads);
}

const char* FlyingEdges::back_end() {
  return vtkSMPTools::GetBackend();
}

}  // namespace difmesh::bench
