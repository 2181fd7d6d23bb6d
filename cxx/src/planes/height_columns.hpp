#pragma once
// The columns of heights around a cell, for the kernels: see lanes.hpp about what may be called
// here.

#include "lanes/lanes.hpp"
#include "planes/column_rule.hpp"
#include "planes/kernels.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

typedef float Floats4 __attribute__((vector_size(16)));
typedef double Doubles4 __attribute__((vector_size(32)));
typedef std::int32_t Ints4 __attribute__((vector_size(16)));
typedef std::int32_t Ints8 __attribute__((vector_size(32)));

typedef long long Longs4 __attribute__((vector_size(32)));
typedef long long Longs8 __attribute__((vector_size(64)));
typedef double Doubles8 __attribute__((vector_size(64)));
typedef float Floats16 __attribute__((vector_size(64)));
typedef std::int32_t Ints16 __attribute__((vector_size(64)));

// Vectors of elements, and integers that are ordered as they are where none is negative. Elements
// that are integers are widened.
template <class T>
struct Elements {
  using Integer = std::int32_t;
  using Four = Ints4;
  using Eight = Ints8;
  static constexpr double kScale = sizeof(T) == 1 ? 255.0 : 65535.0;
};
template <>
struct Elements<float> {
  using Integer = std::int32_t;
  using Four = Floats4;
  using Eight = Floats8;
};
template <>
struct Elements<double> {
  using Integer = long long;
  using Four = Doubles4;
  using Eight = Doubles8;
};
template <class T>
using Four = typename Elements<T>::Four;
template <class T>
using Eight = typename Elements<T>::Eight;

template <class T>
constexpr bool kIsFloating = static_cast<T>(0.5) != static_cast<T>(0);

template <class V, class T>
[[gnu::always_inline]] inline V load_elements(const T* from) {
  V result{};
  if constexpr (kIsFloating<T>) {
    __builtin_memcpy(&result, from, sizeof result);
  } else {
    for (unsigned n = 0; n < sizeof(V) / sizeof(std::int32_t); ++n) {
      result[n] = from[n];
    }
  }
  return result;
}

template <class D, class V>
[[gnu::always_inline]] inline D converted(const V& values) {
  return __builtin_convertvector(values, D);
}
#if defined(__AVX512F__)
// GCC does these in halves.
template <>
[[gnu::always_inline]] inline Doubles8 converted(const Floats8& values) {
  return (Doubles8)_mm512_cvtps_pd((__m256)values);
}
template <>
[[gnu::always_inline]] inline Doubles8 converted(const Ints8& values) {
  return (Doubles8)_mm512_cvtepi32_pd((__m256i)values);
}
#endif

// As fraction_of() in block_field.hpp, for what is a number.
template <class T, class D, class V>
[[gnu::always_inline]] inline D fractions(const V& values) {
  const D wide = converted<D>(values);
  if constexpr (kIsFloating<T>) {
    const D zero{};
    const D one = zero + 1.0;
    const D above = wide > zero ? wide : zero;
    return above < one ? above : one;
  } else {
    return wide / Elements<T>::kScale;
  }
}

// Eight elements as fractions. Elements are taken from memory part by part: see Part.
template <class T>
[[gnu::always_inline]] inline Lanes lanes_of_fractions(const T* values) {
  typedef T Raw __attribute__((vector_size(kPartLanes * sizeof(T))));
  Lanes result;
  for (int n = 0; n < kParts; ++n) {
    Raw raw;
    __builtin_memcpy(&raw, values + n * kPartLanes, sizeof raw);
    result.part[n] = fractions<T, Part>(raw);
  }
  return result;
}

// The four heights that a normal needs: below and above the centre in the two directions across.
struct Heights {
  double low[2];
  double high[2];
};

// Elements that are not negative as integers of the same order, in vectors like V.
template <class V>
struct OrderOf;
template <>
struct OrderOf<Floats4> {
  using type = Ints4;
};
template <>
struct OrderOf<Ints4> {
  using type = Ints4;
};
template <>
struct OrderOf<Floats8> {
  using type = Ints8;
};
template <>
struct OrderOf<Floats16> {
  using type = Ints16;
};
template <>
struct OrderOf<Doubles4> {
  using type = Longs4;
};
template <>
struct OrderOf<Doubles8> {
  using type = Longs8;
};
template <>
struct OrderOf<Ints8> {
  using type = Ints8;
};
template <class V>
using Order = typename OrderOf<V>::type;

