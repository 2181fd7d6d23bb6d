#pragma once
/// \file array.hpp
/// The arrays of fields and meshes.

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace difmesh {

/// std::allocator that leaves trivial elements uninitialised on resize(n): the arrays of a mesh are
/// written once, by the thread that fills them. Arrays of 8 MiB and more are aligned to large pages
/// of memory, 2 MiB.
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
    // Rounds the size up to a whole large page if the array fills more than half of it.
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

}  // namespace difmesh
