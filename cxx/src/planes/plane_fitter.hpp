#pragma once
// Normals and planes of flagged cells, row by row.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/memory_hints.hpp"
#include "difmesh/report.hpp"
#include "planes/cube_fraction.hpp"
#include "planes/fitted_normals.hpp"
#include "planes/kernels.hpp"
#include "planes/normal_stencil.hpp"
#include "planes/unit_plane.hpp"

namespace difmesh::detail {

/// What the normals of some cells came from.
struct SourceCounts {
  std::int64_t heights = 0;
  std::int64_t gradient_free = 0;

  void add(const SourceCounts& other) {
    heights += other.heights;
    gradient_free += other.gradient_free;
  }
  void add_to(Report& report) const {
    report.height_function_cells += heights;
    report.gradient_free_cells += gradient_free;
  }
};

/// The least value of T that counts as full, and the greatest that counts as empty.
template <class T>
T least_full(double purity_tolerance) {
  const double least = 1.0 - purity_tolerance;
  if constexpr (std::is_integral_v<T>) {
    T value = std::numeric_limits<T>::max();
    while (value > 0 && fraction_of(static_cast<T>(value - 1)) >= least) {
      --value;
    }
    return value;
  } else {
    const T rounded = static_cast<T>(least);
    return static_cast<double>(rounded) >= least ? rounded : std::nextafter(rounded, T(2));
  }
}

template <class T>
T most_empty(double purity_tolerance) {
  if constexpr (std::is_integral_v<T>) {
    T value = 0;
    while (value < std::numeric_limits<T>::max() &&
           fraction_of(static_cast<T>(value + 1)) <= purity_tolerance) {
      ++value;
    }
    return value;
  } else {
    const T rounded = static_cast<T>(purity_tolerance);
    return static_cast<double>(rounded) <= purity_tolerance ? rounded
                                                            : std::nextafter(rounded, T(-2));
  }
}

/// What all fitters of one field share.
template <class T>
struct FitterPlan {
  const BlockField& field;
  NormalStencil<T> stencil;
  bool has_kernel;  // for normals of this kind on fields that lie so
  PlaneTask<T> task;
  FitPlanes<T> kernel;

  FitterPlan(const BlockField& of, Normals normals)
      : field(of),
        stencil(of, normals),
        has_kernel(!is_fitted(normals) && of.view.strides[0] == 1 && !of.is_stretched),
        task{{of.view.strides[0], of.view.strides[1], of.view.strides[2]},
             normals != Normals::youngs,
             normals == Normals::height_function,
             least_full<T>(of.purity_tolerance),
             most_empty<T>(of.purity_tolerance)},
        kernel(kernels().fit_planes(T{})) {}
};

/// Which cells of a row the kernel may be asked about.
class KernelRow {
 public:
  template <class T>
  KernelRow(const FitterPlan<T>& plan, std::int64_t j, std::int64_t k)
      : field_(plan.field),
        is_inside_(plan.has_kernel && field_.margin(1, j) >= 1 && field_.margin(2, k) >= 1),
        across_((field_.margin(1, j) >= kColumnReach ? 2U : 0U) |
                (field_.margin(2, k) >= kColumnReach ? 4U : 0U)) {}

  /// True if the rows around are in memory.
  [[nodiscard]] bool is_inside() const { return is_inside_; }
  /// True if the neighbours of a cell are in memory, and rows can be read four abreast.
  [[nodiscard]] bool serves(std::int64_t i) const {
    return is_inside_ && field_.margin(0, i) >= 1 && i + 2 < field_.axes[0].high;
  }
  /// Of CellBatch.
  [[nodiscard]] std::uint8_t reach(std::int64_t i) const {
    return static_cast<std::uint8_t>((field_.margin(0, i) >= kColumnReach ? 1U : 0U) | across_ |
                                     (i + kAbreast - 2 < field_.axes[0].high ? kEightAbreast : 0U));
  }