template <class T, class V>
[[gnu::always_inline]] inline Order<V> order(const V& values) {
  if constexpr (kIsFloating<T>) {
    return (Order<V>)(values > V{} ? values : V{});
  } else {
    return values;
  }
}

template <class T>
[[gnu::always_inline]] inline typename Elements<T>::Integer order_of(T value) {
  typename Elements<T>::Integer result = 0;
  if constexpr (kIsFloating<T>) {
    __builtin_memcpy(&result, &value, sizeof result);
  } else {
    result = value;
  }
  return result;
}

// By the limits of a task.
template <class T, class I>
[[gnu::always_inline]] inline Filled<I> filled_at(const PlaneTask<T>& task, const I& places) {
  return filled(places, order_of(task.least_full), order_of(task.most_empty));
}
template <class T, class V>
[[gnu::always_inline]] inline Filled<Order<V>> filled_by(const PlaneTask<T>& task,
                                                         const V& values) {
  return filled_at(task, order<T>(values));
}

// Three rows of four elements, in as many vectors as are best.
template <class T>
struct ThreeRows {
  using V = Four<T>;
  using I = Order<V>;
  static constexpr int kVectors = 3;
  // Lanes that hold the first three of each row.
  static I three_of_four() { return I{-1, -1, -1, 0}; }
  [[gnu::always_inline]] static void join(const V (&row)[3], V (&all)[3]) {
    for (int r = 0; r < 3; ++r) {
      all[r] = row[r];
    }
  }
};
#if defined(__AVX512F__)
template <>
struct ThreeRows<float> {
  using V = Floats16;
  using I = Ints16;
  static constexpr int kVectors = 1;
  static I three_of_four() { return I{-1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0, 0, 0, 0, 0}; }
  [[gnu::always_inline]] static void join(const Floats4 (&row)[3], V (&all)[1]) {
    __m512 joined = _mm512_castps128_ps512((__m128)row[0]);
    joined = _mm512_insertf32x4(joined, (__m128)row[1], 1);
    all[0] = (V)_mm512_insertf32x4(joined, (__m128)row[2], 2);
  }
};
#endif

// Bits of the lanes that are negative.
template <class I>
[[gnu::always_inline]] inline unsigned negative_bits(const I& values) {
  constexpr bool kOfFourBytes = sizeof(values[0]) == 4;
#if defined(__AVX512DQ__)
  if constexpr (sizeof(I) == 64) {
    return kOfFourBytes ? static_cast<unsigned>(_mm512_movepi32_mask((__m512i)values))
                        : static_cast<unsigned>(_mm512_movepi64_mask((__m512i)values));
  }
#endif
#if defined(__AVX__)
  if constexpr (sizeof(I) == 32) {
    return static_cast<unsigned>(kOfFourBytes ? _mm256_movemask_ps((__m256)values)
                                              : _mm256_movemask_pd((__m256d)values));
  }
#endif
  constexpr int kLaneCount = static_cast<int>(sizeof(I) / sizeof(values[0]));
  unsigned bits = 0;
#if defined(__SSE2__)
  constexpr int kPieces = static_cast<int>(sizeof(I) / sizeof(__m128i));
  __m128i piece[static_cast<std::size_t>(kPieces)];
  __builtin_memcpy(piece, &values, sizeof piece);
  for (int n = 0; n < kPieces; ++n) {
    bits |= static_cast<unsigned>(kOfFourBytes ? _mm_movemask_ps((__m128)piece[n])
                                               : _mm_movemask_pd((__m128d)piece[n]))
            << (n * kLaneCount / kPieces);
  }
#else
  for (int n = 0; n < kLaneCount; ++n) {
    bits |= static_cast<unsigned>(values[n] < 0) << n;
  }
#endif
  return bits;
}

