#pragma once
// Counts what is on the heap of a program. heap.cpp, linked with it, replaces operator new.

#include <cstddef>

namespace difmesh::bench {

struct HeapUse {
  std::size_t left = 0;  // bytes more than at the start
  std::size_t most = 0;  // the same at the worst moment
};

namespace heap {
inline std::size_t now = 0;
inline std::size_t most = 0;
}  // namespace heap

// For one thread: what others allocate meanwhile is counted, but not without races.
class HeapMeter {
 public:
  HeapMeter() : start_(heap::now) { heap::most = heap::now; }
  [[nodiscard]] HeapUse use() const { return {heap::now - start_, heap::most - start_}; }

 private:
  std::size_t start_;
};

}  // namespace difmesh::bench
