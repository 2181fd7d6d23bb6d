#pragma once
/// \file instructions.hpp
/// The instruction sets for which the library has kernels. The one thing that difmesh.h cannot
/// tell.

namespace difmesh::attack {

/// Of this machine; the baseline, number 0, among them.
[[nodiscard]] int instruction_sets();
/// From now on the library uses this one. \param number in [0, instruction_sets())
void use_instruction_set(int number);

}  // namespace difmesh::attack
