#pragma once
/// \file shrink.hpp
/// Makes a failing specimen small.

#include <functional>

#include "finding.hpp"
#include "specimen.hpp"

namespace difmesh::attack {

/// A specimen with few cells, plain values and usual options that fails in the same way.
/// \param attack what failed with `kind`
[[nodiscard]] Specimen shrunk(const std::function<Finding(const Specimen&)>& attack,
                              const Specimen& specimen, const char* kind);

}  // namespace difmesh::attack
