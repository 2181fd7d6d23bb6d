#include "difmesh/cell_planes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"
#include "cells/classify.hpp"
#include "difmesh/float_environment.hpp"
#include "grid/block_field.hpp"
#include "grid/cell_list.hpp"
#include "planes/cube_fraction.hpp"
#include "planes/plane_fitter.hpp"

namespace difmesh {
namespace {

using detail::BlockField;

constexpr std::int64_t kCellsPerPortion = 256;
constexpr std::int64_t kCellsPerRowPortion = 1 << 16;

BlockField whole_field(const FieldView& field, const Grid& grid, const Options& options) {
  return detail::make_block_field(field, {{0, 0, 0}, grid.dims, {}, {}}, grid, options);
}

// From a plane in the unit cell.
CellPlane in_space(const Vec3& size, const Vec3& m, double a, NormalSource source) {
  CellPlane result;
  result.source = source;
  Vec3 normal;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    normal[axis] = m[axis] / size[axis];
  }
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.plane.normal[axis] = normal[axis] / length;
  }
  result.plane.offset = a / length;
  return result;
}

// Planes of a part of the list: of most cells by the kernels, in batches.
template <class T>
class ListFitter {
 public:
  explicit ListFitter(const detail::FitterPlan<T>& plan) : plan_(plan) {}

  // The result is there after finish().
  void fit(const Index3& cell, CellPlane& plane) {
    const BlockField& field = plan_.field;
    const T* const centre = static_cast<const T*>(field.view.data) + field.element(cell);
    const double fraction = detail::fraction_of(*centre);
    const detail::KernelRow row(plan_, cell[1], cell[2]);
    if (fraction == 0.0 || fraction == 1.0 || !row.serves(cell[0])) {
      plane = fit_alone(cell);
      return;
    }
    const int n = count_++;
    centre_[n] = centre;
    reach_[n] = row.reach(cell[0]);
    cell_[n] = cell;
    plane_[n] = &plane;
    if (count_ == detail::kBatch) {
      finish();
    }
  }

  void finish() {
    if (count_ == 0) {
      return;
    }
    detail::PlaneBatch batch;
    plan_.kernel(plan_.task, {centre_, reach_, count_}, batch);
    for (int n = 0; n < count_; ++n) {
      const auto is_in = [n](unsigned mask) { return (mask >> n & 1) != 0; };
      if (is_in(batch.undone)) {
        *plane_[n] = fit_alone(cell_[n]);
      } else if (is_in(batch.gradient_free)) {
        *plane_[n] = {};
      } else {
        const NormalSource source = is_in(batch.from_heights)  ? NormalSource::height_function
                                    : is_in(batch.from_youngs) ? NormalSource::youngs
                                                               : NormalSource::centred_columns;
        *plane_[n] = in_space(plan_.field.grid.spacing,
                              {batch.m[0][n], batch.m[1][n], batch.m[2][n]}, batch.a[n], source);
      }
    }
    count_ = 0;
  }

 private:
  [[nodiscard]] CellPlane fit_alone(const Index3& cell) const {
    const detail::UnitNormal unit = plan_.stencil(cell);
    if (unit.source == NormalSource::none) {
      return {};
    }
    const double a =
        detail::cube_offset(unit.m[0], unit.m[1], unit.m[2], plan_.field.fraction(cell));
    return in_space(plan_.field.cell_size(cell), unit.m, a, unit.source);
  }

  const detail::FitterPlan<T>& plan_;
  int count_ = 0;
  const T* centre_[detail::kBatch];
  std::uint8_t reach_[detail::kBatch];
  Index3 cell_[detail::kBatch];
  CellPlane* plane_[detail::kBatch];
};

template <class T>
void list_row(const BlockField& field, std::int64_t row, std::vector<Index3>& cells) {
  const std::int64_t j = row % field.grid.dims[1];
  const std::int64_t k = row / field.grid.dims[1];
  const T* first = static_cast<const T*>(field.view.data) + field.element({0, j, k});
  for (std::int64_t i = 0; i < field.grid.dims[0]; ++i) {
    if (field.is_interfacial(detail::fraction_of(first[i * field.view.strides[0]]))) {
      cells.push_back({i, j, k});
    }
  }
}

}  // namespace

void cell_planes(const FieldView& field, const Grid& grid, std::span<const Index3> cells,
                 const Options& options, std::span<CellPlane> planes) {
  const DefaultFloatEnvironment environment;
  const BlockField block = whole_field(field, grid, options);
  detail::check_cell_list("cell_planes", grid, cells, planes.size(), "planes");
  detail::Workers workers(options.threads);
  detail::Phases phases(workers, options.progress);
  detail::with_scalar(field.type, [&](auto type) {
    using T = decltype(type);
    const detail::FitterPlan<T> plan(block, options.normals);
    phases.run(1.0, static_cast<std::int64_t>(cells.size()), kCellsPerPortion,
               [&](std::int64_t begin, std::int64_t end) {
                 ListFitter<T> fitter(plan);
                 for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end);
                      ++n) {
                   fitter.fit(cells[n], planes[n]);
                 }
                 fitter.finish();
               });
  });
  phases.finish();
}

Array<Index3> interfacial_cells(const FieldView& field, const Grid& grid, const Options& options) {
  const DefaultFloatEnvironment environment;
  const BlockField block = whole_field(field, grid, options);
  detail::Workers workers(options.threads);
  detail::Phases phases(workers, options.progress);
  detail::FieldFacts facts;
  detail::LayerPlanes no_planes;
  static_cast<void>(
      detail::classify(block, {options.overshoot_bound, no_planes}, 0.5, phases, facts));
  const std::int64_t rows = grid.dims[1] * grid.dims[2];
  const std::int64_t grain = std::max<std::int64_t>(1, kCellsPerRowPortion / grid.dims[0]);
  std::vector<std::vector<Index3>> portions(static_cast<std::size_t>((rows + grain - 1) / grain));
  detail::with_scalar(field.type, [&](auto type) {
    phases.run(0.5, rows, grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t row = begin; row < end; ++row) {
        list_row<decltype(type)>(block, row, portions[static_cast<std::size_t>(begin / grain)]);
      }
    });
  });
  Array<Index3> cells;
  cells.reserve(static_cast<std::size_t>(facts.report.interfacial_cells));
  for (const std::vector<Index3>& portion : portions) {
    cells.insert(cells.end(), portion.begin(), portion.end());
  }
  phases.finish();
  return cells;
}

}  // namespace difmesh
