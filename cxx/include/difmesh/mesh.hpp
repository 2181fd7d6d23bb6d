#pragma once
/// \file mesh.hpp
/// The surface: an indexed triangle soup whose arrays can be handed to any mesh library.

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "difmesh/grid.hpp"

namespace difmesh {

/// std::allocator that leaves trivial elements uninitialised on resize(n): the arrays of a mesh are
/// written once, by the thread that fills them.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitialisedAllocator<U>;
  };
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    if constexpr (sizeof...(Args) == 0 && std::is_trivially_destructible_v<U>) {
      ::new (static_cast<void*>(place)) U;
    } else {
      ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
  }
};

/// A std::vector whose resize(n) does not touch the new elements.
template <class T>
using Array = std::vector<T, UninitialisedAllocator<T>>;

using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh. Triangles are counter-clockwise seen from the empty side (γ < 1/2). What
/// reconstruct() returns is edge-manifold and vertex-manifold; boundaries lie on domain sides only.
struct Mesh {
  Array<Vec3> positions;      ///< one per vertex, in the unit of the grid
  Array<Triangle> triangles;  ///< three indices into positions each
  Array<Vec3> normals;        ///< empty, or one unit vector per vertex, out of the material
  /// Empty, or one per vertex: the name of its dual edge, strictly ascending over the vertices.
  /// id = 3 (((k+1)(ny+2) + (j+1))(nx+2) + (i+1)) + axis, where (i,j,k) is the edge's lower dual
  /// node in the indices of the whole grid (-1 and n are the nodes beyond or on the domain faces).
  Array<std::uint64_t> edge_ids;
};

}  // namespace difmesh
