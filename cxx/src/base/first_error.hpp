#pragma once
// Which exception a parallel loop ends with, whatever the threads do.

#include <cstdint>
#include <exception>
#include <mutex>

namespace difmesh::detail {

/// Runs portions of a loop to their end or to an exception, and keeps the exception of the first
/// portion.
class FirstError {
 public:
  template <class Body>
  void guard(std::int64_t portion, const Body& body) {
    try {
      body();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_ || portion < portion_) {
        error_ = std::current_exception();
        portion_ = portion;
      }
    }
  }
  void rethrow() const {
    if (error_) {
      std::rethrow_exception(error_);
    }
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
  std::int64_t portion_ = 0;
};

}  // namespace difmesh::detail
