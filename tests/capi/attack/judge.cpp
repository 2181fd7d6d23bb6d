#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "text.hpp"

namespace difmesh::attack {
namespace {

std::string edge_text(const DualEdge& edge) {
  return text("the edge along %c from node ", "xyz"[edge.axis]) + node_text(edge.node);
}

}  // namespace

Finding Judge::check(const Specimen& specimen, const Surface& surface, const dif_report& report) {
  specimen_ = &specimen;
  surface_ = &surface;
  report_ = &report;
  nodes_.measure(specimen);
  using Step = Finding (*)(Judge&);
  constexpr Step kSteps[] = {
      [](Judge& judge) { return judge.check_arrays(); },
      [](Judge& judge) { return judge.check_vertices(); },
      [](Judge& judge) { return judge.check_normals(); },
      [](Judge& judge) { return judge.nodes_.build(*judge.specimen_, judge.surface_->ids); },
      [](Judge& judge) { return judge.check_patches(); },
      [](Judge& judge) { return judge.check_fans(); },
      [](Judge& judge) { return judge.check_field_facts(); },
      [](Judge& judge) { return judge.check_volume(); },
  };
  for (const Step step : kSteps) {
    if (Finding finding = step(*this)) {
      return finding;
    }
  }
  return {};
}

Finding Judge::check_arrays() const {
  const Surface& s = *surface_;
  const std::size_t count = s.vertices();
  if (s.ids.size() != count || s.normals.size() != 3 * count) {
    return {"arrays of different lengths", text("%zu vertices, %zu edge ids, %zu / 3 normals",
                                                count, s.ids.size(), s.normals.size())};
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (v > 0 && s.ids[v - 1] >= s.ids[v]) {
      return {"edge ids do not ascend", text("vertex %zu", v)};
    }
    if (!nodes_.exists(nodes_.edge_of(s.ids[v])) ||
        nodes_.id_of(nodes_.edge_of(s.ids[v])) != s.ids[v]) {
      return {"an edge that does not exist", text("vertex %zu", v)};
    }
  }
  for (const std::uint32_t index : s.triangles) {
    if (index >= count) {
      return {"an index out of range", text("%u", index)};
    }
  }
  return {};
}

Finding Judge::check_vertices() const {
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  const double clearance = specimen_->options.clearance;
  for (std::size_t v = 0; v < surface_->vertices(); ++v) {
    const DualEdge edge = nodes_.edge_of(surface_->ids[v]);
    for (std::size_t a = 0; a < 3; ++a) {
      const double at = surface_->positions[3 * v + a];
      const double low = nodes_.coordinate(a, edge.node[a]);
      const auto finding = [&](const char* kind) {
        return Finding{kind, text("vertex %zu: %c is %.17g, that of the lower node %.17g, ", v,
                                  "xyz"[a], at, low) +
                                 edge_text(edge)};
      };
      if (!std::isfinite(at)) {
        return finding("a position that is not finite");
      }
      if (a != edge.axis) {
        if (at != low) {
          return finding("a vertex beside its edge");
        }
        continue;
      }
      const double high = nodes_.coordinate(a, edge.node[a] + 1);
      if (!(at > low && at < high)) {
        return finding("a vertex not strictly inside its edge");
      }
      const double rounding = 4.0 * kUlp *
                              (std::abs(specimen_->origin[a]) +
                               static_cast<double>(specimen_->dims[a] + 1) * specimen_->spacing[a]);
      const double least = clearance * (high - low) - rounding;
      if (at - low < least || high - at < least) {
        return finding("a vertex nearer to a node than the clearance");
      }
    }
  }
  return {};
}

Finding Judge::check_normals() const {
  for (std::size_t v = 0; v < surface_->vertices(); ++v) {
    const double* n = surface_->normals.data() + 3 * v;
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(std::abs(length - 1.0) < 1e-12)) {
      return {"a normal that is no unit vector", text("vertex %zu: length %.17g", v, length)};
    }
  }
  return {};
}

// The triangles around each vertex.
Finding Judge::check_fans() {
  const std::span<const std::uint32_t> indices = surface_->triangles;
  const std::size_t count = surface_->vertices();
  corner_start_.assign(count + 2, 0);
  for (const std::uint32_t v : indices) {
    ++corner_start_[v + 2];
  }
  for (std::size_t v = 2; v < corner_start_.size(); ++v) {
    corner_start_[v] += corner_start_[v - 1];
  }
  corners_.resize(indices.size());
  for (std::size_t c = 0; c < indices.size(); ++c) {
    const std::size_t first = c / 3 * 3;
    corners_[corner_start_[indices[c] + 1]++] = {indices[first + (c - first + 1) % 3],
                                                 indices[first + (c - first + 2) % 3]};
  }
  boundary_edges_ = 0;
  for (std::uint32_t v = 0; v < count; ++v) {
    const std::span<const Corner> corners(corners_.data() + corner_start_[v],
                                          corners_.data() + corner_start_[v + 1]);
    if (Finding finding = check_fan(v, corners)) {
      return finding;
    }
  }
  return {};
}

