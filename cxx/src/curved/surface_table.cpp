#include "curved/surface_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "curved/kinks.hpp"
#include "curved/surface_maker.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kRowsPerPortion = 8;

// Of the level set through the cell's centre.
double bend_of(const LocalSurface& surface) {
  const LevelCurvature curvature = curvature_of(surface.jet({0.0, 0.0, 0.0}));
  return std::abs(curvature.mean) + curvature.spread();
}

}  // namespace

double OwnedSurface::function(const Vec3& x) const {
  const Vec3 seen{sense[0] * x[0], sense[1] * x[1], sense[2] * x[2]};
  double sum = 0.0;
  for (const PositionGraph& graph : graphs) {
    sum += graph.function(seen);
  }
  return sum / static_cast<double>(graphs.size());
}

FunctionJet OwnedSurface::jet(const Vec3& x) const {
  const Vec3 seen{sense[0] * x[0], sense[1] * x[1], sense[2] * x[2]};
  FunctionJet sum;
  for (const PositionGraph& graph : graphs) {
    sum.add(graph.jet(seen), 1.0 / static_cast<double>(graphs.size()));
  }
  for (std::size_t a = 0; a < 3; ++a) {
    sum.gradient[a] *= sense[a];
    for (std::size_t b = 0; b < 3; ++b) {
      sum.hessian[a][b] *= sense[a] * sense[b];
    }
  }
  return sum;
}

double centre_distance(const BlockField& field, std::size_t axis, std::int64_t index,
                       std::int64_t steps) {
  if (field.grid.is_uniform(axis)) {
    return static_cast<double>(steps) * field.grid.spacing[axis];
  }
  double distance = 0.0;
  const std::int64_t step = steps < 0 ? -1 : 1;
  for (std::int64_t n = 0; n != steps; n += step) {
    distance += 0.5 * static_cast<double>(step) *
                (field.width(axis, index + n) + field.width(axis, index + n + step));
  }
  return distance;
}

SurfaceTable::SurfaceTable(const BlockField& field, Phases& phases, double weight)
    : field_(field), uniform_length_(unit_length(field, field.block.offset)) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t offset = field.block.offset[axis];
    const std::int64_t end = offset + field.block.dims[axis];
    low_[axis] = std::max(field.axes[axis].low, offset - kSurfaceLayers);
    dims_[axis] = std::min(field.axes[axis].high, end + kSurfaceLayers) - low_[axis];
  }
  make(phases, 0.8 * weight);
  find_kinks(phases, 0.2 * weight);
}

void SurfaceTable::make(Phases& phases, double weight) {
  // What came of some rows: entries row by row, and their graphs.
  struct Portion {
    std::vector<std::int64_t> counts;
    std::vector<Entry> entries;
    std::vector<PositionGraph> graphs;
  };
  std::vector<Portion> portions(
      static_cast<std::size_t>((rows() + kRowsPerPortion - 1) / kRowsPerPortion));
  with_scalar(field_.view.type, [&](auto type) {
    using T = decltype(type);
    const SurfaceMaker<T> maker(field_, CellSurfaceKind::position);
    const auto make_row = [&](std::int64_t row, Portion& portion) {
      const Index3 start = start_of(row);
      const T* const cells = static_cast<const T*>(field_.view.data) + field_.element(start);
      const std::size_t before = portion.entries.size();
      for (std::int64_t i = 0; i < dims_[0]; ++i) {
        if (!field_.is_interfacial(fraction_of(cells[i * field_.view.strides[0]]))) {
          continue;
        }
        const LocalSurface surface = maker({start[0] + i, start[1], start[2]});
        Entry entry;
        entry.place = static_cast<std::int32_t>(i);
        entry.graph_count = static_cast<std::uint8_t>(surface.count);
        entry.first_graph = static_cast<std::int64_t>(portion.graphs.size());
        for (int n = 0; n < surface.count; ++n) {
          portion.graphs.emplace_back(surface.graphs[static_cast<std::size_t>(n)]);
        }
        entry.bend = surface.count > 0 ? bend_of(surface) : 0.0;
        portion.entries.push_back(entry);
      }
      portion.counts.push_back(static_cast<std::int64_t>(portion.entries.size() - before));
    };
    phases.run(weight, rows(), kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t row = begin; row < end; ++row) {
        make_row(row, portions[static_cast<std::size_t>(begin / kRowsPerPortion)]);
      }
    });
  });
  starts_.assign(1, 0);
  std::size_t entries = 0;
  std::size_t graphs = 0;
  for (const Portion& portion : portions) {
    for (const std::int64_t count : portion.counts) {
      starts_.push_back(starts_.back() + count);
    }
    entries += portion.entries.size();
    graphs += portion.graphs.size();
  }
  entries_.reserve(entries);
  graphs_.reserve(graphs);
  for (Portion& portion : portions) {
    const auto before = static_cast<std::int64_t>(graphs_.size());
    for (Entry& entry : portion.entries) {
      entry.first_graph += before;
    }
    entries_.insert(entries_.end(), portion.entries.begin(), portion.entries.end());
    graphs_.insert(graphs_.end(), portion.graphs.begin(), portion.graphs.end());
    portion = {};
  }
  for (std::int64_t row = 0; row < this->rows(); ++row) {
    for_each_owner(row, [&](const Index3& cell, const OwnedSurface&) {
      own_surfaces_ += field_.is_own(cell) ? 1 : 0;
    });
  }
}

