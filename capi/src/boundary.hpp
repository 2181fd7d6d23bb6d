#pragma once
// The border between C and C++: no exception crosses it, and structs of other releases are
// understood.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "difmesh/difmesh.h"
#include "difmesh/float_environment.hpp"

namespace difmesh::capi {

/// A failure with a status that the C++ core does not know.
class Failure : public std::runtime_error {
 public:
  Failure(dif_status status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  [[nodiscard]] dif_status status() const noexcept { return status_; }

 private:
  dif_status status_;
};

[[noreturn]] void fail_argument(const std::string& message);

/// Notes the exception being handled as this thread's message. Allocates nothing.
dif_status note_exception() noexcept;

/// One call of an entry point: while it lives, the thread has the default floating-point settings.
/// Calls nest, where callbacks call the library.
class Call {
 public:
  Call() noexcept;
  ~Call();
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  /// The innermost one of this thread. \pre there is one
  [[nodiscard]] static Call& running() noexcept;

 private:
  friend class CallersSettings;
  [[nodiscard]] bool is_of_this_thread() const noexcept;

  const FloatEnvironment at_entry_;
  FloatEnvironment at_return_;  ///< as at entry, but for what callbacks on this thread did
  Call* outer_;
};

/// While it lives, around a callback, the thread has the caller's floating-point settings.
class CallersSettings {
 public:
  explicit CallersSettings(Call& call) noexcept;
  ~CallersSettings();
  CallersSettings(const CallersSettings&) = delete;
  CallersSettings& operator=(const CallersSettings&) = delete;

 private:
  Call& call_;
  FloatEnvironment ours_;
};

/// A callback that finds the settings of the running call's caller. \pre outlived by the call
template <class Callback>
[[nodiscard]] auto with_callers_settings(Callback callback) {
  return [callback, &call = Call::running()](auto... arguments) {
    const CallersSettings settings(call);
    return callback(arguments...);
  };
}

/// The first of the warnings, kept for the thread until the next one; NULL if there is none.
[[nodiscard]] const char* kept_warning(const std::vector<std::string>& warnings) noexcept;

/// Runs the body of an entry point.
template <class Body>
dif_status guarded(const Body& body) noexcept {
  const Call call;
  try {
    body();
    return DIF_OK;
  } catch (...) {
    return note_exception();
  }
}

/// \throw Error invalid_argument for NULL, naming the argument
template <class T>
T& required(T* pointer, const char* name) {
  if (pointer == nullptr) {
    fail_argument("argument '" + std::string(name) + "' is NULL");
  }
  return *pointer;
}

/// A handle to give out; NULL until then.
template <class Handle>
Handle*& out_handle(Handle** pointer, const char* name) {
  Handle*& handle = required(pointer, name);
  handle = nullptr;
  return handle;
}

/// An array that may be NULL if it has no elements.
template <class T>
T* required_array(T* pointer, std::int64_t count, const char* name) {
  if (count < 0) {
    fail_argument("the number of elements of '" + std::string(name) + "' is negative");
  }
  if (pointer == nullptr && count > 0) {
    fail_argument("argument '" + std::string(name) + "' is NULL");
  }
  return pointer;
}

/// Checks a struct_size that came from a caller. \throw Failure DIF_ERROR_STRUCT
void check_struct_size(std::uint64_t size, const char* name);
[[noreturn]] void fail_unknown_tail(std::uint64_t size, std::uint64_t known, const char* name);

/// Fills a caller's struct of any release as far as it reaches.
template <class Struct>
void write_struct(Struct* to, std::uint64_t size, Struct value, const char* name) {
  static_assert(std::is_trivially_copyable_v<Struct> && sizeof(Struct) % 8 == 0);
  required(to, name);
  check_struct_size(size, name);
  value.struct_size = size;
  auto* bytes = reinterpret_cast<unsigned char*>(to);
  const auto reach = static_cast<std::size_t>(size);
  const std::size_t known = std::min(reach, sizeof(Struct));
  std::memcpy(bytes, &value, known);
  std::memset(bytes + known, 0, reach - known);
}

/// Checks a caller's struct that is to be filled, before the work whose results it gets.
template <class Struct>
void check_output(const Struct* to, const char* name) {
  check_struct_size(required(to, name).struct_size, name);
}

/// Fills a caller's struct whose size it has set.
template <class Struct>
void write_output(Struct* to, const Struct& value, const char* name) {
  write_struct(to, required(to, name).struct_size, value, name);
}

/// Reads a caller's struct of any release over the defaults. NULL gives the defaults.
template <class Struct>
[[nodiscard]] Struct read_struct(const Struct* from, const Struct& defaults, const char* name) {
  static_assert(std::is_trivially_copyable_v<Struct> && sizeof(Struct) % 8 == 0);
  Struct result = defaults;
  if (from == nullptr) {
    return result;
  }
  const std::uint64_t size = from->struct_size;
  check_struct_size(size, name);
  const auto* bytes = reinterpret_cast<const unsigned char*>(from);
  std::memcpy(&result, bytes, std::min(static_cast<std::size_t>(size), sizeof(Struct)));
  for (std::size_t byte = sizeof(Struct); byte < size; ++byte) {
    if (bytes[byte] != 0) {
      fail_unknown_tail(size, sizeof(Struct), name);
    }
  }
  return result;
}

}  // namespace difmesh::capi
