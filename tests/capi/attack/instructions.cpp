#include "instructions.hpp"

#include "planes/kernels.hpp"

namespace difmesh::attack {
namespace {

constexpr detail::Instructions kSets[] = {detail::Instructions::baseline,
                                          detail::Instructions::avx2, detail::Instructions::avx512};

}  // namespace

int instruction_sets() {
  int count = 0;
  for (const detail::Instructions set : kSets) {
    count += detail::has_instructions(set) ? 1 : 0;
  }
  return count;
}

void use_instruction_set(int number) {
  for (const detail::Instructions set : kSets) {
    if (detail::has_instructions(set) && number-- == 0) {
      detail::use_instructions(set);
    }
  }
}

}  // namespace difmesh::attack
