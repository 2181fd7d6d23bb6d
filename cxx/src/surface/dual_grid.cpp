#include "surface/dual_grid.hpp"

#include "planes/cube_fraction.hpp"
#include "planes/unit_plane.hpp"

namespace difmesh::detail {
namespace {

// Fractions this close to 0 or 1 along an open face, with no crossed edge at their cell, are no
// film on the face: solvers leave such smears, and a plane fitted to them is worth nothing.
constexpr double kFilm = 0.01;

double stretched_coordinate(const BlockField& field, std::size_t axis, std::int64_t index) {
  const std::vector<double>& faces = field.grid.faces[axis];
  const std::int64_t count = field.grid.dims[axis];
  Index3 cell{0, 0, 0};
  if (index < 0 || index >= count) {
    const Side side = field.boundary[2 * axis + (index < 0 ? 0 : 1)];
    if (side == Side::open || side == Side::mirror) {
      return index < 0 ? faces.front() : faces.back();
    }
    if (side == Side::periodic) {
      return field.grid.cell_centre(cell)[axis] + (faces.back() - faces.front());
    }
  }
  cell[axis] = index;
  return field.grid.cell_centre(cell)[axis];
}

// Domain faces, to the bit, for nodes on open and mirror sides; else cell centres or their
// continuation.
double node_coordinate(const BlockField& field, std::size_t axis, std::int64_t index) {
  if (!field.grid.is_uniform(axis)) {
    return stretched_coordinate(field, axis, index);
  }
  const double origin = field.grid.origin[axis];
  const double spacing = field.grid.spacing[axis];
  const std::int64_t count = field.grid.dims[axis];
  if (index < 0 || index >= count) {
    const Side side = field.boundary[2 * axis + (index < 0 ? 0 : 1)];
    if (side == Side::open || side == Side::mirror) {
      return index < 0 ? origin : origin + static_cast<double>(count) * spacing;
    }
    if (side == Side::periodic) {
      // The image of cell 0: one period further, to the last bit.
      return (origin + 0.5 * spacing) + static_cast<double>(count) * spacing;
    }
  }
  return origin + (static_cast<double>(index) + 0.5) * spacing;
}

}  // namespace

UnitPlane trace(const UnitPlane& plane, const std::array<int, 3>& face) {
  UnitPlane result = plane;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (face[axis] != 0) {
      result.a -= 0.5 * face[axis] * plane.m[axis];
      result.m[axis] = 0.0;
    }
  }
  return result;
}

DualGrid::DualGrid(const BlockField& field, NodeBits nodes)
    : field_(&field), nodes_(std::move(nodes)) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    coordinates_[axis].resize(static_cast<std::size_t>(nodes_.last()[axis]) + 1);
    for (std::int64_t local = 0; local <= nodes_.last()[axis]; ++local) {
      coordinates_[axis][static_cast<std::size_t>(local)] =
          node_coordinate(field, axis, local - 1 + field.block.offset[axis]);
    }
  }
}

void DualGrid::set_planes(PlaneTable planes, bool extend) {
  planes_ = std::move(planes);
  extend_ = extend;
  if (!extend) {
    return;
  }
  // The cells along the sides, those of the next block included whose nodes this one has too.
  const Index3& dims = field_->block.dims;
  const Index3& last = nodes_.last();
  for (std::int64_t k = 1; k <= last[2]; ++k) {
    for (std::int64_t j = 1; j <= last[1]; ++j) {
      if (planes_.is_empty(nodes_.row_index(j, k))) {
        continue;
      }
      const bool whole_row = j == 1 || j == dims[1] || k == 1 || k == dims[2];
      const std::int64_t step = whole_row || dims[0] == 1 ? 1 : dims[0] - 1;
      for (std::int64_t i = 1; i <= last[0]; i += step) {
        if (planes_.has({i, j, k})) {
          settle_around({i, j, k});
        }
      }
    }
  }
}

// Settles the nodes beyond the block that stand for this cell and lie on an open face.
void DualGrid::settle_around(const Index3& cell) {
  for (int n = 0; n < 27; ++n) {
    const Index3 node{cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1};
    bool exists = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      exists = exists && node[axis] >= nodes_.first()[axis] && node[axis] <= nodes_.last()[axis];
    }
    if (!exists) {
      continue;
    }
    const NodeOrigin from = origin(node);
    if (from.cell == cell && is_extended(node, from)) {
      nodes_.set(node, trace(planes_.at(cell), from.face).is_centre_inside());
    }
  }
}

NodeOrigin DualGrid::origin(const Index3& node) const {
  NodeOrigin result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.cell[axis] = node[axis];
    if (node[axis] >= 1 && node[axis] <= field_->block.dims[axis]) {
      continue;
    }
    const std::int64_t index = node[axis] - 1 + field_->block.offset[axis];
    const std::int64_t resolved = field_->axes[axis].resolve(index);
    if (resolved == kMissing) {
      result.face[axis] = index < 0 ? -1 : 1;
      result.cell[axis] = index < 0 ? 1 : field_->block.dims[axis];
    } else if (!is_cell(resolved)) {
      result.constant = true;
    } else if (field_->boundary[2 * axis + (index < 0 ? 0 : 1)] == Side::mirror &&
               resolved != index) {
      result.cell[axis] = resolved - field_->block.offset[axis] + 1;
    }
  }
  return result;
}

double DualGrid::cell_fraction(const Index3& node, const NodeOrigin& origin) const {
  Index3 resolved;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t local = origin.constant ? node[axis] : origin.cell[axis];
    resolved[axis] = field_->axes[axis].resolve(local - 1 + field_->block.offset[axis]);
    if (resolved[axis] == kMissing) {
      resolved[axis] = 0;  // any: what is beyond the side of another axis has the say
    }
  }
  return field_->fraction(resolved);
}

UnitPlane DualGrid::cell_plane(const Index3& node, const NodeOrigin& origin) const {
  return !origin.constant && planes_.has(origin.cell)
             ? planes_.at(origin.cell)
             : UnitPlane::pure(is_cell_inside(node, origin));
}

bool DualGrid::is_extended(const Index3& node, const NodeOrigin& origin) const {
  if (!extend_ || origin.constant || !origin.on_face() || !planes_.has(origin.cell) ||
      !planes_.at(origin.cell).has_normal()) {
    return false;
  }
  const double fraction = cell_fraction(node, origin);
  return field_->is_interfacial(fraction) &&
         ((fraction > kFilm && fraction < 1.0 - kFilm) || has_crossed_edge(origin.cell));
}

// Asks the field, not the flags: these do not know of edges that leave the block.
bool DualGrid::has_crossed_edge(const Index3& cell) const {
  const bool inside = nodes_.test(cell);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Index3 resolved;
    for (std::size_t t = 0; t < 3; ++t) {
      resolved[t] = field_->axes[t].resolve(cell[t] - 1 + field_->block.offset[t]);
    }
    for (const int step : {-1, 1}) {
      const std::int64_t index = cell[axis] - 1 + field_->block.offset[axis] + step;
      resolved[axis] = field_->axes[axis].resolve(index);
      if (resolved[axis] != kMissing && (field_->fraction(resolved) >= 0.5) != inside) {
        return true;
      }
    }
  }
  return false;
}

double DualGrid::node_fraction(const Index3& node) const {
  const NodeOrigin from = origin(node);
  if (is_extended(node, from)) {
    const UnitPlane plane = trace(planes_.at(from.cell), from.face);
    return cube_fraction(plane.m[0], plane.m[1], plane.m[2], plane.a);
  }
  return cell_fraction(node, from);
}

}  // namespace difmesh::detail