void SurfaceTable::find_kinks(Phases& phases, double weight) {
  phases.run(weight, rows(), kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const Index3 start = start_of(row);
      for (std::int64_t n = starts_[static_cast<std::size_t>(row)];
           n < starts_[static_cast<std::size_t>(row) + 1]; ++n) {
        Entry& entry = entries_[static_cast<std::size_t>(n)];
        if (entry.graph_count > 0) {
          const Index3 cell{start[0] + entry.place, start[1], start[2]};
          entry.is_kinked = is_kinked(*this, cell, surface_of(entry));
        }
      }
    }
  });
}

const SurfaceTable::Entry* SurfaceTable::find(const Index3& cell) const {
  const std::int64_t row = (cell[2] - low_[2]) * dims_[1] + (cell[1] - low_[1]);
  const auto begin = entries_.begin() + starts_[static_cast<std::size_t>(row)];
  const auto end = entries_.begin() + starts_[static_cast<std::size_t>(row) + 1];
  const auto found =
      std::lower_bound(begin, end, cell[0] - low_[0],
                       [](const Entry& entry, std::int64_t place) { return entry.place < place; });
  return found != end && found->place == cell[0] - low_[0] ? &*found : nullptr;
}

OwnedSurface SurfaceTable::surface_of(const Entry& entry) const {
  OwnedSurface surface;
  surface.graphs = {graphs_.data() + entry.first_graph, entry.graph_count};
  surface.bend = entry.bend;
  surface.is_kinked = entry.is_kinked;
  return surface;
}

SurfaceTable::Place SurfaceTable::place_of_cell(const Index3& cell) const {
  Place place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisCells& cells = field_.axes[axis];
    std::int64_t index = cell[axis];
    while (is_cell(index) && (index < cells.low || index >= cells.high)) {
      const std::int64_t nearer = cells.beyond(index);
      const bool is_mirrored = is_cell(nearer) && cells.boundary[index < 0 ? 0 : 1] == Side::mirror;
      place.sense[axis] = is_mirrored ? -place.sense[axis] : place.sense[axis];
      index = nearer;
    }
    place.is_constant = place.is_constant || index == kEmptyBeyond || index == kFullBeyond;
    place.is_elsewhere = place.is_elsewhere || index == kMissing || index < low_[axis] ||
                         index >= low_[axis] + dims_[axis];
    place.cell[axis] = index;
  }
  return place;
}

SurfaceAt SurfaceTable::at(const Index3& cell) const {
  SurfaceAt result;
  const Place place = place_of_cell(cell);
  if (place.is_elsewhere && !place.is_constant) {
    return result;
  }
  result.ownership = Ownership::pure;
  const Entry* const entry = place.is_constant ? nullptr : find(place.cell);
  if (entry != nullptr) {
    result.ownership = entry->graph_count > 0 ? Ownership::owned : Ownership::bare;
    result.surface = surface_of(*entry);
    result.surface.sense = place.sense;
  }
  return result;
}

void SurfaceTable::note_moved(const Index3& cell) {
  const std::int64_t number = find(cell) - entries_.data();
  entries_[static_cast<std::size_t>(number)].is_moved = true;
}

bool SurfaceTable::is_moved(const Index3& cell) const {
  const Place place = place_of_cell(cell);
  if (place.is_constant || place.is_elsewhere) {
    return false;
  }
  const Entry* const entry = find(place.cell);
  return entry != nullptr && entry->is_moved;
}

}  // namespace difmesh::detail
