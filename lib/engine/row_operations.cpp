#include "engine/row_operations.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kWordBits = CellSet::kWordBits;

/// Ones at [begin, end) of word w.
Word mask_within(std::int64_t w, std::int64_t begin, std::int64_t end) {
  const std::int64_t low = std::clamp<std::int64_t>(begin - w * kWordBits, 0, kWordBits);
  const std::int64_t high = std::clamp<std::int64_t>(end - w * kWordBits, 0, kWordBits);
  if (low >= high) return 0;
  const Word up_to_high = high == kWordBits ? ~Word{0} : (Word{1} << high) - 1;
  return up_to_high & (~Word{0} << low);
}

}  // namespace

void set_bits(MutableRow row, std::int64_t begin, std::int64_t end) {
  if (begin >= end) return;
  for (std::int64_t w = begin / kWordBits; w <= (end - 1) / kWordBits; ++w) {
    row[static_cast<std::size_t>(w)] |= mask_within(w, begin, end);
  }
}

void add_bits(ConstRow source, std::int64_t offset, MutableRow target) {
  const auto shift = static_cast<unsigned>(offset % kWordBits);
  auto at = static_cast<std::size_t>(offset / kWordBits);
  for (const Word word : source) {
    if (word == 0) {
      ++at;
      continue;
    }
    REQUIRES(at < target.size());
    target[at++] |= word << shift;
    if (shift != 0 && word >> (kWordBits - shift) != 0) target[at] |= word >> (kWordBits - shift);
  }
}

bool any_set(ConstRow row) {
  return std::any_of(row.begin(), row.end(), [](Word word) { return word != 0; });
}

bool is_subset(ConstRow a, ConstRow b) {
  REQUIRES(a.size() == b.size());
  for (std::size_t w = 0; w < a.size(); ++w) {
    if ((a[w] & ~b[w]) != 0) return false;
  }
  return true;
}

}  // namespace coordreq
