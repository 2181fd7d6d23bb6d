#pragma once
// The surface that a cell owns.

#include "curved/local_surface.hpp"
#include "grid/block_field.hpp"
#include "planes/normal_stencil.hpp"

namespace difmesh::detail {

/// Makes surfaces of cells of one field. Thread safety: const calls are safe.
template <class T>
class SurfaceMaker {
 public:
  SurfaceMaker(const BlockField& field, CellSurfaceKind kind)
      : field_(field),
        kind_(kind),
        youngs_(field, Normals::youngs),
        lvira_(field, Normals::lvira) {}

  /// \pre the cell and, as far as the domain reaches, its neighbours up to kCurvatureReach steps
  ///   away, or kPositionReach, are in memory
  [[nodiscard]] LocalSurface operator()(const Index3& cell) const;

 private:
  const BlockField& field_;
  CellSurfaceKind kind_;
  NormalStencil<T> youngs_;
  NormalStencil<T> lvira_;  // for cells at open sides, where Youngs' normal is a poor start
};

}  // namespace difmesh::detail
