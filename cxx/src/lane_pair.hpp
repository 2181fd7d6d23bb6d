#pragma once
// Sixteen doubles at a time, in two halves that do not wait for each other: long chains of operations leave machines with
// wide vectors half idle. What lanes.hpp says of eight lanes holds here too.

#include "lanes.hpp"

namespace difmesh::detail::DIFMESH_INSTRUCTIONS {

template <class Half>
struct Pair {
  Half first;
  Half second;
};
using LanePair = Pair<Lanes>;
using MaskPair = Pair<LaneMask>;
using BitsPair = Pair<LaneBits>;

template <>
struct MaskOf<LanePair> {
  using type = MaskPair;
};
template <>
struct BitsOf<LanePair> {
  using type = BitsPair;
};

#define DIFMESH_PAIR(Result, Operand, Scalar, op)                                        \
  [[gnu::always_inline]] inline Result operator op(const Operand& a, const Operand& b) { \
    return {a.first op b.first, a.second op b.second};                                   \
  }                                                                                      \
  [[gnu::always_inline]] inline Result operator op(const Operand& a, Scalar b) {         \
    return {a.first op b, a.second op b};                                                \
  }                                                                                      \
  [[gnu::always_inline]] inline Result operator op(Scalar a, const Operand& b) {         \
    return {a op b.first, a op b.second};                                                \
  }
DIFMESH_PAIR(LanePair, LanePair, double, +)
DIFMESH_PAIR(LanePair, LanePair, double, -)
DIFMESH_PAIR(LanePair, LanePair, double, *)
DIFMESH_PAIR(LanePair, LanePair, double, /)
DIFMESH_PAIR(MaskPair, LanePair, double, <)
DIFMESH_PAIR(MaskPair, LanePair, double, <=)
DIFMESH_PAIR(MaskPair, LanePair, double, >)
DIFMESH_PAIR(MaskPair, LanePair, double, >=)
DIFMESH_PAIR(MaskPair, LanePair, double, ==)
DIFMESH_PAIR(BitsPair, BitsPair, unsigned long long, +)
DIFMESH_PAIR(BitsPair, BitsPair, unsigned long long, *)
#undef DIFMESH_PAIR
[[gnu::always_inline]] inline MaskPair operator&(const MaskPair& a, const MaskPair& b) {
  return {a.first & b.first, a.second & b.second};
}
[[gnu::always_inline]] inline MaskPair operator|(const MaskPair& a, const MaskPair& b) {
  return {a.first | b.first, a.second | b.second};
}
[[gnu::always_inline]] inline BitsPair operator>>(const BitsPair& a, int by) {
  return {a.first >> by, a.second >> by};
}
[[gnu::always_inline]] inline BitsPair operator<<(const BitsPair& a, int by) {
  return {a.first << by, a.second << by};
}
[[gnu::always_inline]] inline LanePair operator-(const LanePair& a) {
  return {-a.first, -a.second};
}

[[gnu::always_inline]] inline LanePair select(const MaskPair& choose, const LanePair& yes,
                                              const LanePair& no) {
  return {select(choose.first, yes.first, no.first), select(choose.second, yes.second, no.second)};
}
[[gnu::always_inline]] inline LanePair magnitude(const LanePair& value) {
  return {magnitude(value.first), magnitude(value.second)};
}
[[gnu::always_inline]] inline LanePair square_root(const LanePair& value) {
  return {square_root(value.first), square_root(value.second)};
}
[[gnu::always_inline]] inline unsigned bits_of(const MaskPair& mask) {
  return bits_of(mask.first) | bits_of(mask.second) << kLanes;
}
[[gnu::always_inline]] inline MaskPair opposite(const MaskPair& mask) {
  return {opposite(mask.first), opposite(mask.second)};
}

/// As many lanes as a chain of operations is best taken with.
#if defined(__AVX512F__)
using Chains = LanePair;
#else
using Chains = Lanes;
#endif
inline constexpr int kChains = static_cast<int>(sizeof(Chains) / sizeof(double));

[[gnu::always_inline]] inline void store(const LanePair& lanes, double* values) {
  store(lanes.first, values);
  store(lanes.second, values + kLanes);
}
template <class R>
[[gnu::always_inline]] inline R load_lanes(const double* values) {
  if constexpr (sizeof(R) == sizeof(Lanes)) {
    return load(values);
  } else {
    return {load(values), load(values + kLanes)};
  }
}

}  // namespace difmesh::detail::DIFMESH_INSTRUCTIONS
