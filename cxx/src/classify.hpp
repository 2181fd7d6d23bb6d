#pragma once
// The one pass over the field: checks and sums the fractions and sets the inside bit of each node.

#include "block_field.hpp"
#include "difmesh/reconstruct.hpp"
#include "node_bits.hpp"
#include "parallel.hpp"

namespace difmesh::detail {

/// Node bits of the block, with the nodes beyond the sides of the domain taken from the cells they
/// stand for. Fills the report's facts about the field. \throw Error invalid_value naming the first
/// bad cell in the order z, y, x
[[nodiscard]] NodeBits classify(const BlockField& field, double overshoot_bound, double weight,
                                Phases& phases, Report& report);

}  // namespace difmesh::detail
