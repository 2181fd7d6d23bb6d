#pragma once
// Normals of interfacial cells from their neighbourhood.

#include <array>

#include "difmesh/plane.hpp"
#include "grid/block_field.hpp"
#include "planes/kernels.hpp"

namespace difmesh::detail {

/// A normal in the unit cell: m_i = n_i spacing_i, out of the material, scaled to |m|₁ = 1; all
/// zero where the neighbourhood has no gradient.
struct UnitNormal {
  Vec3 m{0.0, 0.0, 0.0};
  NormalSource source = NormalSource::none;
};

/// Cells on each side of the middle one in a column of ELVIRA: a plane whose normal is steepest
/// along the column and that crosses the centre's cell leaves the centre's column by no more, nor
/// the nearer ones of its neighbours'. With the three cells of the method in two dimensions not all
/// planes in three would be found.
inline constexpr std::int64_t kElviraReach = 2;

/// Layers of cells around a cell that its normal depends on.
[[nodiscard]] constexpr std::int64_t stencil_reach(Normals normals) {
  switch (normals) {
    case Normals::youngs:
    case Normals::myc:
    case Normals::lvira:
      break;
    case Normals::height_function:
      return kColumnReach;
    case Normals::elvira:
      return kElviraReach;
  }
  return 1;
}

/// Fractions of a column of heights, or of what the domain has of one.
using FractionColumn = double[2 * kColumnReach + 1];

/// The rule of column_rule.hpp for the first `count` cells, which stand from the material's end on.
[[nodiscard]] bool is_consistent(const FractionColumn& column, int count, double least_full,
                                 double most_empty);

/// Estimates normals of cells of one field. Thread safety: const calls are safe.
template <class T>
class NormalStencil {
 public:
  NormalStencil(const BlockField& field, Normals normals);

  /// \pre the cell and, as far as the domain reaches, its stencil are in memory
  [[nodiscard]] UnitNormal operator()(const Index3& cell) const;

 private:
  // Fractions of 3x3x3 cells, [z][y][x]. Missing layers are continued linearly, which makes every
  // centred difference across them one-sided; `present` is 0 for them, for sums.
  struct Neighbourhood {
    double c[27];
    double present[3][3];  // [axis][offset]
    bool is_cut_short;     // a layer is missing
  };

  void gather(const Index3& cell, Neighbourhood& hood) const;
  void gather_at_side(const Index3& cell, Neighbourhood& hood) const;
  [[nodiscard]] static Vec3 fit(const Neighbourhood& hood, const Vec3& m);
  [[nodiscard]] double fraction(const Index3& resolved) const;
  [[nodiscard]] bool is_inside(const Index3& cell, std::size_t axis) const;
  [[nodiscard]] bool add_heights(const Index3& cell, std::size_t axis, double sense,
                                 Vec3& sum) const;
  // Where the nine columns along one axis lie, resolved: from the material's end on, and across.
  struct SideColumns {
    std::array<std::int64_t, 9> along;
    int count = 0;
    std::array<std::int64_t, 3> foot[2];
  };
  [[nodiscard]] SideColumns side_columns(const Index3& cell, std::size_t axis, double sense) const;
  [[nodiscard]] bool column_at_side(const SideColumns& columns, std::size_t axis, int u, int v,
                                    double& height) const;
  // Fractions from the material's end, zeros behind the last.
  using Column = FractionColumn;
  [[nodiscard]] bool is_column(const Column& column, int count, double& height) const;

  const BlockField& field_;
  Normals normals_;
  const T* data_;
  double empty_;
  double full_;
};

}  // namespace difmesh::detail
