#include "engine/level_kernels.hpp"

#include "base/fast_paths.hpp"
#include "engine/bit_kernels.hpp"
#include "engine/sum_kernels.hpp"

namespace coordreq {

#define COORDREQ_DECLARE_KERNELS(set)                  \
  namespace set {                                      \
  extern const LevelKernels<std::uint8_t> kKernels8;   \
  extern const LevelKernels<std::uint16_t> kKernels16; \
  extern const LevelKernels<std::uint32_t> kKernels32; \
  extern const LevelKernels<std::uint64_t> kKernels64; \
  extern const SumKernels kSumKernels;                 \
  extern const BitKernels kBitKernels;                 \
  }
COORDREQ_DECLARE_KERNELS(portable_kernels)
#if COORDREQ_X86_KERNELS
COORDREQ_DECLARE_KERNELS(avx2_kernels)
COORDREQ_DECLARE_KERNELS(avx512_kernels)
#endif
#undef COORDREQ_DECLARE_KERNELS

InstructionSet best_instruction_set() {
  if (!fast_paths().vector_instructions) return InstructionSet::portable;
#if COORDREQ_X86_KERNELS
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq")) {
    return InstructionSet::avx512;
  }
  if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::portable;
}

namespace {

template <class Kernels>
const Kernels& choose([[maybe_unused]] InstructionSet set, const Kernels& portable,
                      [[maybe_unused]] const Kernels& avx2, [[maybe_unused]] const Kernels& avx512) {
#if COORDREQ_X86_KERNELS
  if (set == InstructionSet::avx512) return avx512;
  if (set == InstructionSet::avx2) return avx2;
#endif
  return portable;
}

}  // namespace

#if !COORDREQ_X86_KERNELS
namespace avx2_kernels = portable_kernels;
namespace avx512_kernels = portable_kernels;
#endif

template <>
const LevelKernels<std::uint8_t>& level_kernels(InstructionSet set) {
  return choose(set, portable_kernels::kKernels8, avx2_kernels::kKernels8, avx512_kernels::kKernels8);
}
template <>
const LevelKernels<std::uint16_t>& level_kernels(InstructionSet set) {
  return choose(set, portable_kernels::kKernels16, avx2_kernels::kKernels16, avx512_kernels::kKernels16);
}
template <>
const LevelKernels<std::uint32_t>& level_kernels(InstructionSet set) {
  return choose(set, portable_kernels::kKernels32, avx2_kernels::kKernels32, avx512_kernels::kKernels32);
}
template <>
const LevelKernels<std::uint64_t>& level_kernels(InstructionSet set) {
  return choose(set, portable_kernels::kKernels64, avx2_kernels::kKernels64, avx512_kernels::kKernels64);
}

const SumKernels& sum_kernels(InstructionSet set) {
  return choose(set, portable_kernels::kSumKernels, avx2_kernels::kSumKernels, avx512_kernels::kSumKernels);
}

const BitKernels& bit_kernels(InstructionSet set) {
  return choose(set, portable_kernels::kBitKernels, avx2_kernels::kBitKernels, avx512_kernels::kBitKernels);
}

}  // namespace coordreq
