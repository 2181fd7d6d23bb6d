// The kernels, for the instruction set that the including file is compiled for. No include guard is
// wanted: each of these files includes it once. Nothing here may call inline functions of other
// headers than those of the same namespace; see lanes.hpp.

#include "planes/columns_abreast.hpp"
#include "planes/height_columns.hpp"
#include "planes/kernels.hpp"
#include "planes/normal_math.hpp"
#include "planes/plane_fit_math.hpp"
#include "planes/plane_math.hpp"
#include "planes/window_math.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {
namespace {

// One lane per cell; slopes are of the heights along the two axes across.
struct HeightLanes {
  double axis[kBatch];   // of the heights; none: 3
  double sense[kBatch];  // 1 where the material is at the low end
  double low[2][kBatch];
  double high[2][kBatch];
};

// Bits of the cells whose normals point along each axis, and of those among them with the material
// at the low end.
struct Pointing {
  unsigned along[3];
  unsigned material_low[3];

  [[gnu::always_inline]] void add(const Triple<Lanes>& normal, int first) {
    const Lanes largest =
        larger(larger(magnitude(normal.v[0]), magnitude(normal.v[1])), magnitude(normal.v[2]));
    const Lanes limit = largest * (1.0 - kTie);
    for (int axis = 0; axis < 3; ++axis) {
      along[axis] |= bits_of(magnitude(normal.v[axis]) >= limit) << first;
      material_low[axis] |= bits_of(normal.v[axis] > broadcast(0.0)) << first;
    }
  }
};

template <class T>
[[gnu::always_inline]] inline void gather_heights(const PlaneTask<T>& task,
                                                  const CellBatch<T>& cells,
                                                  const Pointing& pointing, PlaneBatch& planes,
                                                  HeightLanes& lanes) {
  const unsigned(&along)[3] = pointing.along;
  const unsigned(&material_low)[3] = pointing.material_low;
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
        const bool is_mate =
            place >= 0 && place < kAbreast - 2 && (cells.reach[m] >> axis & 1) != 0;
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
[[gnu::always_inline]] inline void take_heights(const HeightLanes& lanes, int first,
                                                Triple<Lanes>& normal) {
  const Lanes axis = load(lanes.axis + first);
  const Lanes sense = load(lanes.sense + first);
  const auto slope = [&](int t) __attribute__((always_inline)) {
    return -((load(lanes.high[t] + first) - load(lanes.low[t] + first)) * 0.5);
  };
  const Lanes slope0 = slope(0);
  const Lanes slope1 = slope(1);
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
[[gnu::always_inline]] inline void transpose(const V4 (&row)[kLanes], Floats8 (&columns)[3]) {
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
[[gnu::always_inline]] inline void gather_row(const T* const (&row)[kLanes],
                                              T (&columns)[3][kLanes]) {
  if constexpr (sizeof(T) == sizeof(float) && kIsFloating<T>) {
    Floats4 four[kLanes];
    for (int n = 0; n < kLanes; ++n) {
      four[n] = load_elements<Floats4>(row[n] - 1);
    }
    Floats8 transposed[3];
    transpose(four, transposed);
    __builtin_memcpy(columns, transposed, sizeof columns);
  } else {
    for (int n = 0; n < kLanes; ++n) {
      for (int i = 0; i < 3; ++i) {
        columns[i][n] = row[n][i - 1];
      }
    }
  }
}

template <class T>
[[gnu::always_inline]] inline void gather_neighbours(const PlaneTask<T>& task,
                                                     const CellBatch<T>& cells, int first,
                                                     Lanes (&c)[27]) {
  const T* centre[kLanes];
  for (int n = 0; n < kLanes; ++n) {
    // Lanes without a cell repeat the first.
    centre[n] = cells.centre[first + n < cells.count ? first + n : first];
  }
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      const T* row[kLanes];
      for (int n = 0; n < kLanes; ++n) {
        row[n] = centre[n] + (k - 1) * task.strides[2] + (j - 1) * task.strides[1];
      }
      alignas(64) T columns[3][kLanes];
      gather_row(row, columns);
      for (int i = 0; i < 3; ++i) {
        c[9 * k + 3 * j + i] = lanes_of_fractions(columns[i]);
      }
    }
  }
}

// What does not depend on the type of the elements is kept out of line: it is compiled once.

// Of eight cells. Bits of the masks are cells.
struct EstimatedNormals {
  Triple<Lanes> m;
  unsigned gradient_free;
  unsigned from_youngs;
};

// Normals of eight cells from their 3x3x3 fractions.
[[gnu::noinline]] EstimatedNormals estimate_normals(const Lanes (&c)[27], bool centred_columns) {
  constexpr double kAllThere[3][3] = {{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};
  EstimatedNormals normals;
  const Triple<Lanes> gradient = youngs(c);
  const Lanes size = norm1(gradient);
  normals.gradient_free = bits_of(size < broadcast(kTie));
  normals.m = scaled(gradient, 1.0 / size);
  normals.from_youngs = (1U << kLanes) - 1U;
  if (centred_columns) {
    const MixedNormal<Lanes> mixed = mixed_normal(c, kAllThere, normals.m);
    normals.m = mixed.m;
    normals.from_youngs = bits_of(mixed.is_youngs);
  }
  return normals;
}

[[gnu::noinline]] void take_all_heights(const HeightLanes& heights, int lanes, PlaneBatch& planes) {
  for (int first = 0; first < lanes; first += kLanes) {
    Triple<Lanes> normal{
        {load(planes.m[0] + first), load(planes.m[1] + first), load(planes.m[2] + first)}};
    take_heights(heights, first, normal);
    for (int t = 0; t < 3; ++t) {
      store(normal.v[t], planes.m[t] + first);
    }
  }
}

[[gnu::noinline]] void find_offsets(double (&fraction)[kBatch], int lanes, PlaneBatch& planes) {
  // What is past the last cell may hold anything, and would cost steps.
  for (int n = lanes; n < (lanes + kChains - 1) / kChains * kChains; ++n) {
    for (double(&component)[kBatch] : planes.m) {
      component[n] = component[0];
    }
    fraction[n] = fraction[0];
  }
  for (int first = 0; first < lanes; first += kChains) {
    const auto component = [&](int t) __attribute__((always_inline)) {
      return load_lanes<Chains>(planes.m[t] + first);
    };
    store(offset_of_share(sorted(component(0), component(1), component(2)),
                          load_lanes<Chains>(fraction + first)),
          planes.a + first);
  }
}

template <class T>
void fit_planes(const PlaneTask<T>& task, const CellBatch<T>& cells, PlaneBatch& planes) {
  const int lanes = (cells.count + kLanes - 1) / kLanes * kLanes;
  alignas(64) double fraction[kBatch];
  Pointing pointing{};
  planes.gradient_free = 0;
  planes.from_youngs = 0;
  for (int first = 0; first < lanes; first += kLanes) {
    Lanes c[27];
    gather_neighbours(task, cells, first, c);
    store(c[13], fraction + first);
    const EstimatedNormals normals = estimate_normals(c, task.centred_columns);
    planes.gradient_free |= normals.gradient_free << first;
    planes.from_youngs |= normals.from_youngs << first;
    pointing.add(normals.m, first);
    for (int t = 0; t < 3; ++t) {
      store(normals.m.v[t], planes.m[t] + first);
    }
  }
  planes.gradient_free &= (1U << cells.count) - 1U;
  planes.from_heights = 0;
  planes.undone = 0;
  if (task.heights) {
    HeightLanes heights;
    for (int n = 0; n < lanes; ++n) {
      heights.axis[n] = 3.0;
      heights.sense[n] = 1.0;
      heights.low[0][n] = heights.low[1][n] = heights.high[0][n] = heights.high[1][n] = 0.0;
    }
    gather_heights(task, cells, pointing, planes, heights);
    if (planes.from_heights != 0) {
      take_all_heights(heights, lanes, planes);
    }
  }
  find_offsets(fraction, lanes, planes);
}

// Planes as EdgePlane of window.hpp has them.
struct EdgePlanes {
  Chains along, across0, across1, a;
  Mask<Chains> is_pure;
};

[[gnu::always_inline]] inline EdgePlanes edge_planes(const UnitPlane* const* plane,
                                                     const std::uint8_t* axis,
                                                     const Chains& sense) {
  // Of m, from the edge's own axis on, and then a. Where vectors are wide, their lanes are
  // exchanged faster than addresses are found.
  constexpr std::uint8_t kNext[3][4] = {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}};
  constexpr bool kByLanes = kPartLanes == kLanes;
  alignas(64) double columns[4][kChains];
  for (int n = 0; n < kChains; ++n) {
    const char* const from = reinterpret_cast<const char*>(plane[n]);
    for (int t = 0; t < 4; ++t) {
      const int place = kByLanes ? t : kNext[axis[n]][t];
      __builtin_memcpy(&columns[t][n], from + place * static_cast<int>(sizeof(double)),
                       sizeof(double));
    }
  }
  Chains along = load_lanes<Chains>(columns[0]);
  EdgePlanes planes;
  planes.across0 = load_lanes<Chains>(columns[1]);
  planes.across1 = load_lanes<Chains>(columns[2]);
  planes.a = load_lanes<Chains>(columns[3]);
  if constexpr (kByLanes) {
    alignas(64) double axes[kChains];
    for (int n = 0; n < kChains; ++n) {
      axes[n] = axis[n];
    }
    const Mask<Chains> is_x = load_lanes<Chains>(axes) == 0.0;
    const Mask<Chains> is_y = load_lanes<Chains>(axes) == 1.0;
    const Chains x = along;
    const Chains y = planes.across0;
    const Chains z = planes.across1;
    along = select(is_x, x, select(is_y, y, z));
    planes.across0 = select(is_x, y, select(is_y, z, x));
    planes.across1 = select(is_x, z, select(is_y, x, y));
  }
  along = along * sense;
  const Chains zero = constant<Chains>(0.0);
  const Mask<Chains> has_none =
      (along == zero) & (planes.across0 == zero) & (planes.across1 == zero);
  planes.is_pure = has_none & (magnitude(planes.a) >= constant<Chains>(0.5));
  // No gradient: the normal runs along the edge, towards the outer cell.
  planes.along = select(planes.is_pure, zero, select(has_none, constant<Chains>(-1.0), along));
  return planes;
}

void solve_windows(WindowBatch& batch) {
  batch.undone = 0;
  for (int first = 0; first < batch.count; first += kChains) {
    const UnitPlane* ends[2][kChains];
    for (int n = 0; n < kChains; ++n) {
      const bool upper_inside = batch.sense[first + n] > 0.0;
      ends[0][n] = upper_inside ? batch.lower[first + n] : batch.upper[first + n];
      ends[1][n] = upper_inside ? batch.upper[first + n] : batch.lower[first + n];
    }
    const Chains sense = load_lanes<Chains>(batch.sense + first);
    const EdgePlanes outside = edge_planes(ends[0], batch.axis + first, sense);
    const EdgePlanes inside = edge_planes(ends[1], batch.axis + first, sense);
    const auto prepared = [](const EdgePlanes& of) __attribute__((always_inline)) {
      return window_plane(of.along, of.across0, of.across1, of.a);
    };
    const WindowPlane<Chains> outer = prepared(outside);
    const WindowPlane<Chains> inner = prepared(inside);
    const Mask<Chains> is_done = surely_monotone(outer, inner) | outside.is_pure | inside.is_pure;
    batch.undone |= bits_of(opposite(is_done)) << first;
    const Chains zero = constant<Chains>(0.0);
    const NewtonRoot<Chains> root =
        newton(outer, inner, zero, constant<Chains>(1.0), plane_crossing(outer, inner));
    store(select(sense > zero, root.mu, 1.0 - root.mu), batch.share + first);
    store(root.steps, batch.steps + first);
  }
  batch.undone &= (1U << batch.count) - 1U;
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
