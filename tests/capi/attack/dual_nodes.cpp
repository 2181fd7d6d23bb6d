#include "dual_nodes.hpp"

#include <cmath>

#include "text.hpp"

namespace difmesh::attack {
void DualNodes::measure(const Specimen& specimen) {
  specimen_ = &specimen;
  with_surfaces_ = specimen.options.placement == DIF_PLACEMENT_CURVED;
  with_planes_ = with_surfaces_ || specimen.options.placement == DIF_PLACEMENT_PLIC ||
                 specimen.options.placement == DIF_PLACEMENT_DEFAULT;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t count = specimen.dims[a];
    first_[a] = specimen.is_periodic(a) ? 0 : -1;
    last_[a] = count;
    size_[a] = count + 2;
    const double origin = specimen.origin[a];
    const double spacing = specimen.spacing[a];
    std::vector<double>& at = coordinates_[a];
    at.resize(static_cast<std::size_t>(size_[a]));
    for (std::int64_t n = 0; n < size_[a]; ++n) {
      at[static_cast<std::size_t>(n)] = origin + (static_cast<double>(n) - 0.5) * spacing;
    }
    const auto ends_on_face = [&](bool high) {
      return specimen.is_side(a, high, DIF_SIDE_OPEN) || specimen.is_side(a, high, DIF_SIDE_MIRROR);
    };
    if (ends_on_face(false)) {
      at.front() = origin;
    }
    if (ends_on_face(true)) {
      at.back() = origin + static_cast<double>(count) * spacing;
    } else if (specimen.is_periodic(a)) {
      at.back() = at[1] + static_cast<double>(count) * spacing;  // a period on, to the last bit
    }
  }
}

DualEdge DualNodes::edge_of(std::uint64_t id) const {
  DualEdge edge;
  edge.axis = static_cast<std::size_t>(id % 3);
  auto rest = static_cast<std::int64_t>(id / 3);
  for (std::size_t a = 0; a < 3; ++a) {
    edge.node[a] = rest % size_[a] - 1;
    rest /= size_[a];
  }
  return edge;
}

std::uint64_t DualNodes::id_of(const DualEdge& edge) const {
  return 3 * static_cast<std::uint64_t>(number(edge.node)) + edge.axis;
}

bool DualNodes::exists(const DualEdge& edge) const {
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t most = a == edge.axis ? last_[a] - 1 : last_[a];
    if (edge.node[a] < first_[a] || edge.node[a] > most) {
      return false;
    }
  }
  return true;
}

bool DualNodes::is_open_face(std::size_t axis, std::int64_t index) const {
  return (index < 0 && specimen_->is_side(axis, false, DIF_SIDE_OPEN)) ||
         (index >= specimen_->dims[axis] && specimen_->is_side(axis, true, DIF_SIDE_OPEN));
}

DualNodes::Stand DualNodes::stand_of(const Index3& node) const {
  Stand stand;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t count = specimen_->dims[a];
    const bool high = node[a] >= count;
    stand.cell[a] = node[a];
    if (node[a] >= 0 && !high) {
      continue;
    }
    stand.empty = stand.empty || specimen_->is_side(a, high, DIF_SIDE_EMPTY);
    stand.full = stand.full || specimen_->is_side(a, high, DIF_SIDE_FULL);
    stand.open_faces += is_open_face(a, node[a]) ? 1 : 0;
    const std::int64_t nearest = high ? count - 1 : 0;
    stand.cell[a] = specimen_->is_periodic(a) ? 0 : nearest;
  }
  stand.full = stand.full && !stand.empty;
  return stand;
}

bool DualNodes::is_free(const Stand& stand) const {
  if (stand.empty || stand.full) {
    return false;
  }
  const auto is_near_half = [&] {
    const double fraction = specimen_->fraction(stand.cell);
    return fraction > 0.3 && fraction < 0.7;
  };
  return (with_planes_ && stand.open_faces > 0) || (with_surfaces_ && is_near_half());
}

std::optional<double> DualNodes::fraction(const Index3& node) const {
  const Stand stand = stand_of(node);
  if (is_free(stand)) {
    return std::nullopt;
  }
  return stand.empty ? 0.0 : (stand.full ? 1.0 : specimen_->fraction(stand.cell));
}

