// Calls the C interface with any numbers. The first byte of an input chooses the kind of call, the
// others its arguments. Half of all first bytes choose a reconstruction.

#include <iterator>

#include "calls.hpp"

namespace {

using difmesh::fuzz::Input;

using Call = void (*)(Input&);
constexpr Call kCalls[] = {
    difmesh::fuzz::call_cell_planes,
    difmesh::fuzz::call_plane_numbers,
    difmesh::fuzz::call_values,
    difmesh::fuzz::call_mollify,
    difmesh::fuzz::call_function,
    difmesh::fuzz::call_shape,
    difmesh::fuzz::call_mesh_arrays,
    difmesh::fuzz::call_curvature,
    difmesh::fuzz::call_smooth,
    difmesh::fuzz::call_blocks,
    difmesh::fuzz::call_fractions_from_mesh,
    difmesh::fuzz::call_distance,
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const std::uint8_t kind = input.byte();
  const Call call =
      kind % 2 == 0 ? difmesh::fuzz::call_reconstruct : kCalls[kind / 2 % std::size(kCalls)];
  call(input);
  return 0;
}
