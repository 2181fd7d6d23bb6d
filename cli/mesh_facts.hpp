#pragma once
/// \file mesh_facts.hpp
/// What several commands say of a mesh.

#include <optional>

#include "difmesh/measure.hpp"

namespace difmesh::cli {

/// Nothing where a mesh bounds no body: sums over it mean nothing then.
[[nodiscard]] inline std::optional<double> enclosed_volume(const Measure& facts) {
  return facts.has_volume ? std::optional(facts.volume) : std::nullopt;
}

}  // namespace difmesh::cli