 private:
  const BlockField& field_;
  bool is_inside_;
  unsigned across_;
};

/// Fits planes to cells, in batches where no side of the domain is near. One per thread.
template <class T>
class PlaneFitter {
 public:
  PlaneFitter(const FitterPlan<T>& plan, const NodeBits& nodes) : plan_(plan), nodes_(nodes) {}

  /// The cells of one row that words of bits flag. The planes are there after finish().
  void fit_row(std::int64_t j, std::int64_t k, const std::uint64_t* words, UnitPlane* plane) {
    const BlockField& field = plan_.field;
    const Index3 before{field.block.offset[0] - 1, j - 1 + field.block.offset[1],
                        k - 1 + field.block.offset[2]};
    const KernelRow kernel_row(plan_, before[1], before[2]);
    const T* row = static_cast<const T*>(field.view.data);
    if (kernel_row.is_inside()) {
      row += field.element({field.axes[0].low, before[1], before[2]});
    }
    const CrossedAcross crossed(nodes_, j, k);
    const T* last_line = nullptr;
    for (std::int64_t w = 0; w < nodes_.words(); ++w) {
      for (std::uint64_t left = words[w]; left != 0; left &= left - 1, ++plane) {
        const std::int64_t i = 64 * w + std::countr_zero(left) + before[0];
        if (!kernel_row.serves(i)) {
          fit_alone({i, before[1], before[2]}, *plane);
          continue;
        }
        const std::uint8_t reach = kernel_row.reach(i);
        const T* const centre = row + (i - field.axes[0].low);
        if (last_line == nullptr || centre - last_line >= kLine) {
          last_line = centre;
          read_ahead(centre, reach, crossed.is_y(w, left), crossed.is_z(w, left));
        }
        const int n = waiting_.count++;
        waiting_.centre[n] = centre;
        waiting_.plane[n] = plane;
        waiting_.cell[n] = {i, before[1], before[2]};
        waiting_.reach[n] = reach;
        if (waiting_.count == kWaiting) {
          fit_waiting(kBatch);
        }
      }
    }
  }

  /// Returns what came of the cells since the last time.
  SourceCounts finish() {
    fit_waiting(1);
    return std::exchange(counts_, {});
  }

 private:
  // Elements that come into the cache together.
  static constexpr std::int64_t kLine = 64 / sizeof(T);
  // Cells wait until what they read has arrived.
  static constexpr int kWaiting = 48;

  struct Waiting {
    const T* centre[kWaiting];
    UnitPlane* plane[kWaiting];
    Index3 cell[kWaiting];
    std::uint8_t reach[kWaiting];
    int count;

    void move(int from, int to) {
      centre[to] = centre[from];
      plane[to] = plane[from];
      cell[to] = cell[from];
      reach[to] = reach[from];
    }
  };

  // Where the surface crosses edges in y, or in z, at a cell: there its normal most likely points.
  class CrossedAcross {
   public:
    CrossedAcross(const NodeBits& nodes, std::int64_t j, std::int64_t k)
        : here_(nodes.row(j, k)),
          south_(nodes.row(std::max(j - 1, nodes.first()[1]), k)),
          north_(nodes.row(std::min(j + 1, nodes.last()[1]), k)),
          below_(nodes.row(j, std::max(k - 1, nodes.first()[2]))),
          above_(nodes.row(j, std::min(k + 1, nodes.last()[2]))) {}
    // At the lowest set bit of a word.
    [[nodiscard]] bool is_y(std::int64_t w, std::uint64_t bit) const {
      return (((here_[w] ^ south_[w]) | (here_[w] ^ north_[w])) & bit & -bit) != 0;
    }
    [[nodiscard]] bool is_z(std::int64_t w, std::uint64_t bit) const {
      return (((here_[w] ^ below_[w]) | (here_[w] ^ above_[w])) & bit & -bit) != 0;
    }

