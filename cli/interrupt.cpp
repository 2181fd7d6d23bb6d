#include "interrupt.hpp"

#include <atomic>

namespace difmesh::cli {
namespace {

// A handler can reach nothing but a global. The signal may come on any thread.
std::atomic<int> noted_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void note_signal(int number) {
  noted_signal = number;
}

constexpr std::array<int, 4> kSignals{SIGINT, SIGTERM, SIGPIPE, SIGXFSZ};

}  // namespace

InterruptGuard::InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler == SIG_IGN) {
      continue;
    }
    struct sigaction action {};
    if (kSignals[i] == SIGINT || kSignals[i] == SIGTERM) {
      action.sa_handler = &note_signal;
      action.sa_flags = static_cast<int>(SA_RESETHAND);
    } else {
      action.sa_handler = SIG_IGN;
    }
    ::sigemptyset(&action.sa_mask);
    ::sigaction(kSignals[i], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &before_[i], nullptr);
  }
}

int interrupting_signal() noexcept {
  return noted_signal;
}

}  // namespace difmesh::cli
