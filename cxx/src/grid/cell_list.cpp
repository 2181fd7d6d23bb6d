#include "grid/cell_list.hpp"

#include <string>

#include "difmesh/error.hpp"

namespace difmesh::detail {

void check_cell_list(const char* call, const Grid& grid, std::span<const Index3> cells,
                     std::size_t results, const char* of) {
  if (cells.size() != results) {
    throw Error(ErrorCode::invalid_argument,
                std::string(call) + ": " + std::to_string(cells.size()) + " cells but room for " +
                    std::to_string(results) + " " + of);
  }
  for (std::size_t n = 0; n < cells.size(); ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cells[n][axis] < 0 || cells[n][axis] >= grid.dims[axis]) {
        throw Error(ErrorCode::invalid_argument,
                    std::string(call) + ": cell number " + std::to_string(n) + " of the list, (" +
                        std::to_string(cells[n][0]) + ", " + std::to_string(cells[n][1]) + ", " +
                        std::to_string(cells[n][2]) + "), is outside the grid");
      }
    }
  }
}

}  // namespace difmesh::detail
