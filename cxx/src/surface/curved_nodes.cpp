#include "surface/curved_nodes.hpp"

#include <algorithm>
#include <array>

#include "base/vector3.hpp"
#include "surface/node_place.hpp"

namespace difmesh::detail {
namespace {

// Whether the surfaces around a cell agree with each other, so that its own may be believed.
bool is_settled(const SurfaceTable& table, const Index3& cell) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::int64_t step : {-1, 1}) {
      Index3 other = cell;
      other[axis] += step;
      const SurfaceAt there = table.at(other);
      if (there.ownership == Ownership::beyond || there.ownership == Ownership::bare ||
          (there.ownership == Ownership::owned && there.surface.is_kinked)) {
        return false;
      }
    }
  }
  return true;
}

// Whether a local node along an axis stands for a cell: its centre, the open or mirrored domain
// face next to it, or its image behind a periodic side.
bool stands_for(const BlockField& field, std::size_t axis, std::int64_t local, std::int64_t index) {
  const std::int64_t at = local - 1 + field.block.offset[axis];
  const std::int64_t end = field.grid.dims[axis];
  if (at >= 0 && at < end) {
    return at == index;
  }
  switch (field.boundary[2 * axis + (at < 0 ? 0 : 1)]) {
    case Side::open:
    case Side::mirror:
      return index == (at < 0 ? 0 : end - 1);
    case Side::periodic:
      return index == at || index == (at < 0 ? at + end : at - end);
    case Side::empty:
    case Side::full:
      break;
  }
  return false;
}

// Those that there are, at most three.
struct NodesOfCell {
  std::array<std::int64_t, 3> nodes{};
  std::size_t count = 0;

  NodesOfCell(const BlockField& field, const NodeBits& all, std::size_t axis, std::int64_t index) {
    const std::int64_t own = index - field.block.offset[axis] + 1;
    const std::int64_t first = all.first()[axis];
    const std::int64_t last = all.last()[axis];
    for (const std::int64_t local : {first, own, last}) {
      const bool is_new = count == 0 || local > nodes[count - 1];
      if (is_new && local >= first && local <= last && stands_for(field, axis, local, index)) {
        nodes[count++] = local;
      }
    }
  }
};

// Sets all nodes that stand for a cell.
void set_nodes(const BlockField& field, const Index3& cell, bool inside, NodeBits& nodes) {
  const NodesOfCell x(field, nodes, 0, cell[0]);
  const NodesOfCell y(field, nodes, 1, cell[1]);
  const NodesOfCell z(field, nodes, 2, cell[2]);
  for (std::size_t c = 0; c < z.count; ++c) {
    for (std::size_t b = 0; b < y.count; ++b) {
      for (std::size_t a = 0; a < x.count; ++a) {
        nodes.set({x.nodes[a], y.nodes[b], z.nodes[c]}, inside);
      }
    }
  }
}

void settle_face_node(const SurfaceTable& table, const Index3& node, DualGrid& grid) {
  if (!grid.is_extended(node, grid.origin(node))) {
    return;
  }
  const NodePlace place = place_of(table.field(), node);
  const SurfaceAt there = table.at(place.cell);
  if (there.ownership == Ownership::owned && !there.surface.is_kinked) {
    const double length = table.length(place.cell);
    grid.settle(node, there.surface.function(scaled(place.from_centre, 1.0 / length)) <= kOnNode);
  }
}

}  // namespace

std::int64_t settle_centres(SurfaceTable& table, NodeBits& nodes) {
  const BlockField& field = table.field();
  std::int64_t moved = 0;
  for (std::int64_t row = 0; row < table.rows(); ++row) {
    table.for_each_owner(row, [&](const Index3& cell, const OwnedSurface& surface) {
      const double fraction = field.fraction(cell);
      if (!(fraction > kMayFlip && fraction < 1.0 - kMayFlip) || surface.is_kinked) {
        return;
      }
      const bool inside = surface.function({0.0, 0.0, 0.0}) <= kOnNode;
      if (inside != (fraction >= 0.5) && is_settled(table, cell)) {
        set_nodes(field, cell, inside, nodes);
        table.note_moved(cell);
        moved += field.is_own(cell) ? 1 : 0;
      }
    });
  }
  return moved;
}

void settle_faces(const SurfaceTable& table, DualGrid& grid) {
  const Index3& first = grid.nodes().first();
  const Index3& last = grid.nodes().last();
  for (std::int64_t k = first[2]; k <= last[2]; ++k) {
    for (std::int64_t j = first[1]; j <= last[1]; ++j) {
      const bool is_side = j == first[1] || j == last[1] || k == first[2] || k == last[2];
      const std::int64_t step = is_side ? 1 : std::max<std::int64_t>(1, last[0] - first[0]);
      for (std::int64_t i = first[0]; i <= last[0]; i += step) {
        settle_face_node(table, {i, j, k}, grid);
      }
    }
  }
}

}  // namespace difmesh::detail
