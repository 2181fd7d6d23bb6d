#pragma once
// The kinds of calls that the target makes. Each draws its arguments and checks what comes back.

#include "input.hpp"

namespace difmesh::fuzz {

void call_reconstruct(Input& input);
void call_blocks(Input& input);

void call_cell_planes(Input& input);
void call_plane_numbers(Input& input);

void call_values(Input& input);
void call_mollify(Input& input);
void call_function(Input& input);
void call_shape(Input& input);

void call_mesh_arrays(Input& input);
void call_curvature(Input& input);
void call_smooth(Input& input);
void call_fractions_from_mesh(Input& input);
void call_distance(Input& input);

}  // namespace difmesh::fuzz