Finding Judge::check_fan(std::uint32_t vertex, std::span<const Corner> corners) {
  const auto finding = [&](const char* kind) {
    return Finding{kind,
                   text("vertex %u, ", vertex) + edge_text(nodes_.edge_of(surface_->ids[vertex]))};
  };
  if (corners.empty()) {
    return finding("a vertex without triangles");
  }
  std::size_t start = 0;
  int starts = 0;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    bool has_before = false;
    for (std::size_t other = 0; other < corners.size(); ++other) {
      if (other != c && corners[other].next == corners[c].next) {
        return finding("a directed edge twice");
      }
      has_before = has_before || corners[other].previous == corners[c].next;
    }
    if (!has_before) {
      start = c;
      ++starts;
      ++boundary_edges_;
      if (!on_one_end(vertex, corners[c].next)) {
        return finding("a boundary edge within the domain");
      }
    }
  }
  std::size_t visited = 1;
  for (std::size_t c = start; visited <= corners.size(); ++visited) {
    const std::uint32_t to = corners[c].previous;
    const auto after = std::find_if(corners.begin(), corners.end(),
                                    [&](const Corner& corner) { return corner.next == to; });
    if (after == corners.end() || after == corners.begin() + static_cast<std::ptrdiff_t>(start)) {
      break;
    }
    c = static_cast<std::size_t>(after - corners.begin());
  }
  return starts > 1 || visited != corners.size() ? finding("a vertex with more than one fan")
                                                 : Finding{};
}

// True if two vertices lie on the same face of the dual grid.
bool Judge::on_one_end(std::uint32_t a, std::uint32_t b) const {
  const DualEdge one = nodes_.edge_of(surface_->ids[a]);
  const DualEdge other = nodes_.edge_of(surface_->ids[b]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (one.axis == axis || other.axis == axis || one.node[axis] != other.node[axis]) {
      continue;
    }
    // No vertex lies beyond an empty side, and none that is not above an edge beyond a full one.
    if (one.node[axis] == nodes_.first()[axis] || one.node[axis] == nodes_.last()[axis]) {
      return true;
    }
  }
  return false;
}

Finding Judge::check_field_facts() const {
  const Specimen& s = *specimen_;
  dif_report expected{};
  double sum = 0.0;
  const double tolerance = s.options.purity_tolerance;
  const bool whole_numbers = s.type == DIF_UINT8 || s.type == DIF_UINT16;
  for_each_node({0, 0, 0}, {s.dims[0] - 1, s.dims[1] - 1, s.dims[2] - 1}, [&](const Index3& cell) {
    const double value = s.values[s.element(cell)];
    const double fraction = s.fraction(cell);
    ++expected.cells;
    sum += fraction;
    expected.interfacial_cells += fraction > tolerance && fraction < 1.0 - tolerance ? 1 : 0;
    const double outside = whole_numbers ? 0.0 : std::max(-value, value - 1.0);
    expected.clamped_cells += outside > 0.0 ? 1 : 0;
    expected.largest_overshoot = std::max(expected.largest_overshoot, outside);
  });
  const double volume = sum * (s.spacing[0] * s.spacing[1] * s.spacing[2]);
  if (report_->cells != expected.cells || report_->clamped_cells != expected.clamped_cells ||
      report_->interfacial_cells != expected.interfacial_cells ||
      report_->largest_overshoot != expected.largest_overshoot ||
      !(std::abs(report_->fraction_volume - volume) <= 1e-12 * volume)) {
    return {
        "a report that is not of this field",
        text("interfacial %d for %d, clamped %d for %d, volume %.17g for %.17g",
             static_cast<int>(report_->interfacial_cells),
             static_cast<int>(expected.interfacial_cells), static_cast<int>(report_->clamped_cells),
             static_cast<int>(expected.clamped_cells), report_->fraction_volume, volume)};
  }
  return {};
}

// What lies between the triangles and the middle of the dual grid, signed.
double Judge::sum_of_volumes() const {
  double middle[3];
  for (std::size_t a = 0; a < 3; ++a) {
    middle[a] = nodes_.coordinate(a, specimen_->dims[a] / 2);
  }
  double sum = 0.0;
  for (std::size_t t = 0; t < surface_->triangles.size(); t += 3) {
    double p[3][3];
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t a = 0; a < 3; ++a) {
        p[n][a] = surface_->positions[3 * surface_->triangles[t + n] + a] - middle[a];
      }
    }
    sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
           p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
           p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return sum / 6.0;
}

// A closed surface leaves all faces of the dual grid on one side, encloses all dual cells whose
// corners are inside, and no other but those that it crosses.
Finding Judge::check_volume() const {
  if ((report_->closed != 0) != (boundary_edges_ == 0)) {
    return {"closed or not", text("%d boundary edges, closed: %d",
                                  static_cast<int>(boundary_edges_), report_->closed)};
  }
  if (report_->closed == 0) {
    return report_->enclosed_volume == 0.0 ? Finding{} : Finding{"a volume where not closed", ""};
  }
  double whole = 0.0;
  double within = 0.0;
  double crossed = 0.0;
  const Index3& last = nodes_.last();
  for_each_node(nodes_.first(), {last[0] - 1, last[1] - 1, last[2] - 1}, [&](const Index3& cell) {
    double volume = 1.0;
    for (std::size_t a = 0; a < 3; ++a) {
      volume *= nodes_.coordinate(a, cell[a] + 1) - nodes_.coordinate(a, cell[a]);
    }
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Index3 node{cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1),
                        cell[2] + (corner >> 2)};
      inside += nodes_.inside(node) ? 1 : 0;
    }
    whole += volume;
    (inside == 8 ? within : crossed) += inside == 0 ? 0.0 : volume;
  });
  const double sum = sum_of_volumes();
  const double rounding = 1e-11 * whole;
  const double inside = sum + (nodes_.inside(nodes_.first()) ? whole : 0.0);
  if (!(std::abs(report_->enclosed_volume - sum) <= rounding) || !(inside >= within - rounding) ||
      !(inside <= within + crossed + rounding)) {
    return {"an enclosed volume that is not that of the triangles",
            text("%.17g, by triangles %.17g, by dual cells %.17g to %.17g",
                 report_->enclosed_volume, sum, within, within + crossed)};
  }
  return {};
}

}  // namespace difmesh::attack
