#pragma once
// Columns of heights that run across x, eight neighbours at a time: cells of a row share most of
// theirs.

#include "planes/height_columns.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

typedef double Doubles2 __attribute__((vector_size(16)));
typedef long long Longs2 __attribute__((vector_size(16)));
template <>
struct OrderOf<Doubles2> {
  using type = Longs2;
};

// Elements of as many columns as the machine takes at once, and as many doubles.
template <class T>
struct Abreast {
#if defined(__AVX__)
  using V = Eight<T>;
  using Wide = Doubles8;
#else
  using V = Four<T>;
  using Wide = Doubles4;
#endif
};
template <>
struct Abreast<double> {
#if defined(__AVX512F__)
  using V = Doubles8;
#elif defined(__AVX__)
  using V = Doubles4;
#else
  using V = Doubles2;
#endif
  using Wide = V;
};

template <class V>
[[gnu::always_inline]] inline V in_range(const V& values) {
  const V zero{};
  const V one = zero + 1;
  const V above = values > zero ? values : zero;
  return above < one ? above : one;
}
#if defined(__AVX__)
[[gnu::always_inline]] inline Floats8 in_range(const Floats8& values) {
  return (Floats8)_mm256_min_ps(_mm256_max_ps((__m256)values, _mm256_setzero_ps()),
                                _mm256_set1_ps(1.0F));
}
[[gnu::always_inline]] inline Doubles4 in_range(const Doubles4& values) {
  return (Doubles4)_mm256_min_pd(_mm256_max_pd((__m256d)values, _mm256_setzero_pd()),
                                 _mm256_set1_pd(1.0));
}
#endif

/// Heights of 3x8 columns, `across` apart and next to each other along x.
struct HeightBlock {
  double height[3][kAbreast];
  unsigned inconsistent;  ///< bit per place along x: one of its three columns is

  /// Those of the columns about the middle one at a place along x, 1 to 6.
  [[nodiscard]] Heights around(int place) const {
    return {{height[1][place - 1], height[0][place]}, {height[1][place + 1], height[2][place]}};
  }
  [[nodiscard]] bool is_consistent(int place) const {
    return (inconsistent >> (place - 1) & 7U) == 0;
  }
};

/// `first` is the middle cell of the middle row at place 0; `along` leads from the material's end
/// to the other.
template <class T>
[[gnu::always_inline]] inline void find_height_block(const PlaneTask<T>& task, const T* first,
                                                     std::int64_t along, std::int64_t across,
                                                     HeightBlock& block) {
  using V = typename Abreast<T>::V;
  using I = Order<V>;
  constexpr int kWidth = static_cast<int>(sizeof(V) / sizeof(V{}[0]));
  using Wide = typename Abreast<T>::Wide;
  block.inconsistent = 0;
  for (int place = 0; place < kAbreast; place += kWidth) {
    ColumnCheck<I> check;
    for (int row = 0; row < 3; ++row) {
      const T* const start = first + (row - 1) * across + place - kColumnReach * along;
      Wide value[kColumn];
#pragma GCC unroll 9
      for (int n = 0; n < kColumn; ++n) {
        V cells = load_elements<V>(start + n * along);
        if constexpr (kIsFloating<T>) {
          cells = in_range(cells);
          value[n] = converted<Wide>(cells);
        } else {
          value[n] = fractions<T, Wide>(cells);
        }
        check.add(n, filled_at(task, (I)cells));
      }
      check.end();
      const Wide height = height_of(value);
      __builtin_memcpy(block.height[row] + place, &height, sizeof height);
    }
    block.inconsistent |= negative_bits(check.wrong) << place;
  }
}

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