   private:
    const std::uint64_t* here_;
    const std::uint64_t* south_;
    const std::uint64_t* north_;
    const std::uint64_t* below_;
    const std::uint64_t* above_;
  };

  // Rows run in the order of memory, so of the columns that a cell reads, those next to its own in
  // the order of rows are new.
  void read_ahead(const T* centre, unsigned reach, bool along_y, bool along_z) const {
    const std::int64_t y = plan_.task.strides[1];
    const std::int64_t z = plan_.task.strides[2];
    const std::int64_t y_reach = along_y && (reach & 2U) != 0 ? kColumnReach : 1;
    const std::int64_t z_reach = along_z && (reach & 4U) != 0 ? kColumnReach : 1;
    hint_read(centre);
    hint_read(centre - y);
    hint_read(centre - z);
    hint_read(centre - y - z);
    for (std::int64_t n = -z_reach; n <= z_reach; ++n) {
      hint_read(centre + y + n * z);
    }
    for (std::int64_t n = -y_reach; n <= y_reach; ++n) {
      hint_read(centre + n * y + z);
    }
  }

  // Fits the cells that wait, up to fewer than `least`.
  void fit_waiting(int least) {
    int kept = 0;
    for (int n = 0; n < waiting_.count; ++n) {
      const double fraction = fraction_of(*waiting_.centre[n]);
      if (fraction == 0.0 || fraction == 1.0) {
        *waiting_.plane[n] = UnitPlane::pure(fraction == 1.0);
        continue;
      }
      waiting_.move(n, kept++);
    }
    int next = 0;
    while (kept - next >= least) {
      const int count = std::min(kBatch, kept - next);
      fit_batch(next, count);
      next += count;
    }
    waiting_.count = kept - next;
    for (int n = 0; n < waiting_.count; ++n) {
      waiting_.move(next + n, n);
    }
  }

  void fit_batch(int first, int count) {
    PlaneBatch planes;
    const CellBatch<T> batch{waiting_.centre + first, waiting_.reach + first, count};
    plan_.kernel(plan_.task, batch, planes);
    counts_.heights += count_bits(planes.from_heights);
    for (int n = 0; n < count; ++n) {
      *waiting_.plane[first + n] = {{planes.m[0][n], planes.m[1][n], planes.m[2][n]}, planes.a[n]};
    }
    for (unsigned left = planes.gradient_free | planes.undone; left != 0; left &= left - 1) {
      const int n = std::countr_zero(left);
      UnitPlane& plane = *waiting_.plane[first + n];
      if ((planes.undone >> n & 1) != 0) {
        fit_alone(waiting_.cell[first + n], plane);
      } else {
        plane = gradient_free(fraction_of(*waiting_.centre[first + n]));
      }
    }
  }

  UnitPlane gradient_free(double fraction) {
    ++counts_.gradient_free;
    return {{0.0, 0.0, 0.0}, fraction - 0.5};
  }

  void fit_alone(const Index3& cell, UnitPlane& plane) {
    const BlockField& field = plan_.field;
    Index3 resolved;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      resolved[axis] = field.axes[axis].resolve(cell[axis]);
    }
    const double fraction =
        fraction_of(static_cast<const T*>(field.view.data)[field.element(resolved)]);
    if (fraction == 0.0 || fraction == 1.0) {
      plane = UnitPlane::pure(fraction == 1.0);
      return;
    }
    const UnitNormal normal = plan_.stencil(resolved);
    if (normal.source == NormalSource::none) {
      plane = gradient_free(fraction);
      return;
    }
    counts_.heights += normal.source == NormalSource::height_function ? 1 : 0;
    plane = {normal.m, cube_offset(normal.m[0], normal.m[1], normal.m[2], fraction)};
  }

  const FitterPlan<T>& plan_;
  const NodeBits& nodes_;
  SourceCounts counts_;
  Waiting waiting_{};
};

}  // namespace difmesh::detail
