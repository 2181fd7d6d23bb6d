#include "surface/edge_ends.hpp"

namespace difmesh::detail {

EdgeEnds::EdgeEnds(const NodeBits& nodes, std::int64_t j, std::int64_t k)
    : nodes_(&nodes), here_(nodes.row(j, k)) {
  const std::int64_t row = nodes.row_index(j, k);
  are_none_ = nodes.are_alike(row, row);
  const auto beside = [&](std::int64_t dj, std::int64_t dk) {
    const std::int64_t to_j = j + dj;
    const std::int64_t to_k = k + dk;
    const bool exists = to_j >= nodes.first()[1] && to_j <= nodes.last()[1] &&
                        to_k >= nodes.first()[2] && to_k <= nodes.last()[2];
    are_none_ = are_none_ && (!exists || nodes.are_alike(row, nodes.row_index(to_j, to_k)));
    return exists ? nodes.row(to_j, to_k) : here_;
  };
  south_ = beside(-1, 0);
  north_ = beside(1, 0);
  below_ = beside(0, -1);
  above_ = beside(0, 1);
}

}  // namespace difmesh::detail
