#pragma once
/// \file long_call.hpp
/// What surrounds a long call into the library: a progress bar and Ctrl-C.

#include <optional>
#include <string>

#include "difmesh/options.hpp"
#include "interrupt.hpp"
#include "progress_bar.hpp"

namespace difmesh::cli {

/// Lives as long as the call and the writing of its results. The bar is shown where standard error
/// is a terminal, and not if `quiet`. Ctrl-C cancels the call, which then throws Error cancelled;
/// files that are being written are finished first.
class LongCall {
 public:
  LongCall(const std::string& label, bool quiet);

  /// The call before is done; what comes is called otherwise. \throw as done()
  void next(const std::string& label);
  /// To give to the call. Valid as long as this object.
  [[nodiscard]] Progress progress();
  /// Takes the bar away. \throw Error cancelled if a signal came since the last progress
  void done();

 private:
  InterruptGuard guard_;
  bool with_bar_;
  std::optional<ProgressBar> bar_;
};

}  // namespace difmesh::cli
