#pragma once
/// \file surface.hpp
/// The arrays and facts of a mesh as difmesh.h hands them out.

#include <cstdint>
#include <memory>
#include <span>

#include "difmesh/difmesh.h"
#include "finding.hpp"

namespace difmesh::attack {

struct FreeMesh {
  void operator()(dif_mesh* mesh) const { dif_mesh_free(mesh); }
};
using MeshHandle = std::unique_ptr<dif_mesh, FreeMesh>;

/// Borrowed from a mesh.
struct Surface {
  std::span<const double> positions;  ///< three per vertex
  std::span<const double> normals;    ///< likewise, or none
  std::span<const std::uint64_t> ids;
  std::span<const std::uint32_t> triangles;  ///< three per triangle

  [[nodiscard]] std::size_t vertices() const { return positions.size() / 3; }
};

[[nodiscard]] Surface surface_of(const dif_mesh* mesh);

/// Equal to the last bit.
[[nodiscard]] bool same_positions(const Surface& a, const Surface& b);
[[nodiscard]] bool same_triangles(const Surface& a, const Surface& b);
/// Which arrays of two surfaces are not equal to the last bit, or that all are. \param what kind of
/// finding
[[nodiscard]] Finding difference(const Surface& a, const Surface& b, const char* what);

}  // namespace difmesh::attack
