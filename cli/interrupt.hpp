#pragma once
/// \file interrupt.hpp
/// Ctrl-C as a request to stop, so that nothing half-written is left.

#include <array>
#include <csignal>

namespace difmesh::cli {

/// While it lives, SIGINT and SIGTERM are noted instead of ending the program at once, where they
/// were not ignored already; a second signal of the same kind ends it at once. A pipe that nobody
/// reads any more and a limit on the size of files become errors of the write. One at a time, on
/// the main thread.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  std::array<struct sigaction, 4> before_{};
};

/// The number of the signal that was noted, 0 if none.
[[nodiscard]] int interrupting_signal() noexcept;

}  // namespace difmesh::cli
