#pragma once
// The steps behind the mean in a report, which parts of a whole add up.

#include <cmath>
#include <cstdint>

#include "difmesh/report.hpp"

namespace difmesh::detail {

/// All steps so far: exact, for there are fewer than 2^52.
[[nodiscard]] inline std::int64_t newton_steps(const Report& report) {
  return std::llround(report.newton_steps_mean * static_cast<double>(report.solved_edges));
}

/// \pre report.solved_edges is up to date
inline void set_newton_steps(std::int64_t steps, Report& report) {
  report.newton_steps_mean = report.solved_edges > 0 ? static_cast<double>(steps) /
                                                           static_cast<double>(report.solved_edges)
                                                     : 0.0;
}

}  // namespace difmesh::detail