// Nine columns that run across x, all consistent? `along` leads from the material's end to the
// other; rows of three columns lie `across` apart. Heights: [0] along x, [1] along `across`.
template <class T>
[[gnu::always_inline]] inline bool heights_across_x(const PlaneTask<T>& task, const T* centre,
                                                    std::int64_t along, std::int64_t across,
                                                    Heights& heights) {
  using Rows = ThreeRows<T>;
  ColumnCheck<typename Rows::I> check[Rows::kVectors];
  Doubles4 cells[kColumn];
#pragma GCC unroll 9
  for (int n = 0; n < kColumn; ++n) {
    const T* const place = centre + (n - kColumnReach) * along - 1;
    const Four<T> row[3] = {load_elements<Four<T>>(place - across), load_elements<Four<T>>(place),
                            load_elements<Four<T>>(place + across)};
    typename Rows::V all[Rows::kVectors];
    Rows::join(row, all);
    for (int v = 0; v < Rows::kVectors; ++v) {
      check[v].add(n, filled_by(task, all[v]));
    }
    const Four<T> three = __builtin_shufflevector(row[1], row[0], 0, 5, 2, 3);
    cells[n] = fractions<T, Doubles4>(__builtin_shufflevector(three, row[2], 0, 1, 2, 5));
  }
  bool consistent = true;
  for (int v = 0; v < Rows::kVectors; ++v) {
    check[v].end();
    consistent = consistent & (negative_bits(check[v].wrong & Rows::three_of_four()) == 0);
  }
  if (!consistent) {
    return false;
  }
  const Doubles4 height = height_of(cells);
  heights = {{height[0], height[1]}, {height[2], height[3]}};
  return true;
}

template <class T>
[[gnu::always_inline]] inline double height_along_x(const T* low_end) {
  const Doubles4 low = fractions<T, Doubles4>(load_elements<Four<T>>(low_end));
  const Doubles4 high = fractions<T, Doubles4>(load_elements<Four<T>>(low_end + 5));
  const Doubles4 pairs = low + __builtin_shufflevector(high, high, 3, 2, 1, 0);
  const Doubles4 middle = fractions<T, Doubles4>(Four<T>{} + low_end[kColumnReach]);
  return height_of_pairs(pairs, middle[0]);
}

// The same for columns along x. Heights: [0] along y, [1] along z.
template <bool kMaterialLow, class T>
[[gnu::always_inline]] inline bool heights_along_x(const PlaneTask<T>& task, const T* centre,
                                                   Heights& heights) {
  using I = Order<Eight<T>>;
  const std::int64_t y = task.strides[1];
  const std::int64_t z = task.strides[2];
  constexpr int kFirst = kMaterialLow ? 0 : 7;
  constexpr int kLast = kMaterialLow ? 7 : 0;
  I is_first{};
  is_first[kFirst] = -1;
  I is_last{};
  is_last[kLast] = -1;
  I wrong{};
  for (int v = -1; v <= 1; ++v) {
    for (int u = -1; u <= 1; ++u) {
      const T* const low_end = centre + u * y + v * z - kColumnReach;
      const auto lower = filled_by(task, load_elements<Eight<T>>(low_end));
      const auto upper = filled_by(task, load_elements<Eight<T>>(low_end + 1));
      const auto& first = kMaterialLow ? lower : upper;
      const auto& next = kMaterialLow ? upper : lower;
      wrong |=
          wrong_order(first, next) | (wrong_start(first) & is_first) | (wrong_end(next) & is_last);
    }
  }
  if (negative_bits(wrong) != 0) {
    return false;
  }
  const T* low_end = centre - kColumnReach;
  heights = {{height_along_x(low_end - y), height_along_x(low_end - z)},
             {height_along_x(low_end + y), height_along_x(low_end + z)}};
  return true;
}

template <class T>
[[gnu::always_inline]] inline bool find_heights(const PlaneTask<T>& task, const T* centre, int axis,
                                                bool material_low, Heights& heights) {
  if (axis == 0) {
    return material_low ? heights_along_x<true>(task, centre, heights)
                        : heights_along_x<false>(task, centre, heights);
  }
  const std::int64_t along = task.strides[axis];
  return heights_across_x(task, centre, material_low ? along : -along, task.strides[3 - axis],
                          heights);
}

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
