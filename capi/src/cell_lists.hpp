#pragma once
// Work on lists of cells, a portion at a time: the memory for results stays bounded.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "convert.hpp"
#include "difmesh/array.hpp"

namespace difmesh::capi {

/// A list from C, all of it inside the grid, so that nothing is written before a bad cell is found.
/// \throw Error invalid_argument, naming the cell
[[nodiscard]] std::span<const Index3> to_cells(const std::int64_t* cells, std::int64_t count,
                                               const Index3& dims);

/// interfacial_cells(), whose progress goes to `share`.
[[nodiscard]] Array<Index3> list_interfacial(const Field& field, const Options& options,
                                             double share);

struct CellWork {
  std::span<const Index3> cells;
  std::size_t at_once = 0;  ///< cells of a portion
  double share_done = 0.0;  ///< before; progress goes on to 1
};

/// Has `compute` make the results of each portion, and hands them to `consume` with the index of
/// the portion's first cell.
template <class Result, class Compute, class Consume>
void for_portions(const CellWork& work, Options options, const Compute& compute,
                  const Consume& consume) {
  const Progress progress = options.progress;
  const std::size_t size = work.cells.size();
  const auto all = static_cast<double>(std::max<std::size_t>(size, 1));
  std::vector<Result> results(std::min(size, work.at_once));
  std::size_t begin = 0;
  do {
    const std::size_t count = std::min(size - begin, work.at_once);
    if (progress) {
      const double rest = 1.0 - work.share_done;
      const double from = work.share_done + rest * static_cast<double>(begin) / all;
      const double share = rest * static_cast<double>(count) / all;
      const bool last = begin + count == size;
      options.progress = [&progress, from, share, last](double part) {
        return progress(last && part == 1.0 ? 1.0 : from + share * part);
      };
    }
    const std::span<Result> part = std::span(results).first(count);
    compute(work.cells.subspan(begin, count), options, part);
    consume(begin, std::span<const Result>(part));
    begin += count;
  } while (begin < size);
}

}  // namespace difmesh::capi
