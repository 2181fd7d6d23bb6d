#pragma once
/// \file progress.hpp
/// How long calls tell how far they are, and are cancelled.

#include <functional>

namespace difmesh {

/// Called between portions of the work, always on the thread that called the library, with the
/// share of the work done in [0,1], never decreasing. Return false to cancel: the call then throws
/// Error with code cancelled. Calls come at least every tenth of the work or so, but for grids of a
/// few rows, whose work is not worth dividing. May throw; the exception passes through.
using Progress = std::function<bool(double share_done)>;

}  // namespace difmesh
