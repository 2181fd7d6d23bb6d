#pragma once
// f at the corners of all cells, and which cells the surface may meet by that.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "difmesh/fractions_from_function.hpp"

namespace difmesh::detail {

/// A cell that needs a closer look, with f at its corners, x fastest.
struct CellCandidate {
  std::int64_t cell = 0;  ///< index in the field, x fastest
  std::array<double, 8> corners{};
};

struct Screening {
  std::vector<CellCandidate> candidates;  ///< in the order of their cells
  std::int64_t full_cells = 0;            ///< of those that are no candidates
  std::int64_t calls = 0;
};

/// Evaluates f once at each corner and writes 0 or 1 to all cells but the candidates. A cell is a
/// candidate if its corners are not all on one side, or if f is so near 0 there, compared with the
/// second differences at its corners, that it may change its sign in between.
/// \param weight of this phase for the progress
/// \throw Error invalid_value as fractions_from_function(); what f throws, the first row first
[[nodiscard]] Screening screen_cells(const Grid& grid, const FunctionBatch& f, Workers& workers,
                                     Phases& phases, double weight, std::span<double> fractions);

}  // namespace difmesh::detail
