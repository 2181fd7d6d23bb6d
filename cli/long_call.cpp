#include "long_call.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <iostream>

#include "difmesh/error.hpp"

namespace difmesh::cli {
namespace {

constexpr int kUsualColumns = 80;

int terminal_columns() {
  struct winsize size {};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsualColumns;
}

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

LongCall::LongCall(const std::string& label, bool quiet)
    : with_bar_(!quiet && ::isatty(STDERR_FILENO) == 1) {
  next(label);
}

void LongCall::next(const std::string& label) {
  done();
  if (with_bar_) {
    bar_.emplace(std::cerr, label, terminal_columns(), &seconds_now);
  }
}

Progress LongCall::progress() {
  return [this](double share) {
    if (bar_) {
      bar_->update(share);
    }
    return interrupting_signal() == 0;
  };
}

void LongCall::done() {
  bar_.reset();
  if (interrupting_signal() != 0) {
    throw Error(ErrorCode::cancelled, "interrupted");
  }
}

}  // namespace difmesh::cli
