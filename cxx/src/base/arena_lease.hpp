#pragma once
// Task arenas of oneTBB that are used again. oneTBB (2021.8) keeps the arena of a finished call
// until a worker has left it, and searches all of them for each new one: short calls one after
// another would pile up arenas faster than they go, at 7 kB each, and take ever longer.

#include <tbb/task_arena.h>

#include <memory>

namespace difmesh::detail {

/// An arena for one call, which goes back to the idle ones with the lease. Calls at the same time
/// have one each.
class ArenaLease {
 public:
  /// \param threads at most this many, 0: as the machine has. A negative number counts as 0
  explicit ArenaLease(int threads);
  ~ArenaLease();
  ArenaLease(const ArenaLease&) = delete;
  ArenaLease& operator=(const ArenaLease&) = delete;

  [[nodiscard]] int concurrency() const { return concurrency_; }
  tbb::task_arena* operator->() { return arena_.get(); }

 private:
  int concurrency_;
  std::unique_ptr<tbb::task_arena> arena_;
};

}  // namespace difmesh::detail
