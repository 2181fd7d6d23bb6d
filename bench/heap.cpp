#include "heap.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

void* operator new(std::size_t size) {
  namespace heap = difmesh::bench::heap;
  void* const block = std::malloc(size);
  if (block == nullptr) {
    throw std::bad_alloc();
  }
  heap::now += malloc_usable_size(block);
  heap::most = std::max(heap::most, heap::now);
  return block;
}
void operator delete(void* block) noexcept {
  difmesh::bench::heap::now -= block == nullptr ? 0 : malloc_usable_size(block);
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  operator delete(block);
}
