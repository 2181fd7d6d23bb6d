#pragma once
/// \file reports.hpp
/// Comparisons of reports.

#include <cmath>
#include <string>

#include "difmesh/report.hpp"

namespace difmesh::test {

/// The first fact that differs, or "". Sums may differ by a share of the first one; seconds by
/// anything.
[[nodiscard]] inline std::string difference(const Report& a, const Report& b, double share = 0.0) {
  const auto differ = [&](double x, double y) { return std::abs(x - y) > share * std::abs(x); };
  const auto text = [](const char* name, auto x, auto y) {
    return std::string(name) + ": " + std::to_string(x) + " and " + std::to_string(y);
  };
#define DIFMESH_COMPARE(fact)           \
  if (a.fact != b.fact) {               \
    return text(#fact, a.fact, b.fact); \
  }
  DIFMESH_COMPARE(cells)
  DIFMESH_COMPARE(interfacial_cells)
  DIFMESH_COMPARE(clamped_cells)
  DIFMESH_COMPARE(largest_overshoot)
  DIFMESH_COMPARE(planes)
  DIFMESH_COMPARE(height_function_cells)
  DIFMESH_COMPARE(gradient_free_cells)
  DIFMESH_COMPARE(solved_edges)
  DIFMESH_COMPARE(newton_steps_mean)
  DIFMESH_COMPARE(newton_steps_max)
  DIFMESH_COMPARE(non_monotone_edges)
  DIFMESH_COMPARE(curved_cells)
  DIFMESH_COMPARE(curved_vertices)
  DIFMESH_COMPARE(moved_centres)
  DIFMESH_COMPARE(closed)
#undef DIFMESH_COMPARE
  if (differ(a.fraction_volume, b.fraction_volume)) {
    return text("fraction_volume", a.fraction_volume, b.fraction_volume);
  }
  if (differ(a.enclosed_volume, b.enclosed_volume)) {
    return text("enclosed_volume", a.enclosed_volume, b.enclosed_volume);
  }
  return a.warnings == b.warnings ? "" : "warnings";
}

}  // namespace difmesh::test
