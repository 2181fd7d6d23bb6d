#include "flying_edges.hpp"

#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkVersion.h>

namespace difmesh::bench {

struct FlyingEdges::Image {
  vtkNew<vtkImageData> data;
};

namespace {

template <class Values, class T>
void set_values(vtkImageData* data, std::vector<T>& field, int n) {
  data->SetDimensions(n, n, n);
  vtkNew<Values> values;
  values->SetArray(field.data(), static_cast<vtkIdType>(field.size()), 1);
  data->GetPointData()->SetScalars(values);
}

}  // namespace

FlyingEdges::FlyingEdges(std::vector<float>& field, int n) : image_(new Image) {
  set_values<vtkFloatArray>(image_->data, field, n);
}

FlyingEdges::FlyingEdges(std::vector<double>& field, int n) : image_(new Image) {
  set_values<vtkDoubleArray>(image_->data, field, n);
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

const char* FlyingEdges::version() {
  return vtkVersion::GetVTKVersion();
}

}  // namespace difmesh::bench
