#include "planes/kernels.hpp"

#include <atomic>

namespace difmesh::detail {
namespace {

const Kernels* kernels_of(Instructions instructions) {
  switch (instructions) {
#ifdef DIFMESH_WITH_AVX
    case Instructions::avx512:
      return &avx512::kKernels;
    case Instructions::avx2:
      return &avx2::kKernels;
#endif
    default:
      return &baseline::kKernels;
  }
}

const Kernels* best() {
#ifndef DIFMESH_PREFER_BASELINE
  for (const Instructions instructions : {Instructions::avx512, Instructions::avx2}) {
    if (has_instructions(instructions)) {
      return kernels_of(instructions);
    }
  }
#endif
  return kernels_of(Instructions::baseline);
}

std::atomic<const Kernels*> chosen{nullptr};

}  // namespace

bool has_instructions(Instructions instructions) {
  switch (instructions) {
#ifdef DIFMESH_WITH_AVX
    case Instructions::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
             __builtin_cpu_supports("popcnt") != 0;
    case Instructions::avx2:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("popcnt") != 0;
#endif
    case Instructions::baseline:
      return true;
    default:
      return false;
  }
}

const Kernels& kernels() {
  const Kernels* known = chosen.load(std::memory_order_relaxed);
  if (known == nullptr) {
    // Threads that come here at once all find the same.
    known = best();
    chosen.store(known, std::memory_order_relaxed);
  }
  return *known;
}

Instructions instructions_in_use() {
  const Kernels* const known = &kernels();
  for (const Instructions instructions : {Instructions::avx512, Instructions::avx2}) {
    if (known == kernels_of(instructions)) {
      return instructions;
    }
  }
  return Instructions::baseline;
}

void use_instructions(Instructions instructions) {
  chosen.store(kernels_of(instructions), std::memory_order_relaxed);
}

}  // namespace difmesh::detail
