#pragma once
// The distance from a reference mesh, with a sign where the mesh is closed.

#include <cstdint>
#include <memory>

#include "base/parallel.hpp"
#include "distance_field.hpp"
#include "surface_view.hpp"
#include "triangle_tree.hpp"

namespace difmesh::detail {

class ReferenceSurface final : public DistanceField {
 public:
  /// \param with_sign wanted where possible
  ReferenceSurface(const SurfaceView& surface, bool with_sign, int threads, Workers& workers);
  [[nodiscard]] bool has_sign() const noexcept override { return has_sign_; }
  [[nodiscard]] std::unique_ptr<DistanceProbe> probe() const override;

 private:
  double scale_;
  TriangleTree tree_;
  bool has_sign_;
};

}  // namespace difmesh::detail
