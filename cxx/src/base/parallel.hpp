#pragma once
// Loops over index ranges on a chosen number of threads, and the progress and cancelling that goes
// with them. The only place of the core that knows oneTBB; without it the same loops run serially.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/progress.hpp"

#ifdef DIFMESH_WITH_TBB
#include <tbb/parallel_for.h>

#include "base/arena_lease.hpp"
#endif

namespace difmesh::detail {

/// A fixed number of threads. Loops hand out fixed portions of `grain` indices, so that what a
/// portion computes never depends on how many threads there are.
class Workers {
 public:
  /// \param threads 0: as many as the machine has
  explicit Workers(int threads)
#ifdef DIFMESH_WITH_TBB
      : arena_(threads),
        threads_(arena_.concurrency())
#endif
  {
    if (threads < 0) {
      throw Error(ErrorCode::invalid_argument,
                  "threads must not be negative, got " + std::to_string(threads));
    }
  }

  [[nodiscard]] int count() const {
    return threads_;
  }

  /// body(begin, end) for portions that tile [0, count); portion p starts at p * grain.
  template <class Body>
  void for_portions(std::int64_t count, std::int64_t grain, const Body& body) {
    const std::int64_t portions = (count + grain - 1) / grain;
    const auto run = [&](std::int64_t portion) {
      body(portion * grain, std::min(count, (portion + 1) * grain));
    };
#ifdef DIFMESH_WITH_TBB
    if (threads_ > 1 && portions > 1) {
      arena_->execute([&] {
        tbb::parallel_for(std::int64_t{0}, portions, [&](std::int64_t portion) {
          // oneTBB's threads have the settings of whoever made them or the arena.
          std::optional<DefaultFloatEnvironment> environment;
          if (!FloatEnvironment::is_default()) {
            environment.emplace();
          }
          run(portion);
        });
      });
      return;
    }
#endif
    for (std::int64_t portion = 0; portion < portions; ++portion) {
      run(portion);
    }
  }

 private:
#ifdef DIFMESH_WITH_TBB
  ArenaLease arena_;
  int threads_;
#else
  int threads_ = 1;
#endif
};

/// Runs phases of known weight, and reports between slices of each on the calling thread.
class Phases {
 public:
  /// \param weight of all phases together
  Phases(Workers& workers, const Progress& progress, double weight = 1.0)
      : workers_(workers), progress_(progress), weight_(weight) {}

  [[nodiscard]] int threads() const { return workers_.count(); }
  /// As many portions as a phase must have to report its progress.
  [[nodiscard]] std::int64_t least_portions() const { return progress_ ? kSlices : 1; }

  /// As Workers::for_portions, as the next `weight` of the whole.
  template <class Body>
  void run(double weight, std::int64_t count, std::int64_t grain, const Body& body) {
    if (!progress_) {
      workers_.for_portions(count, grain, body);
      return;
    }
    const std::int64_t portions = (count + grain - 1) / grain;
    const std::int64_t slices = std::clamp<std::int64_t>(portions, 1, kSlices);
    for (std::int64_t slice = 0; slice < slices; ++slice) {
      const std::int64_t first = portions * slice / slices * grain;
      const std::int64_t last = std::min(count, portions * (slice + 1) / slices * grain);
      workers_.for_portions(last - first, grain, [&](std::int64_t begin, std::int64_t end) {
        body(first + begin, first + end);
      });
      report(done_ + weight * static_cast<double>(slice + 1) / static_cast<double>(slices));
    }
    done_ += weight;
  }

  /// Reports completion.
  void finish() {
    if (progress_) {
      report(weight_);
    }
  }

 private:
  static constexpr std::int64_t kSlices = 16;

  void report(double share) {
    if (!progress_(std::min(share / weight_, 1.0))) {
      throw Error(ErrorCode::cancelled, "cancelled by the progress callback");
    }
  }

  Workers& workers_;
  const Progress& progress_;
  double weight_;
  double done_ = 0.0;
};

}  // namespace difmesh::detail
