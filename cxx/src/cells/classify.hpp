#pragma once
// The one pass over the field: checks and sums the fractions and sets the inside bit of each node.

#include "base/parallel.hpp"
#include "cells/memory_plan.hpp"
#include "difmesh/report.hpp"
#include "grid/block_field.hpp"
#include "grid/node_bits.hpp"

namespace difmesh::detail {

struct ClassifiedNodes {
  NodeBits nodes;
  /// interfacial_ends() of each row of the block's cells, by j + dims[1] k: later the cells are no
  /// longer at hand.
  Array<std::uint8_t> row_ends;
};

/// Bit 0: the first of a row of cells is interfacial; bit 1: the last is.
template <class T>
[[nodiscard]] inline std::uint8_t interfacial_ends(const T* first, std::int64_t count,
                                                   const BlockField& field) {
  const T& last = first[(count - 1) * field.view.strides[0]];
  return static_cast<std::uint8_t>((field.is_interfacial(fraction_of(*first)) ? 1 : 0) |
                                   (field.is_interfacial(fraction_of(last)) ? 2 : 0));
}

/// What the field may hold.
struct FieldLimits {
  double overshoot_bound;
  LayerPlanes& layer_planes;
};

/// What a pass over a field finds, or those over its parts.
struct FieldFacts {
  Report report;
  /// Sum of all, on stretched axes by their cells' volumes; the report's volume is made of it.
  double fractions = 0.0;
};

/// Node bits of the block, with the nodes beyond the sides of the domain taken from the cells they
/// stand for. Adds to the facts about the field. \throw Error invalid_value naming the
/// first bad cell in the order z, y, x; OutOfMemory by the limits
[[nodiscard]] ClassifiedNodes classify(const BlockField& field, const FieldLimits& limits,
                                       double weight, Phases& phases, FieldFacts& facts);

}  // namespace difmesh::detail
