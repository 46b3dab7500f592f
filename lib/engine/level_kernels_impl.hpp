// The row kernels, written once over vectors of COORDREQ_VECTOR_BYTES bytes, and built once for each
// instruction set with that set's compiler flags.
//
// Why: minima of rows are most of the work. All kernels are bound by loads, so each block of a row is loaded
// once, combined in registers, and stored once; `minimum` runs over its sources in the inner loop for that
// reason, four blocks at a time. Rows have a few hundred bytes and stay in the first-level cache. Vectors
// wider than the portable ones have the switch FastPaths::vector_instructions.
//
// Nothing of the standard library is called here: an inline function built with wide instructions could be
// the copy that the linker keeps for everybody.

#include <stddef.h>
#include <stdint.h>

#include "base/requires.hpp"
#include "engine/level_kernels.hpp"

namespace coordreq::COORDREQ_KERNEL_NAMESPACE {
namespace {

template <class Level>
struct Lanes {
  typedef Level Vector __attribute__((vector_size(COORDREQ_VECTOR_BYTES), may_alias));
  static constexpr size_t kCount = COORDREQ_VECTOR_BYTES / sizeof(Level);
};

/// Rows need not be aligned. By copies, since clang takes a reference to a vector whose lanes are a
/// template's parameter for aligned, whatever its type says.
template <class Level>
inline __attribute__((always_inline)) typename Lanes<Level>::Vector load(const Level* row) {
  typename Lanes<Level>::Vector v;
  __builtin_memcpy(&v, row, sizeof(v));
  return v;
}

template <class Level>
inline __attribute__((always_inline)) void store(const typename Lanes<Level>::Vector& v, Level* row) {
  __builtin_memcpy(row, &v, sizeof(v));
}

/// True if any lane is not zero.
template <class Vector>
inline __attribute__((always_inline)) bool any(const Vector& v) {
  typedef unsigned long long Wide __attribute__((vector_size(COORDREQ_VECTOR_BYTES), aligned(1), may_alias));
  const Wide& wide = reinterpret_cast<const Wide&>(v);
  unsigned long long together = 0;
  for (size_t i = 0; i < COORDREQ_VECTOR_BYTES / sizeof(unsigned long long); ++i) together |= wide[i];
  return together != 0;
}

/// True if any of the first `count` lanes is not zero.
template <class Vector>
inline __attribute__((always_inline)) bool any_before(const Vector& v, size_t count) {
  constexpr size_t kCount = sizeof(Vector) / sizeof(v[0]);
  if (count >= kCount) return any(v);
  for (size_t i = 0; i < count; ++i) {
    if (v[i] != 0) return true;
  }
  return false;
}

/// Blocks side by side share the load of a source's address, and wait for each other less.
template <class Level, size_t kBlocks>
inline __attribute__((always_inline)) void minimum_of_blocks(const Level* const* rows, size_t count, size_t j,
                                                             Level* out) {
  constexpr size_t kCount = Lanes<Level>::kCount;
  typename Lanes<Level>::Vector least[kBlocks];
  for (size_t b = 0; b < kBlocks; ++b) least[b] = load(rows[0] + j + b * kCount);
  for (size_t k = 1; k < count; ++k) {
    const Level* const row = rows[k] + j;
    for (size_t b = 0; b < kBlocks; ++b) {
      const typename Lanes<Level>::Vector other = load(row + b * kCount);
      least[b] = least[b] < other ? least[b] : other;
    }
  }
  for (size_t b = 0; b < kBlocks; ++b) store<Level>(least[b], out + j + b * kCount);
}

template <class Level>
void minimum(const Level* const* rows, size_t count, Level* out, size_t n) {
  REQUIRES(count >= 1);
  constexpr size_t kCount = Lanes<Level>::kCount;
  size_t j = 0;
  for (; j + 3 * kCount < n; j += 4 * kCount) minimum_of_blocks<Level, 4>(rows, count, j, out);
  if (j + kCount < n) {
    minimum_of_blocks<Level, 2>(rows, count, j, out);
    j += 2 * kCount;
  }
  if (j < n) minimum_of_blocks<Level, 1>(rows, count, j, out);
}

template <class Level>
void raise(const Level* source, Level* target, size_t n) {
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount) {
    const typename Lanes<Level>::Vector a = load(source + j);
    const typename Lanes<Level>::Vector b = load(target + j);
    store<Level>(a > b ? a : b, target + j);
  }
}

template <class Level>
void raise_where(const Level* source, const Level* lanes, Level* target, size_t n) {
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount) {
    const typename Lanes<Level>::Vector a = load(source + j) & load(lanes + j);
    const typename Lanes<Level>::Vector b = load(target + j);
    store<Level>(a > b ? a : b, target + j);
  }
}

