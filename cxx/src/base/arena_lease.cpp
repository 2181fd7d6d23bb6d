#include "base/arena_lease.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <mutex>
#include <utility>
#include <vector>

namespace difmesh::detail {
namespace {

class IdleArenas {
 public:
  std::unique_ptr<tbb::task_arena> take(int concurrency) {
    {
      const std::scoped_lock lock(mutex_);
      const auto found = std::find_if(arenas_.rbegin(), arenas_.rend(), [&](const auto& arena) {
        return arena->max_concurrency() == concurrency;
      });
      if (found != arenas_.rend()) {
        std::unique_ptr<tbb::task_arena> arena = std::move(*found);
        arenas_.erase(std::next(found).base());
        return arena;
      }
    }
    return std::make_unique<tbb::task_arena>(concurrency);
  }

  // Keeps the arena unless there are as many as ever serve at once.
  void give_back(std::unique_ptr<tbb::task_arena> arena) {
    const std::scoped_lock lock(mutex_);
    if (arenas_.size() < arenas_.capacity()) {
      arenas_.push_back(std::move(arena));
    }
  }

  // Lives until the process ends: threads may still be in calls when objects of static storage are
  // destroyed.
  static IdleArenas& all() {
    static IdleArenas* const arenas = new IdleArenas;
    return *arenas;
  }

 private:
  static constexpr std::size_t kMost = 64;

  IdleArenas() { arenas_.reserve(kMost); }

  std::mutex mutex_;
  std::vector<std::unique_ptr<tbb::task_arena>> arenas_;
};

// Asked for more threads than there are, oneTBB would print a warning.
int available(int threads) {
  const int most = tbb::info::default_concurrency();
  return threads > 0 ? std::min(threads, most) : most;
}

}  // namespace

ArenaLease::ArenaLease(int threads)
    : concurrency_(available(threads)), arena_(IdleArenas::all().take(concurrency_)) {}

ArenaLease::~ArenaLease() {
  IdleArenas::all().give_back(std::move(arena_));
}

}  // namespace difmesh::detail
