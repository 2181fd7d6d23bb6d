#pragma once
// Eight doubles at a time, or sixteen, for the kernels, and the same operations on one double, so
// that a formula written once as a template serves both. Every operation acts on each lane as IEEE
// 754 has it, so a lane's result depends neither on its neighbours nor on the instruction set, and
// equals that of the same formula on one double.
//
// All of it lies in a namespace of its own for each instruction set: the linker must never take a
// function that was compiled for one machine for another. For the same reason nothing of the
// standard library is called here.

#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#ifndef DIFMESH_INSTRUCTIONS
#define DIFMESH_INSTRUCTIONS baseline
#endif

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

inline constexpr int kLanes = 8;

// What the machine computes with at once. Compilers make poor work of vectors wider than that, so
// eight lanes are as many parts as it takes.
#if defined(__AVX512F__)
inline constexpr int kPartLanes = 8;
#elif defined(__AVX__)
inline constexpr int kPartLanes = 4;
#else
inline constexpr int kPartLanes = 2;
#endif
inline constexpr int kParts = kLanes / kPartLanes;

template <class V, int kCount>
struct Split {
  V part[static_cast<std::size_t>(kCount)];
};
typedef double Part __attribute__((vector_size(kPartLanes * sizeof(double))));
typedef unsigned long long PartBits __attribute__((vector_size(kPartLanes * sizeof(double))));
using PartMask = decltype(Part{} < Part{});

/// Masks: all bits of a lane set, or none.
template <int kCount>
using MasksOf = Split<PartMask, kCount>;
template <int kCount>
using BitLanesOf = Split<PartBits, kCount>;
template <int kCount>
struct LanesOf : Split<Part, kCount> {
  [[gnu::always_inline]] double operator[](int n) const {
    return this->part[n / kPartLanes][n % kPartLanes];
  }
  [[gnu::always_inline]] void set(int n, double value) {
    this->part[n / kPartLanes][n % kPartLanes] = value;
  }
};
using Lanes = LanesOf<kParts>;
using LaneMask = MasksOf<kParts>;
using LaneBits = BitLanesOf<kParts>;

/// As many lanes as a chain of operations is best taken with: long ones leave machines with wide
/// vectors half idle, unless there are two that do not wait for each other.
#if defined(__AVX512F__)
using Chains = LanesOf<2 * kParts>;
#else
using Chains = Lanes;
#endif
inline constexpr int kChains = static_cast<int>(sizeof(Chains) / sizeof(double));

#define DIFMESH_FOR_PARTS(Result, expression) \
  Result<kCount> result;                      \
  for (int n = 0; n < kCount; ++n) {          \
    result.part[n] = expression;              \
  }                                           \
  return result
#define DIFMESH_BINARY(Result, Operand, Scalar, op)                                              \
  template <int kCount>                                                                          \
  [[gnu::always_inline]] inline Result<kCount> operator op(const Operand<kCount>& a,             \
                                                           const Operand<kCount>& b) {           \
    DIFMESH_FOR_PARTS(Result, a.part[n] op b.part[n]);                                           \
  }                                                                                              \
  template <int kCount>                                                                          \
  [[gnu::always_inline]] inline Result<kCount> operator op(const Operand<kCount>& a, Scalar b) { \
    DIFMESH_FOR_PARTS(Result, a.part[n] op b);                                                   \
  }                                                                                              \
  template <int kCount>                                                                          \
  [[gnu::always_inline]] inline Result<kCount> operator op(Scalar a, const Operand<kCount>& b) { \
    DIFMESH_FOR_PARTS(Result, a op b.part[n]);                                                   \
  }
