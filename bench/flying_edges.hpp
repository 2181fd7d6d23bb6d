#pragma once
// VTK's vtkFlyingEdges3D on a field. Apart from the rest because VTK 9.1's headers are not C++20.

#include <memory>
#include <vector>

namespace difmesh::bench {

class FlyingEdges {
 public:
  /// \param field n³ values, which must outlive this
  FlyingEdges(std::vector<float>& field, int n);
  FlyingEdges(std::vector<double>& field, int n);
  ~FlyingEdges();
  FlyingEdges(const FlyingEdges&) = delete;
  FlyingEdges& operator=(const FlyingEdges&) = delete;

  /// Contours at 1/2, without normals. Returns the number of vertices.
  long long run();

  static void set_threads(int threads);
  static const char* back_end();
  static const char* version();

 private:
  struct Image;
  std::unique_ptr<Image> image_;
};

}  // namespace difmesh::bench
