#pragma once
// Hints to the machine about memory. They change no result, and none of them can fail.

#include <cstddef>
#include <cstdint>

#include "difmesh/array.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace difmesh::detail {

/// Asks for large pages for an Array that is about to be filled: thousands of page faults less.
template <class T>
inline void hint_large_pages(Array<T>& array) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21;
  // Small arrays are had faster from what the process has let go of.
  if (array.size() * sizeof(T) <= 4 * kPage) {
    return;
  }
  const auto address = reinterpret_cast<std::uintptr_t>(array.data());
  const auto begin = (address + kPage - 1) & ~(kPage - 1);
  // As UninitialisedAllocator rounds.
  const auto end = (address + array.size() * sizeof(T) + kPage / 2 - 1) & ~(kPage - 1);
  if (begin < end) {
    // Where the system has none, small ones do.
    static_cast<void>(madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
  }
#else
  static_cast<void>(array);
#endif
}

/// Asks for a line of memory to be read ahead.
template <class T>
inline void hint_read(const T* data) {
#if defined(__GNUC__)
  __builtin_prefetch(data);
  // GCC drops calls of functions that do nothing but prefetch, were it not for this.
  __asm__ volatile("" : : "r"(data));
#else
  static_cast<void>(data);
#endif
}

}  // namespace difmesh::detail