DIFMESH_BINARY(LanesOf, LanesOf, double, +)
DIFMESH_BINARY(LanesOf, LanesOf, double, -)
DIFMESH_BINARY(LanesOf, LanesOf, double, *)
DIFMESH_BINARY(LanesOf, LanesOf, double, /)
DIFMESH_BINARY(MasksOf, LanesOf, double, <)
DIFMESH_BINARY(MasksOf, LanesOf, double, <=)
DIFMESH_BINARY(MasksOf, LanesOf, double, >)
DIFMESH_BINARY(MasksOf, LanesOf, double, >=)
DIFMESH_BINARY(MasksOf, LanesOf, double, ==)
DIFMESH_BINARY(BitLanesOf, BitLanesOf, unsigned long long, +)
DIFMESH_BINARY(BitLanesOf, BitLanesOf, unsigned long long, *)
DIFMESH_BINARY(BitLanesOf, BitLanesOf, unsigned long long, ^)
#undef DIFMESH_BINARY
template <int kCount>
[[gnu::always_inline]] inline MasksOf<kCount> operator&(const MasksOf<kCount>& a,
                                                        const MasksOf<kCount>& b) {
  DIFMESH_FOR_PARTS(MasksOf, a.part[n] & b.part[n]);
}
template <int kCount>
[[gnu::always_inline]] inline MasksOf<kCount> operator|(const MasksOf<kCount>& a,
                                                        const MasksOf<kCount>& b) {
  DIFMESH_FOR_PARTS(MasksOf, a.part[n] | b.part[n]);
}
template <int kCount>
[[gnu::always_inline]] inline BitLanesOf<kCount> operator|(const BitLanesOf<kCount>& a,
                                                           const BitLanesOf<kCount>& b) {
  DIFMESH_FOR_PARTS(BitLanesOf, a.part[n] | b.part[n]);
}
template <int kCount>
[[gnu::always_inline]] inline BitLanesOf<kCount> operator>>(const BitLanesOf<kCount>& a, int by) {
  DIFMESH_FOR_PARTS(BitLanesOf, a.part[n] >> by);
}
template <int kCount>
[[gnu::always_inline]] inline BitLanesOf<kCount> operator<<(const BitLanesOf<kCount>& a, int by) {
  DIFMESH_FOR_PARTS(BitLanesOf, a.part[n] << by);
}
template <int kCount>
[[gnu::always_inline]] inline LanesOf<kCount> operator-(const LanesOf<kCount>& a) {
  DIFMESH_FOR_PARTS(LanesOf, -a.part[n]);
}

template <class R>
struct MaskOf {
  using type = bool;
};
template <int kCount>
struct MaskOf<LanesOf<kCount>> {
  using type = MasksOf<kCount>;
};
/// What comparisons of R give.
template <class R>
using Mask = typename MaskOf<R>::type;

[[gnu::always_inline]] inline double select(bool choose, double yes, double no) {
  return choose ? yes : no;
}
template <int kCount>
[[gnu::always_inline]] inline LanesOf<kCount> select(const MasksOf<kCount>& choose,
                                                     const LanesOf<kCount>& yes,
                                                     const LanesOf<kCount>& no) {
  DIFMESH_FOR_PARTS(LanesOf, choose.part[n] ? yes.part[n] : no.part[n]);
}

template <class R>
[[gnu::always_inline]] inline R constant(double value) {
  if constexpr (sizeof(R) == sizeof(double)) {
    return value;
  } else {
    constexpr int kCount = static_cast<int>(sizeof(R) / sizeof(Part));
    R result;
    for (int n = 0; n < kCount; ++n) {
      result.part[n] = Part{} + value;
    }
    return result;
  }
}
[[gnu::always_inline]] inline Lanes broadcast(double value) {
  return constant<Lanes>(value);
}

// As std::min and std::max: the first argument where neither is smaller.
template <class R>
[[gnu::always_inline]] inline R smaller(const R& a, const R& b) {
  return select(b < a, b, a);
}
template <class R>
[[gnu::always_inline]] inline R larger(const R& a, const R& b) {
  return select(a < b, b, a);
}
template <class R>
[[gnu::always_inline]] inline R clamped(const R& value, const R& low, const R& high) {
  return select(value < low, low, select(high < value, high, value));
}

[[gnu::always_inline]] inline double magnitude(double value) {
  return __builtin_fabs(value);
}
template <int kCount>
[[gnu::always_inline]] inline LanesOf<kCount> magnitude(const LanesOf<kCount>& value) {
  const PartBits sign = PartBits{} + (1ULL << 63);
  DIFMESH_FOR_PARTS(LanesOf, (Part)((PartBits)value.part[n] & ~sign));
}

[[gnu::always_inline]] inline double square_root(double value) {
  return __builtin_sqrt(value);
}
[[gnu::always_inline]] inline Part square_root_of_part(const Part& value) {
#if defined(__AVX512F__)
  return (Part)_mm512_sqrt_pd((__m512d)value);
#elif defined(__AVX__)
  return (Part)_mm256_sqrt_pd((__m256d)value);
#elif defined(__SSE2__)
  return (Part)_mm_sqrt_pd((__m128d)value);
#else
  Part result;
  for (int n = 0; n < kPartLanes; ++n) {
    result[n] = __builtin_sqrt(value[n]);
  }
  return result;
#endif
}
template <int kCount>
[[gnu::always_inline]] inline LanesOf<kCount> square_root(const LanesOf<kCount>& value) {
  DIFMESH_FOR_PARTS(LanesOf, square_root_of_part(value.part[n]));
}

