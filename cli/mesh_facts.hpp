#pragma once
/// \file mesh_facts.hpp
/// What several commands say of a mesh.

#include <optional>

#include "difmesh/measure.hpp"

namespace difmesh::cli {

/// Nothing where a mesh has boundary edges, or triangles turned against their neighbours: sums over
/// it mean nothing then.
[[nodiscard]] inline std::optional<double> enclosed_volume(const Measure& facts) {
  const bool bounds = facts.closed && facts.misoriented_edges == 0;
  return bounds ? std::optional(facts.volume) : std::nullopt;
}

}  // namespace difmesh::cli
