#pragma once
/// \file out_of_memory.hpp
/// What is thrown in place of std::bad_alloc where it is known what the memory was for.

#include <memory>
#include <new>
#include <string>

namespace difmesh {

/// `what()` names the file and its size, or the cells of the field, and mostly how many
/// bytes were asked for.
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(const std::string& message)
      : message_(std::make_shared<const std::string>(message)) {}
  [[nodiscard]] const char* what() const noexcept override { return message_->c_str(); }

 private:
  std::shared_ptr<const std::string> message_;  ///< shared, for copies must not throw
};

}  // namespace difmesh
