#pragma once
// Lists of cells that callers ask about.

#include <cstddef>
#include <span>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// Checks that there is room for as many results as there are cells, and that all are in the grid.
/// \param call named in errors; \param results what there is room for, `of` what
/// \throw Error invalid_argument
void check_cell_list(const char* call, const Grid& grid, std::span<const Index3> cells,
                     std::size_t results, const char* of);

}  // namespace difmesh::detail
