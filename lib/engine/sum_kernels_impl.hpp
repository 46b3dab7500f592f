// The kernels on rows of boxes, built as level_kernels_impl.hpp is, and with the same rules.
//
// Two additions a side are of 64 bits, by halves; the rest is of 32 bits. There are two to four sides for
// each level that is then fetched by its offset, so that these few operations cost as much as the fetch.

#include <stddef.h>
#include <stdint.h>

#include "base/requires.hpp"
#include "engine/sum_kernels.hpp"

namespace coordreq::COORDREQ_KERNEL_NAMESPACE {
namespace {

typedef int32_t Offsets __attribute__((vector_size(COORDREQ_VECTOR_BYTES), aligned(1), may_alias));
typedef uint32_t Fractions __attribute__((vector_size(COORDREQ_VECTOR_BYTES), aligned(1), may_alias));
constexpr size_t kOffsets = COORDREQ_VECTOR_BYTES / sizeof(int32_t);

/// The upper halves of number + profile: the carry of the lower halves is a comparison.
inline __attribute__((always_inline)) Offsets upper_half(const SplitRow& profile, int64_t number, size_t c) {
  const auto fraction = static_cast<uint32_t>(static_cast<uint64_t>(number));
  const auto whole = static_cast<int32_t>(number >> 32);
  const Fractions sum = *reinterpret_cast<const Fractions*>(profile.fraction + c) + fraction;
  const Offsets carry = reinterpret_cast<Offsets>(sum < fraction);  // -1 or 0
  return *reinterpret_cast<const Offsets*>(profile.whole + c) + whole - carry;
}

void find_offsets(const BoxSides* sides, size_t size, int32_t origin, int32_t* offset, size_t n) {
  REQUIRES(size >= 1);
  for (size_t c = 0; c < n; c += kOffsets) {
    Offsets sum = Offsets{} + origin;
    for (const BoxSides* side = sides; side < sides + size; ++side) {
      const Offsets first = upper_half(side->lower_profile, side->lower, c);
      const Offsets wide = upper_half(side->upper_profile, side->upper, c) - first;
      const Offsets before = -1 - wide;
      const Offsets count = Offsets{} + side->count;
      const Offsets from = first > before ? first : before;
      const Offsets at = from < count ? from : count;
      sum += at * side->stride + wide * side->width_stride;
    }
    *reinterpret_cast<Offsets*>(offset + c) = sum;
  }
}

}  // namespace

extern const SumKernels kSumKernels;
const SumKernels kSumKernels{find_offsets};

}  // namespace coordreq::COORDREQ_KERNEL_NAMESPACE
