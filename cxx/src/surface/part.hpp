#pragma once
// The surface of a part of a field, in phases: inside bits, planes, counts, vertices, triangles.

#include "cells/classify.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"
#include "difmesh/report.hpp"
#include "grid/block_field.hpp"
#include "surface/volume_sum.hpp"

namespace difmesh::detail {

/// What parts of one whole add up to.
struct PartSums {
  explicit PartSums(const Grid& grid);

  FieldFacts facts;
  VolumeSum volume;

  /// The report with the volume in it.
  [[nodiscard]] Report finish();
};

/// The mesh of the part that is the block of `field`, and the facts about it. Parts that follow
/// each other in z and use the same sums give the sums of the whole to the last bit.
/// \throw Error, OutOfMemory; what is in the sums is worth nothing then
[[nodiscard]] Mesh reconstruct_part(const BlockField& field, const Options& options,
                                    PartSums& sums);

}  // namespace difmesh::detail