template <class Level>
void lower_where(const Level* source, const Level* lanes, Level* target, size_t n) {
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount) {
    const typename Lanes<Level>::Vector a = load(source + j) | ~load(lanes + j);
    const typename Lanes<Level>::Vector b = load(target + j);
    store<Level>(a < b ? a : b, target + j);
  }
}

template <class Level>
void lower_at(const Level* source, const Level* labels, Level label, Level* target, size_t n) {
  typedef typename Lanes<Level>::Vector Vector;
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount) {
    const Vector other = reinterpret_cast<Vector>(load(labels + j) != label);
    const Vector a = load(source + j) | other;
    const Vector b = load(target + j);
    store<Level>(a < b ? a : b, target + j);
  }
}

template <class Level>
bool is_settled(const Level* row, const Level* bound, size_t n) {
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount) {
    // bound <= row + 1 without overflow: bound is 0, or bound - 1 <= row.
    const typename Lanes<Level>::Vector b = load(bound + j);
    const auto open = (b != Level{0}) & (b - Level{1} > load(row + j));
    if (any_before(open, n - j)) return false;
  }
  return true;
}

template <class Level>
LaneRange below(const Level* row, const Level* lanes, const Level* bound, size_t n) {
  const auto is_below = [=](size_t j) { return lanes[j] != 0 && row[j] < bound[j]; };
  LaneRange range;
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount) {
    const auto found = (load(row + j) < load(bound + j)) & (load(lanes + j) != Level{0});
    if (!any_before(found, n - j)) continue;
    if (range.end == 0) range.begin = j;
    range.end = j + Lanes<Level>::kCount < n ? j + Lanes<Level>::kCount : n;
  }
  if (range.end == 0) return range;
  while (!is_below(range.begin)) ++range.begin;
  while (!is_below(range.end - 1)) --range.end;
  return range;
}

template <class Level>
void spread(const uint64_t* bits, Level* lanes, size_t n) {
  typedef typename Lanes<Level>::Vector Vector;
  constexpr size_t kCount = Lanes<Level>::kCount;
  constexpr size_t kBits = 8 * sizeof(Level);
  // Lane i looks at bit i % kBits of element i / kBits of the word.
  Vector element{};
  Vector bit{};
  for (size_t i = 0; i < kCount; ++i) {
    element[i] = static_cast<Level>(i / kBits);
    bit[i] = static_cast<Level>(Level{1} << (i % kBits));
  }
  for (size_t j = 0; j < n; j += kCount) {
    typedef uint64_t Words __attribute__((vector_size(COORDREQ_VECTOR_BYTES)));
    const Words word = Words{} + (bits[j / 64] >> (j % 64));
#if defined(__clang__)
    const Vector elements = __builtin_shufflevector(reinterpret_cast<const Vector&>(word), element);
#else
    const Vector elements = __builtin_shuffle(reinterpret_cast<const Vector&>(word), element);
#endif
    store<Level>(reinterpret_cast<Vector>((elements & bit) != Level{0}), lanes + j);
  }
}

/// One bit of each lane, lanes being all ones or 0. @pre unchecked: they are those of one vector
inline __attribute__((always_inline)) uint64_t packed(const uint8_t* lanes, [[maybe_unused]] size_t count) {
#if (COORDREQ_VECTOR_BYTES == 64 && defined(__AVX512BW__)) || \
    (COORDREQ_VECTOR_BYTES == 32 && defined(__AVX2__)) || (COORDREQ_VECTOR_BYTES == 16 && defined(__SSE2__))
  typedef char Bytes __attribute__((vector_size(COORDREQ_VECTOR_BYTES)));
  Bytes bytes;
  __builtin_memcpy(&bytes, lanes, sizeof(bytes));
#if COORDREQ_VECTOR_BYTES == 64
  return __builtin_ia32_cvtb2mask512(bytes);
#elif COORDREQ_VECTOR_BYTES == 32
  return static_cast<uint32_t>(__builtin_ia32_pmovmskb256(bytes));
#else
  return static_cast<uint32_t>(__builtin_ia32_pmovmskb128(bytes));
#endif
#else
  uint64_t bits = 0;
  for (size_t i = 0; i < count; i += 8) {
    uint64_t eight = 0;
    __builtin_memcpy(&eight, lanes + i, 8);
    // Bit i of byte i stays; the product adds up all bytes in its highest one. Little-endian, like the words.
    bits |= ((eight & 0x8040201008040201U) * 0x0101010101010101U >> 56) << i;
  }
  return bits;
#endif
}

