#pragma once
/// \file cell_planes.hpp
/// Normals and planes of interfacial cells: what flow solvers need without a mesh. Usable alone.

#include <span>

#include "difmesh/array.hpp"
#include "difmesh/field_view.hpp"
#include "difmesh/options.hpp"
#include "difmesh/plane.hpp"

namespace difmesh {

struct CellPlane {
  Plane plane;
  NormalSource source = NormalSource::none;
};

/// Normals and planes of the listed cells, by options.normals, options.boundary and
/// options.purity_tolerance. A cell with γ = 0 or 1 gets the plane touching its corner.
/// \param cells indices of cells in the grid; \param planes as many results
/// \throw Error as reconstruct(); invalid_argument where a cell lies outside the grid or the sizes
///   differ. Values outside [0,1] are clamped; the field is not validated, and NaN beside a cell
///   count as some fraction, NaN in it as 0.
/// Cost: some 0.05-0.1 µs per cell where x runs through memory, 0.2-0.4 µs else, 7 to 9 µs with
/// elvira, 1 to 2 µs with lvira; on options.threads threads.
/// Thread safety: concurrent calls are safe.
/// Source: MYC: Aulisa et al., J. Comput. Phys. 225 (2007) 2301; heights: docs/method.md.
void cell_planes(const FieldView& field, const Grid& grid, std::span<const Index3> cells,
                 const Options& options, std::span<CellPlane> planes);

/// The interfacial cells of a field, tolerance < γ < 1 - tolerance, in the order z, y, x. The whole
/// field is checked.
/// \throw Error as reconstruct()
/// Cost: two passes over the field. Thread safety: concurrent calls are safe.
[[nodiscard]] Array<Index3> interfacial_cells(const FieldView& field, const Grid& grid,
                                              const Options& options = {});

}  // namespace difmesh
