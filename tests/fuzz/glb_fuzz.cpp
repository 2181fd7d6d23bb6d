// glTF from memory, with Draco in it or not. Bytes give a mesh with valid indices or an Error.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "difmesh/error.hpp"
#include "gltf_read.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  difmesh::Array<char> bytes(size);
  std::copy_n(data, size, bytes.begin());
  try {
    const difmesh::MeshFile found = difmesh::detail::decode_gltf("fuzz.glb", std::move(bytes));
    const std::size_t vertices = found.mesh.positions.size();
    for (const difmesh::Triangle& t : found.mesh.triangles) {
      if (std::max({t[0], t[1], t[2]}) >= vertices) {
        std::abort();
      }
    }
    for (const difmesh::VertexScalar& scalars : found.mesh.scalars) {
      if (scalars.values.size() != vertices) {
        std::abort();
      }
    }
  } catch (const difmesh::Error&) {
    return 0;
  }
  return 0;
}