/// One bit per lane of the mask.
[[gnu::always_inline]] inline unsigned bits_of(bool mask) {
  return mask ? 1U : 0U;
}
[[gnu::always_inline]] inline unsigned bits_of_part(const PartMask& mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask((__m512i)mask);
#elif defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd((__m128d)mask));
#else
  unsigned bits = 0;
  for (int n = 0; n < kPartLanes; ++n) {
    bits |= static_cast<unsigned>(mask[n] & 1) << n;
  }
  return bits;
#endif
}
template <int kCount>
[[gnu::always_inline]] inline unsigned bits_of(const MasksOf<kCount>& mask) {
  unsigned bits = 0;
  for (int n = 0; n < kCount; ++n) {
    bits |= bits_of_part(mask.part[n]) << (n * kPartLanes);
  }
  return bits;
}

/// The same for eight floats.
typedef float Floats8 __attribute__((vector_size(32)));
using FloatMask8 = decltype(Floats8{} < Floats8{});
[[gnu::always_inline]] inline unsigned bits_of(const FloatMask8& mask) {
#if defined(__AVX2__)
  return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask));
#elif defined(__SSE2__)
  __m128 halves[2];
  __builtin_memcpy(halves, &mask, sizeof halves);
  return static_cast<unsigned>(_mm_movemask_ps(halves[0]) | _mm_movemask_ps(halves[1]) << 4);
#else
  unsigned bits = 0;
  for (int n = 0; n < kLanes; ++n) {
    bits |= static_cast<unsigned>(mask[n] & 1) << n;
  }
  return bits;
#endif
}

template <class M>
[[gnu::always_inline]] inline bool any(const M& mask) {
  return bits_of(mask) != 0;
}
[[gnu::always_inline]] inline bool opposite(bool mask) {
  return !mask;
}
template <int kCount>
[[gnu::always_inline]] inline MasksOf<kCount> opposite(const MasksOf<kCount>& mask) {
  DIFMESH_FOR_PARTS(MasksOf, ~mask.part[n]);
}

template <class R>
[[gnu::always_inline]] inline R load_lanes(const double* values) {
  R result;
  __builtin_memcpy(&result, values, sizeof result);
  return result;
}
[[gnu::always_inline]] inline Lanes load(const double* values) {
  return load_lanes<Lanes>(values);
}
template <int kCount>
[[gnu::always_inline]] inline void store(const LanesOf<kCount>& lanes, double* values) {
  __builtin_memcpy(values, &lanes, sizeof lanes);
}

/// The bits of a double, or of eight, shifted and masked as integers.
template <class R>
struct BitsOf {
  using type = unsigned long long;
};
template <int kCount>
struct BitsOf<LanesOf<kCount>> {
  using type = BitLanesOf<kCount>;
};

/// True if any bit is set.
[[gnu::always_inline]] inline bool any_bit(const LaneBits& bits) {
  PartBits all = bits.part[0];
  for (int n = 1; n < kParts; ++n) {
    all |= bits.part[n];
  }
  return bits_of_part(all != PartBits{}) != 0;
}

/// Cube root of x >= 0, to a unit in the last place or so.
template <class R>
[[gnu::always_inline]] inline R cube_root(const R& x) {
  using Bits = typename BitsOf<R>::type;
  // Numbers without a leading bit are scaled up; so far no power of two is lost.
  const Mask<R> tiny = x < constant<R>(0x1p-960);
  const R scaled = select(tiny, x * 0x1p+54, x);
  Bits bits;
  __builtin_memcpy(&bits, &scaled, sizeof bits);
  // A third of the exponent, and of the digits along with it: right to a twentieth.
  const Bits high = bits >> 32;
  const Bits third = (high * 0x55555556ULL) >> 32;
  const Bits guess_bits = (third + 715094163ULL) << 32;
  R guess;
  __builtin_memcpy(&guess, &guess_bits, sizeof guess);
  for (int n = 0; n < 2; ++n) {
    // Halley's step: three times the digits.
    const R cube = guess * guess * guess;
    guess = guess * ((cube + (scaled + scaled)) / (cube + cube + scaled));
  }
  guess = guess - (guess - scaled / (guess * guess)) * (1.0 / 3.0);
  return select(x > constant<R>(0.0), select(tiny, guess * 0x1p-18, guess), constant<R>(0.0));
}

#undef DIFMESH_FOR_PARTS

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