template <class Level>
inline __attribute__((always_inline)) uint64_t packed(const Level* lanes, size_t count) {
  uint64_t bits = 0;
  for (size_t i = 0; i < count; ++i) bits |= static_cast<uint64_t>(lanes[i] & 1U) << i;
  return bits;
}

/// Stores one bit of each lane from j on, lanes being all ones or 0.
template <class Level>
inline __attribute__((always_inline)) void put_bits(const typename Lanes<Level>::Vector& lanes, size_t j,
                                                    uint64_t* bits, size_t n) {
  constexpr size_t kCount = Lanes<Level>::kCount;
  Level list[kCount];
  store<Level>(lanes, list);
  uint64_t word = packed(list, kCount);
  if (n - j < kCount) word &= (uint64_t{1} << (n - j)) - 1;
  bits[j / 64] = (j % 64 == 0 ? 0 : bits[j / 64]) | word << (j % 64);
}

template <class Level>
void top_bits(const Level* row, uint64_t* bits, size_t n) {
  typedef typename Lanes<Level>::Vector Vector;
  constexpr auto kTop = static_cast<Level>(~Level{0});
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount)
    put_bits<Level>(reinterpret_cast<Vector>(load(row + j) == kTop), j, bits, n);
}

template <class Level>
void above_bits(const Level* row, const Level* bound, uint64_t* bits, size_t n) {
  typedef typename Lanes<Level>::Vector Vector;
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount)
    put_bits<Level>(reinterpret_cast<Vector>(load(row + j) > load(bound + j)), j, bits, n);
}

template <class Level>
bool advance(const Level* next, const Level* old, Level limit, Level* out, size_t n) {
  typedef typename Lanes<Level>::Vector Vector;
  const Vector zero = Vector{} + Level{0};
  const Vector top = ~zero;
  const Vector bound = zero + limit;
  bool changed = false;
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount) {
    const Vector before = load(old + j);
    const Vector value = load(next + j);
    // Not below the limit: one more would be above it.
    const Vector stepped = value < bound ? value + Level{1} : top;
    const Vector result = before == zero ? zero : stepped;
    const Vector difference = result ^ before;
    store<Level>(result, out + j);
    changed = changed || any_before(difference, n - j);
  }
  return changed;
}

template <class Level>
bool rise(const Level* next, const Level* old, Level* out, size_t n) {
  typedef typename Lanes<Level>::Vector Vector;
  const Vector zero = Vector{} + Level{0};
  bool changed = false;
  for (size_t j = 0; j < n; j += Lanes<Level>::kCount) {
    const Vector before = load(old + j);
    const Vector value = load(next + j);
    const Vector stepped = value == zero ? zero : value - Level{1};
    const Vector risen = stepped > before ? stepped : before;
    const Vector result = before == zero ? zero : risen;
    const Vector difference = result ^ before;
    store<Level>(result, out + j);
    changed = changed || any_before(difference, n - j);
  }
  return changed;
}

template <class Level>
Level lowest_change(const Level* row, const Level* other, size_t n) {
  Level lowest = static_cast<Level>(~Level{0});
  for (size_t j = 0; j < n; ++j) {
    // The greatest level has all bits, so that there is no branch.
    const auto same = static_cast<Level>(row[j] == other[j] ? ~Level{0} : 0);
    const Level least = row[j] < other[j] ? row[j] : other[j];
    const auto changed = static_cast<Level>(least | same);
    lowest = changed < lowest ? changed : lowest;
  }
  return lowest;
}

template <class Level>
constexpr LevelKernels<Level> kKernels{
    minimum<Level>,    raise<Level>, raise_where<Level>,  lower_where<Level>, lower_at<Level>,
    is_settled<Level>, below<Level>, spread<Level>,       top_bits<Level>,    above_bits<Level>,
    advance<Level>,    rise<Level>,  lowest_change<Level>};

}  // namespace

extern const LevelKernels<uint8_t> kKernels8;
extern const LevelKernels<uint16_t> kKernels16;
extern const LevelKernels<uint32_t> kKernels32;
extern const LevelKernels<uint64_t> kKernels64;
const LevelKernels<uint8_t> kKernels8 = kKernels<uint8_t>;
const LevelKernels<uint16_t> kKernels16 = kKernels<uint16_t>;
const LevelKernels<uint32_t> kKernels32 = kKernels<uint32_t>;
const LevelKernels<uint64_t> kKernels64 = kKernels<uint64_t>;

}  // namespace coordreq::COORDREQ_KERNEL_NAMESPACE
