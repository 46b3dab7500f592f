// The kernels on rows of bits, built as level_kernels_impl.hpp is, and with the same rules.
//
// Rows have a few to a few hundred words, and their ends are not padded: so whole vectors come first, then
// single words, by one function for both.

#include <stddef.h>
#include <stdint.h>

#include "engine/bit_kernels.hpp"

namespace coordreq::COORDREQ_KERNEL_NAMESPACE {
namespace {

/// The two widths. Types of their own, as a template argument would lose the attributes of a vector.
struct Whole {
  typedef uint64_t Vector __attribute__((vector_size(COORDREQ_VECTOR_BYTES), may_alias));
  static constexpr size_t kCount = COORDREQ_VECTOR_BYTES / sizeof(uint64_t);
};
struct Single {
  typedef uint64_t Vector __attribute__((vector_size(8), may_alias));
  static constexpr size_t kCount = 1;
};

template <class Width>
inline __attribute__((always_inline)) typename Width::Vector load(const uint64_t* row) {
  typename Width::Vector v;
  __builtin_memcpy(&v, row, sizeof(v));
  return v;
}

template <class Width>
inline __attribute__((always_inline)) void store(const typename Width::Vector& v, uint64_t* row) {
  __builtin_memcpy(row, &v, sizeof(v));
}

template <class Width>
inline __attribute__((always_inline)) uint64_t together(const typename Width::Vector& v) {
  uint64_t bits = 0;
  for (size_t i = 0; i < Width::kCount; ++i) bits |= v[i];
  return bits;
}

template <class Width>
inline __attribute__((always_inline)) size_t and_shifted_by(const uint64_t* bits, size_t lane, size_t count,
                                                            uint64_t* target, size_t words, size_t w) {
  for (; w + Width::kCount <= words; w += Width::kCount) {
    typename Width::Vector all = load<Width>(target + w);
    for (size_t at = lane; at < lane + count; ++at) {
      const uint64_t* const from = bits + at / 64 + w;
      const uint64_t shift = at % 64;
      // In two steps above, as a shift by 64 has no meaning.
      all &= load<Width>(from) >> shift | load<Width>(from + 1) << (63 - shift) << 1;
    }
    store<Width>(all, target + w);
  }
  return w;
}

void and_shifted(const uint64_t* bits, size_t lane, size_t count, uint64_t* target, size_t words) {
  const size_t done = and_shifted_by<Whole>(bits, lane, count, target, words, 0);
  and_shifted_by<Single>(bits, lane, count, target, words, done);
}

template <class Width>
inline __attribute__((always_inline)) size_t compare_by(const uint64_t* a, const uint64_t* b, size_t words,
                                                        size_t w, uint64_t& both, uint64_t& only_a) {
  typename Width::Vector in_both{};
  typename Width::Vector in_a{};
  for (; w + Width::kCount <= words; w += Width::kCount) {
    in_both |= load<Width>(a + w) & load<Width>(b + w);
    in_a |= load<Width>(a + w) & ~load<Width>(b + w);
  }
  both |= together<Width>(in_both);
  only_a |= together<Width>(in_a);
  return w;
}

int compare(const uint64_t* a, const uint64_t* b, size_t words) {
  uint64_t both = 0;
  uint64_t only_a = 0;
  const size_t done = compare_by<Whole>(a, b, words, 0, both, only_a);
  compare_by<Single>(a, b, words, done, both, only_a);
  return (both != 0 ? 1 : 0) + (only_a != 0 ? 2 : 0);
}

template <class Width>
inline __attribute__((always_inline)) size_t join_by(const uint64_t* source, const uint64_t* whole,
                                                     uint64_t* target, size_t words, size_t w,
                                                     uint64_t& missing) {
  typename Width::Vector left{};
  for (; w + Width::kCount <= words; w += Width::kCount) {
    const typename Width::Vector all = load<Width>(source + w) | load<Width>(target + w);
    store<Width>(all, target + w);
    left |= load<Width>(whole + w) & ~all;
  }
  missing |= together<Width>(left);
  return w;
}

bool join(const uint64_t* source, const uint64_t* whole, uint64_t* target, size_t words) {
  uint64_t missing = 0;
  const size_t done = join_by<Whole>(source, whole, target, words, 0, missing);
  join_by<Single>(source, whole, target, words, done, missing);
  return missing == 0;
}

}  // namespace

extern const BitKernels kBitKernels;
const BitKernels kBitKernels{and_shifted, compare, join};

}  // namespace coordreq::COORDREQ_KERNEL_NAMESPACE
