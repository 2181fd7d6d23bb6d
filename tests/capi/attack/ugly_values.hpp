#pragma once
/// \file ugly_values.hpp
/// Volume fractions as nobody would wish them.

#include "random.hpp"
#include "specimen.hpp"

namespace difmesh::attack {

/// Fills in the values of a specimen whose dims, type and options are there.
void make_values(Random& random, Specimen& specimen);

}  // namespace difmesh::attack
