#pragma once

#include <vector>

#include "engine/level_kernels.hpp"

namespace coordreq {

/// The instruction sets that kernels are built for and that this processor has.
inline std::vector<InstructionSet> sets_at_hand() {
  std::vector<InstructionSet> sets = {InstructionSet::portable};
  if (best_instruction_set() != InstructionSet::portable) sets.push_back(InstructionSet::avx2);
  if (best_instruction_set() == InstructionSet::avx512) sets.push_back(InstructionSet::avx512);
  return sets;
}

}  // namespace coordreq
