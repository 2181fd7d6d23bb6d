#include "boundary.hpp"

#include <array>
#include <new>

#include "difmesh/error.hpp"
#include "difmesh/out_of_memory.hpp"
#include "difmesh/printable.hpp"

namespace difmesh::capi {
namespace {

// A struct that claims to be longer was never initialised.
constexpr std::uint64_t kLargestStruct = 4096;

using Message = std::array<char, 1024>;

Message& message() noexcept {
  thread_local Message text{};
  return text;
}

Message& warning() noexcept {
  thread_local Message text{};
  return text;
}

Call*& running_call() noexcept {
  thread_local Call* call = nullptr;
  return call;
}

void note_text(Message& text, const char* what) noexcept {
  std::size_t length = std::min(std::strlen(what), text.size() - 1);
  // Not in the middle of a character.
  while (what[length] != '\0' && length > 0 &&
         (static_cast<unsigned char>(what[length]) & 0xC0U) == 0x80U) {
    --length;
  }
  std::memcpy(text.data(), what, length);
  text[length] = '\0';
}

/// Notes a message, printable in one line; as it is where memory has run out.
dif_status note(dif_status status, const char* what) noexcept {
  try {
    note_text(message(), printable(what).c_str());
  } catch (const std::bad_alloc&) {
    note_text(message(), what);
  }
  return status;
}

dif_status status_of(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::invalid_argument:
      return DIF_ERROR_INVALID_ARGUMENT;
    case ErrorCode::invalid_grid:
      return DIF_ERROR_INVALID_GRID;
    case ErrorCode::invalid_value:
      return DIF_ERROR_INVALID_VALUE;
    case ErrorCode::too_large:
      return DIF_ERROR_TOO_LARGE;
    case ErrorCode::cancelled:
      return DIF_ERROR_CANCELLED;
    case ErrorCode::file_missing:
      return DIF_ERROR_FILE_MISSING;
    case ErrorCode::file_format:
      return DIF_ERROR_FILE_FORMAT;
    case ErrorCode::file_write:
      return DIF_ERROR_FILE_WRITE;
    case ErrorCode::unsupported:
      return DIF_ERROR_UNSUPPORTED;
  }
  return DIF_ERROR_INTERNAL;
}

}  // namespace

Call::Call() noexcept
    : at_entry_(FloatEnvironment::current()), at_return_(at_entry_), outer_(running_call()) {
  FloatEnvironment::set_default();
  running_call() = this;
}

Call::~Call() {
  running_call() = outer_;
  at_return_.set();
}

Call& Call::running() noexcept {
  return *running_call();
}

bool Call::is_of_this_thread() const noexcept {
  return running_call() == this;
}

CallersSettings::CallersSettings(Call& call) noexcept
    : call_(call), ours_(FloatEnvironment::current()) {
  if (call.is_of_this_thread()) {
    call.at_return_.set();
  } else {
    call.at_entry_.set_without_flags();
  }
}

CallersSettings::~CallersSettings() {
  if (call_.is_of_this_thread()) {
    call_.at_return_ = FloatEnvironment::current();
  }
  ours_.set();
}

void fail_argument(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, message);
}

void check_struct_size(std::uint64_t size, const char* name) {
  if (size < sizeof(std::uint64_t) || size % 8 != 0 || size > kLargestStruct) {
    throw Failure(DIF_ERROR_STRUCT, "the struct_size of '" + std::string(name) + "' is " +
                                        std::to_string(size) +
                                        ", which no release has; its _init function sets it");
  }
}

void fail_unknown_tail(std::uint64_t size, std::uint64_t known, const char* name) {
  throw Failure(DIF_ERROR_STRUCT,
                "'" + std::string(name) + "' uses fields that this version of the library, " +
                    dif_version_text() + ", does not know: it has " + std::to_string(size) +
                    " bytes, of which those from " + std::to_string(known) + " on are not all 0");
}

dif_status note_exception() noexcept {
  try {
    throw;
  } catch (const Failure& failure) {
    return note(failure.status(), failure.what());
  } catch (const Error& error) {
    return note(status_of(error.code()), error.what());
  } catch (const OutOfMemory& failure) {
    return note(DIF_ERROR_OUT_OF_MEMORY, failure.what());
  } catch (const std::bad_alloc&) {
    return note(DIF_ERROR_OUT_OF_MEMORY, "out of memory");
  } catch (const std::length_error&) {
    return note(DIF_ERROR_TOO_LARGE, "an array would be larger than any memory");
  } catch (const std::exception& exception) {
    return note(DIF_ERROR_INTERNAL, exception.what());
  } catch (...) {
    return note(DIF_ERROR_INTERNAL, "an exception of unknown type");
  }
}

const char* kept_warning(const std::vector<std::string>& warnings) noexcept {
  if (warnings.empty()) {
    return nullptr;
  }
  note_text(warning(), warnings.front().c_str());
  return warning().data();
}

}  // namespace difmesh::capi

const char* dif_last_message(void) {
  return difmesh::capi::message().data();
}
