#pragma once
/// \file error.hpp
/// The one exception type of the library. Facts about the data that are no errors (clamped cells,
/// non-monotone edges, refused faces) come back in report structs instead.

#include <stdexcept>
#include <string>

namespace difmesh {

/// What went wrong, by kind. The values are stable and may be stored; gaps leave room.
enum class ErrorCode : int {
  invalid_argument = 10,  ///< an option or argument is out of its range
  invalid_grid = 11,      ///< dims, origin or spacing unusable
  invalid_value = 12,     ///< NaN, infinity or overshoot in a field; the message names the cell
  too_large = 20,         ///< sizes overflow, or the mesh needs more than 2^32 - 1 indices
  cancelled = 30,         ///< the progress callback asked to stop
  file_missing = 40,      ///< an input file cannot be opened
  file_format = 41,       ///< an input file is malformed, truncated or of a kind not supported
  file_write = 42,        ///< an output file cannot be written; nothing is left behind
  unsupported = 50,       ///< this build lacks what was asked for, or it cannot be had of this grid
};

/// Thrown by every function of the library that can fail. `what()` names the cell, file or
/// argument. std::bad_alloc passes through, or comes as OutOfMemory.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace difmesh
