#pragma once
/// \file mesh.hpp
/// The surface: an indexed triangle soup whose arrays can be handed to any mesh library.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "difmesh/grid.hpp"

namespace difmesh {

/// std::allocator that leaves trivial elements uninitialised on resize(n): the arrays of a mesh are
/// written once, by the thread that fills them. Arrays of 8 MiB and more are aligned to large pages of memory, 2 MiB.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitialisedAllocator<U>;
  };
  [[nodiscard]] T* allocate(std::size_t count) {
    if (count < kLarge) {
      return std::allocator<T>::allocate(count);
    }
    if (count > std::size_t(-1) / sizeof(T) - kLargePage) {
      throw std::bad_array_new_length();
    }
    // The last large page is had whole where the array fills most of it.
    const std::size_t bytes = count * sizeof(T);
    const std::size_t tail = bytes % kLargePage;
    const std::size_t rounded = tail > kLargePage / 2 ? bytes + (kLargePage - tail) : bytes;
    return static_cast<T*>(::operator new (rounded, std::align_val_t{kLargePage}));
  }
  void deallocate(T* data, std::size_t count) {
    if (count < kLarge) {
      std::allocator<T>::deallocate(data, count);
    } else {
      ::operator delete (static_cast<void*>(data), std::align_val_t{kLargePage});
    }
  }
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    if constexpr (sizeof...(Args) == 0 && std::is_trivially_destructible_v<U>) {
      ::new (static_cast<void*>(place)) U;
    } else {
      ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
  }

 private:
  static constexpr std::size_t kLargePage = std::size_t{1} << 21;
  static constexpr std::size_t kLarge = 4 * kLargePage / sizeof(T) + 1;
};

/// A std::vector whose resize(n) does not touch the new elements.
template <class T>
using Array = std::vector<T, UninitialisedAllocator<T>>;

using Triangle = std::array<std::uint32_t, 3>;

/// A named number per vertex: curvature, errors and the like.
struct VertexScalar {
  std::string name;      ///< letters, digits and underscores, for instance "mean_curvature"
  Array<double> values;  ///< one per vertex
};

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
  std::vector<VertexScalar> scalars = {};  ///< of different names
};

}  // namespace difmesh