void DualNodes::for_each_open(const std::function<void(const OpenNode&)>& visit) const {
  for_each_node(first_, last_, [&](const Index3& node) {
    const Stand stand = stand_of(node);
    if (!is_free(stand)) {
      return;
    }
    OpenNode open{node, stand.cell, {0, 0, 0}, inside(node)};
    for (std::size_t a = 0; a < 3; ++a) {
      open.face[a] = is_open_face(a, node[a]) ? (node[a] < 0 ? -1 : 1) : 0;
    }
    visit(open);
  });
}

// A node of open faces: from its neighbour that lies on one open face less.
void DualNodes::settle(const Index3& node) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (is_open_face(a, node[a])) {
      Index3 inner = node;
      inner[a] += node[a] < 0 ? 1 : -1;
      const DualEdge edge{node[a] < 0 ? node : inner, a};
      inside_[number(node)] = inside_[number(inner)] ^ named_[id_of(edge)];
      return;
    }
  }
}

// All free ones: from a neighbour that is known. In a group without one the centre whose fraction
// is furthest from 1/2 is as this says; the edges tell the others.
void DualNodes::settle_by_neighbours() {
  std::vector<std::uint8_t> is_known(inside_.size());
  for_each_node(first_, last_, [&](const Index3& node) {
    is_known[number(node)] = is_free(stand_of(node)) ? 0 : 1;
  });
  const auto settle_one = [&](const Index3& node) {
    for (std::size_t a = 0; a < 3; ++a) {
      for (const std::int64_t step : {-1, 1}) {
        Index3 other = node;
        other[a] += step;
        const DualEdge edge{step < 0 ? other : node, a};
        if (exists(edge) && is_known[number(other)] != 0) {
          inside_[number(node)] = inside_[number(other)] ^ named_[id_of(edge)];
          is_known[number(node)] = 1;
          return true;
        }
      }
    }
    return false;
  };
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    std::optional<Index3> surest;
    double sureness = -1.0;
    for_each_node(first_, last_, [&](const Index3& node) {
      if (is_known[number(node)] == 0) {
        const bool is_settled = settle_one(node);
        goes_on = goes_on || is_settled;
        const Stand stand = stand_of(node);
        const double sure = std::abs(specimen_->fraction(stand.cell) - 0.5) - stand.open_faces;
        if (!is_settled && (!surest || sure > sureness)) {
          surest = node;
          sureness = sure;
        }
      }
    });
    if (!goes_on && surest) {
      const std::size_t at = number(*surest);
      inside_[at] = specimen_->fraction(stand_of(*surest).cell) >= 0.5 ? 1 : 0;
      is_known[at] = 1;
      goes_on = true;
    }
  }
}

Finding DualNodes::check_edges() const {
  Finding finding;
  for_each_node(first_, last_, [&](const Index3& node) {
    for (std::size_t a = 0; a < 3; ++a) {
      const DualEdge edge{node, a};
      if (finding || !exists(edge)) {
        continue;
      }
      Index3 upper = node;
      ++upper[a];
      const bool crossed = inside(node) != inside(upper);
      if (crossed != (named_[id_of(edge)] != 0)) {
        finding = {crossed ? "a crossed edge without vertex" : "a vertex on an edge not crossed",
                   "from node " + node_text(node)};
      }
    }
  });
  return finding;
}

Finding DualNodes::build(const Specimen& specimen, std::span<const std::uint64_t> ids) {
  measure(specimen);
  const auto count = static_cast<std::size_t>(size_[0] * size_[1] * size_[2]);
  named_.assign(3 * count, 0);
  for (const std::uint64_t id : ids) {
    named_[id] = 1;
  }
  inside_.assign(count, 0);
  bool any_free = false;
  for_each_node(first_, last_, [&](const Index3& node) {
    const std::optional<double> known = fraction(node);
    any_free = any_free || !known;
    inside_[number(node)] = known && *known >= 0.5 ? 1 : 0;
  });
  if (with_surfaces_) {
    settle_by_neighbours();
    return check_edges();
  }
  for (int faces = 1; any_free && faces <= 3; ++faces) {
    for_each_node(first_, last_, [&](const Index3& node) {
      const Stand stand = stand_of(node);
      if (is_free(stand) && stand.open_faces == faces) {
        settle(node);
      }
    });
  }
  return check_edges();
}

}  // namespace difmesh::attack
