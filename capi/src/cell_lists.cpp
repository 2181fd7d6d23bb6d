#include "cell_lists.hpp"

#include "difmesh/cell_planes.hpp"

namespace difmesh::capi {

std::span<const Index3> to_cells(const std::int64_t* cells, std::int64_t count,
                                 const Index3& dims) {
  required_array(cells, count, "cells");
  static_assert(sizeof(Index3) == 3 * sizeof(std::int64_t));
  const std::span<const Index3> list(reinterpret_cast<const Index3*>(cells), to_size(count));
  for (std::size_t n = 0; n < list.size(); ++n) {
    const auto& [i, j, k] = list[n];
    if (i < 0 || j < 0 || k < 0 || i >= dims[0] || j >= dims[1] || k >= dims[2]) {
      fail_argument("cell number " + std::to_string(n) + " of 'cells', (" + std::to_string(i) +
                    ", " + std::to_string(j) + ", " + std::to_string(k) + "), is outside the grid");
    }
  }
  return list;
}

Array<Index3> list_interfacial(const Field& field, const Options& options, double share) {
  Options listing = options;
  if (options.progress) {
    listing.progress = [&](double part) { return options.progress(share * part); };
  }
  return interfacial_cells(field.view, field.grid, listing);
}

}  // namespace difmesh::capi
