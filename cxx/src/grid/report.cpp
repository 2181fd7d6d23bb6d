#include "difmesh/report.hpp"

#include <algorithm>

#include "grid/newton_steps.hpp"

namespace difmesh {

void merge(Report& whole, const Report& part) {
  const std::int64_t steps = detail::newton_steps(whole) + detail::newton_steps(part);
  whole.cells += part.cells;
  whole.interfacial_cells += part.interfacial_cells;
  whole.clamped_cells += part.clamped_cells;
  whole.largest_overshoot = std::max(whole.largest_overshoot, part.largest_overshoot);
  whole.fraction_volume += part.fraction_volume;
  whole.planes += part.planes;
  whole.height_function_cells += part.height_function_cells;
  whole.gradient_free_cells += part.gradient_free_cells;
  whole.solved_edges += part.solved_edges;
  detail::set_newton_steps(steps, whole);
  whole.newton_steps_max = std::max(whole.newton_steps_max, part.newton_steps_max);
  whole.non_monotone_edges += part.non_monotone_edges;
  whole.curved_cells += part.curved_cells;
  whole.curved_vertices += part.curved_vertices;
  whole.moved_centres += part.moved_centres;
  whole.closed = whole.closed && part.closed;
  whole.enclosed_volume = whole.closed ? whole.enclosed_volume + part.enclosed_volume : 0.0;
  whole.seconds.classify += part.seconds.classify;
  whole.seconds.normals += part.seconds.normals;
  whole.seconds.count += part.seconds.count;
  whole.seconds.vertices += part.seconds.vertices;
  whole.seconds.triangles += part.seconds.triangles;
  whole.seconds.total += part.seconds.total;
  for (const std::string& warning : part.warnings) {
    if (std::find(whole.warnings.begin(), whole.warnings.end(), warning) == whole.warnings.end()) {
      whole.warnings.push_back(warning);
    }
  }
}

}  // namespace difmesh
