// Draco's data from memory. Bytes give a mesh with valid indices or an Error.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "difmesh/error.hpp"
#include "drc.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  difmesh::Array<char> bytes(size);
  std::copy_n(data, size, bytes.begin());
  try {
    const difmesh::MeshFile found = difmesh::detail::decode_drc("fuzz.drc", bytes);
    for (const difmesh::Triangle& t : found.mesh.triangles) {
      if (std::max({t[0], t[1], t[2]}) >= found.mesh.positions.size()) {
        std::abort();
      }
    }
  } catch (const difmesh::Error&) {
    return 0;
  }
  return 0;
}
