// The kernels, for the instruction set that the including file is compiled for. No include guard is
// wanted: each of these files includes it once. Nothing here may call inline functions of other headers than
// those of the same namespace; see lanes.hpp.

#include "columns_abreast.hpp"
#include "height_columns.hpp"
#include "kernels.hpp"
#include "normal_math.hpp"
#include "plane_fit_math.hpp"
#include "plane_math.hpp"
#include "window_math.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {
namespace {

// One lane per cell; slopes are of the heights along the two axes across.
struct HeightLanes {
  double axis[kBatch];   // of the heights; none: 3
  double sense[kBatch];  // 1 where the material is at the low end
  double low[2][kBatch];
  double high[2][kBatch];
};

template <class T>
[[gnu::always_inline]] inline void gather_heights(const PlaneTask<T>& task,
                                                  const CellBatch<T>& cells,
                                                  const Triple<Lanes>& normal, PlaneBatch& planes,
                                                  HeightLanes& lanes) {
  const Lanes largest =
      larger(larger(magnitude(normal.v[0]), magnitude(normal.v[1])), magnitude(normal.v[2]));
  const Lanes limit = largest * (1.0 - kTie);
  unsigned along[3];
  unsigned material_low[3];
  for (int axis = 0; axis < 3; ++axis) {
    along[axis] = bits_of(magnitude(normal.v[axis]) >= limit);
    material_low[axis] = bits_of(normal.v[axis] > broadcast(0.0));
  }
  const unsigned ties = (along[0] & along[1]) | (along[1] & along[2]) | (along[2] & along[0]);
  unsigned left = ((1U << cells.count) - 1U) & ~planes.gradient_free;
  planes.undone = ties & left;
  left &= ~ties;
  const auto take = [&](int n, int axis, bool low, const Heights& heights)
      __attribute__((always_inline)) {
    planes.from_heights |= 1U << n;
    lanes.axis[n] = axis;
    lanes.sense[n] = low ? 1.0 : -1.0;
    for (int t = 0; t < 2; ++t) {
      lanes.low[t][n] = heights.low[t];
      lanes.high[t][n] = heights.high[t];
    }
  };
  while (left != 0) {
    const int n = __builtin_ctz(left);
    const unsigned bit = 1U << n;
    const int axis = (along[0] & bit) != 0 ? 0 : ((along[1] & bit) != 0 ? 1 : 2);
    if ((cells.reach[n] >> axis & 1) == 0) {
      planes.undone |= bit;
      left &= ~bit;
      continue;
    }
    const bool low = (material_low[axis] & bit) != 0;
    const T* const centre = cells.centre[n];
    unsigned mates = bit;
    if (axis != 0 && (cells.reach[n] & kEightAbreast) != 0) {
      const unsigned alike = left & along[axis] & (low ? material_low[axis] : ~material_low[axis]);
      for (int m = n + 1; m < cells.count; ++m) {
        const std::int64_t place = cells.centre[m] - centre;
        const bool is_mate = place >= 0 && place < kBatch - 2 && (cells.reach[m] >> axis & 1) != 0;
        mates |= (is_mate ? alike : 0U) & 1U << m;
      }
    }
    left &= ~mates;
    if (mates == bit) {
      Heights heights;
      if (find_heights(task, centre, axis, low, heights)) {
        take(n, axis, low, heights);
      }
      continue;
    }
    HeightBlock block;
    find_height_block(task, centre - 1, low ? task.strides[axis] : -task.strides[axis],
                      task.strides[3 - axis], block);
    for (; mates != 0; mates &= mates - 1) {
      const int m = __builtin_ctz(mates);
      const int place = static_cast<int>(cells.centre[m] - centre) + 1;
      if (block.is_consistent(place)) {
        take(m, axis, low, block.around(place));
      }
    }
  }
}

// Heights' normals in the lanes that have them.
[[gnu::always_inline]] inline void take_heights(const HeightLanes& lanes, Triple<Lanes>& normal) {
  const Lanes axis = load(lanes.axis);
  const Lanes sense = load(lanes.sense);
  const Lanes slope0 = -((load(lanes.high[0]) - load(lanes.low[0])) * 0.5);
  const Lanes slope1 = -((load(lanes.high[1]) - load(lanes.low[1])) * 0.5);
  const LaneMask is_x = axis == 0.0;
  const LaneMask is_y = axis == 1.0;
  const LaneMask is_z = axis == 2.0;
  Triple<Lanes> m{{select(is_x, sense, slope0), select(is_x, slope0, select(is_y, sense, slope1)),
                   select(is_z, sense, slope1)}};
  const Lanes size = norm1(m);
  for (Lanes& component : m.v) {
    component = component / size + 0.0;
  }
  m = scaled(m, 1.0 / norm1(m));
  const LaneMask takes = is_x | is_y | is_z;
  for (int t = 0; t < 3; ++t) {
    normal.v[t] = select(takes, m.v[t], normal.v[t]);
  }
}

// The values at x - 1, x and x + 1 of eight cells, whose rows of four begin at x - 1.
template <class V4>
[[gnu::always_inline]] inline void transpose(const V4 (&row)[kBatch], Floats8 (&columns)[3]) {
  Floats8 two[4];
  for (int n = 0; n < 4; ++n) {
    two[n] = __builtin_shufflevector(row[n], row[n + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  }
  const Floats8 low01 = __builtin_shufflevector(two[0], two[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const Floats8 low23 = __builtin_shufflevector(two[2], two[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const Floats8 high01 = __builtin_shufflevector(two[0], two[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const Floats8 high23 = __builtin_shufflevector(two[2], two[3], 2, 10, 3, 11, 6, 14, 7, 15);
  columns[0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
  columns[1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
  columns[2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
}

template <class T>
[[gnu::always_inline]] inline void gather_row(const T* const (&row)[kBatch],
                                              T (&columns)[3][kBatch]) {
  if constexpr (sizeof(T) == sizeof(float) && kIsFloating<T>) {
    Floats4 four[kBatch];
    for (int n = 0; n < kBatch; ++n) {
      four[n] = load_elements<Floats4>(row[n] - 1);
    }
    Floats8 transposed[3];
    transpose(four, transposed);
    __builtin_memcpy(columns, transposed, sizeof columns);
  } else {
    for (int n = 0; n < kBatch; ++n) {
      for (int i = 0; i < 3; ++i) {
        columns[i][n] = row[n][i - 1];
      }
    }
  }
}

template <class T>
[[gnu::always_inline]] inline void gather_neighbours(const PlaneTask<T>& task,
                                                     const CellBatch<T>& cells, Lanes (&c)[27]) {
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      const T* row[kBatch];
      for (int n = 0; n < kBatch; ++n) {
        row[n] = cells.centre[n < cells.count ? n : 0] + (k - 1) * task.strides[2] +
                 (j - 1) * task.strides[1];
      }
      alignas(64) T columns[3][kBatch];
      gather_row(row, columns);
      for (int i = 0; i < 3; ++i) {
        c[9 * k + 3 * j + i] = lanes_of_fractions(columns[i]);
      }
    }
  }
}

template <class T>
void fit_planes(const PlaneTask<T>& task, const CellBatch<T>& cells, PlaneBatch& planes) {
  constexpr double kAllThere[3][3] = {{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};
  Lanes c[27];
  gather_neighbours(task, cells, c);
  Triple<Lanes> normal = youngs(c);
  const Lanes size = norm1(normal);
  planes.gradient_free = bits_of(size < broadcast(kTie)) & ((1U << cells.count) - 1U);
  planes.from_heights = 0;
  planes.undone = 0;
  normal = scaled(normal, 1.0 / size);
  if (task.centred_columns) {
    normal = mixed_normal(c, kAllThere, normal).m;
  }
  if (task.heights) {
    HeightLanes lanes;
    for (int n = 0; n < kBatch; ++n) {
      lanes.axis[n] = 3.0;
      lanes.sense[n] = 1.0;
      lanes.low[0][n] = lanes.low[1][n] = lanes.high[0][n] = lanes.high[1][n] = 0.0;
    }
    gather_heights(task, cells, normal, planes, lanes);
    if (planes.from_heights != 0) {
      take_heights(lanes, normal);
    }
  }
  for (int t = 0; t < 3; ++t) {
    store(normal.v[t], planes.m[t]);
  }
  store(offset_of_share(sorted(normal.v[0], normal.v[1], normal.v[2]), c[13]), planes.a);
}

// Eight planes as EdgePlane of window.hpp has them.
struct EdgePlanes {
  Lanes along, across0, across1, a;
  LaneMask is_pure;
};

[[gnu::always_inline]] inline EdgePlanes edge_planes(const void* const (&plane)[kBatch],
                                                     const Lanes& axis, const Lanes& sense) {
  alignas(64) double columns[4][kBatch];
  for (int n = 0; n < kBatch; ++n) {
    double values[4];
    __builtin_memcpy(values, plane[n], sizeof values);
    for (int t = 0; t < 4; ++t) {
      columns[t][n] = values[t];
    }
  }
  const Lanes x = load(columns[0]);
  const Lanes y = load(columns[1]);
  const Lanes z = load(columns[2]);
  const LaneMask is_x = axis == 0.0;
  const LaneMask is_y = axis == 1.0;
  const Lanes zero = broadcast(0.0);
  EdgePlanes planes;
  planes.a = load(columns[3]);
  planes.across0 = select(is_x, y, select(is_y, z, x));
  planes.across1 = select(is_x, z, select(is_y, x, y));
  const Lanes along = select(is_x, x, select(is_y, y, z)) * sense;
  const LaneMask has_none = (x == zero) & (y == zero) & (z == zero);
  planes.is_pure = has_none & (magnitude(planes.a) >= broadcast(0.5));
  // No gradient: the normal runs along the edge, towards the outer cell.
  planes.along = select(planes.is_pure, zero, select(has_none, broadcast(-1.0), along));
  return planes;
}

void solve_windows(WindowBatch& batch) {
  const void* ends[2][kBatch];
  for (int n = 0; n < kBatch; ++n) {
    const bool upper_inside = batch.sense[n] > 0.0;
    ends[0][n] = upper_inside ? batch.lower[n] : batch.upper[n];
    ends[1][n] = upper_inside ? batch.upper[n] : batch.lower[n];
  }
  const Lanes axis = load(batch.axis);
  const Lanes sense = load(batch.sense);
  const EdgePlanes outside = edge_planes(ends[0], axis, sense);
  const EdgePlanes inside = edge_planes(ends[1], axis, sense);
  const auto prepared = [](const EdgePlanes& of) __attribute__((always_inline)) {
    return window_plane(of.along, of.across0, of.across1, of.a);
  };
  const WindowPlane<Lanes> outer = prepared(outside);
  const WindowPlane<Lanes> inner = prepared(inside);
  const unsigned there = batch.count == kBatch ? 0xffU : (1U << batch.count) - 1U;
  batch.undone = ~bits_of(surely_monotone(outer, inner) | outside.is_pure | inside.is_pure) & there;
  const NewtonRoot<Lanes> root =
      newton(outer, inner, broadcast(0.0), broadcast(1.0), plane_crossing(outer, inner));
  store(select(sense > broadcast(0.0), root.mu, 1.0 - root.mu), batch.share);
  store(root.steps, batch.steps);
}

void fit_plane_to_neighbours(FitTask& task) {
  PlaneSearch(task).run(task.m);
}

// True if all bits of a group are those of `value`, zero or one.
template <class T>
[[gnu::always_inline]] inline bool is_all(const T* values, T value) {
  constexpr int kVectors = static_cast<int>(kGroup * sizeof(T) / sizeof(LaneBits));
  T repeated[sizeof(LaneBits) / sizeof(T)];
  for (T& each : repeated) {
    each = value;
  }
  LaneBits wanted;
  __builtin_memcpy(&wanted, repeated, sizeof wanted);
  LaneBits differing = wanted ^ wanted;
  for (int n = 0; n < kVectors; ++n) {
    LaneBits bits;
    __builtin_memcpy(&bits,
                     reinterpret_cast<const char*>(values) + n * static_cast<int>(sizeof bits),
                     sizeof bits);
    differing = differing | (bits ^ wanted);
  }
  return !any_bit(differing);
}

// Eight elements, to be compared.
[[gnu::always_inline]] inline Floats8 elements_of_group(const float* values) {
  return load_elements<Floats8>(values);
}
[[gnu::always_inline]] inline Lanes elements_of_group(const double* values) {
  return load(values);
}

template <class T>
[[gnu::always_inline]] inline void classify_mixed(const GroupTask<T>& task, const T* values,
                                                  std::int64_t group, GroupFacts& facts) {
  std::uint64_t inside = 0;
  std::uint64_t interfacial = 0;
  unsigned outside = 0;
  Lanes sum = broadcast(0.0);
  for (int n = 0; n < kGroup; n += kLanes) {
    sum = sum + lanes_of_fractions(values + n);
    const auto eight = elements_of_group(values + n);
    inside |= static_cast<std::uint64_t>(bits_of(eight >= static_cast<T>(0.5))) << n;
    interfacial |= static_cast<std::uint64_t>(bits_of((eight > task.low) & (eight < task.high)))
                   << n;
    outside |= ~bits_of((eight >= static_cast<T>(0)) & (eight <= static_cast<T>(1)));
  }
  facts.inside[group] = inside;
  facts.outside |= static_cast<std::uint64_t>((outside & 0xffU) != 0) << group;
  facts.interfacial += __builtin_popcountll(interfacial);
  facts.sum += ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

template <class T>
void classify_groups(const GroupTask<T>& task, GroupFacts& facts) {
  facts.outside = 0;
  for (std::int64_t group = 0; group < task.groups; ++group) {
    const T* const values = task.values + group * kGroup;
    if (values[0] == static_cast<T>(0) && is_all(values, static_cast<T>(0))) {
      facts.inside[group] = 0;
    } else if (values[0] == static_cast<T>(1) && is_all(values, static_cast<T>(1))) {
      facts.inside[group] = ~std::uint64_t{0};
      facts.sum += static_cast<double>(kGroup);
    } else {
      classify_mixed(task, values, group, facts);
    }
  }
}

}  // namespace

const Kernels kKernels{fit_planes<float>,         fit_planes<double>,     fit_planes<std::uint8_t>,
                       fit_planes<std::uint16_t>, solve_windows,          fit_plane_to_neighbours,
                       classify_groups<float>,    classify_groups<double>};

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
