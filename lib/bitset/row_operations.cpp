#include "bitset/row_operations.hpp"

#include <algorithm>

namespace coordreq {
namespace {

constexpr std::int64_t kBits = CellSet::kWordBits;

std::size_t word_of(std::int64_t bit) {
  return static_cast<std::size_t>(bit / kBits);
}

/// Ones at [begin, end) of word w.
Word mask_within(std::int64_t w, std::int64_t begin, std::int64_t end) {
  const std::int64_t low = std::clamp<std::int64_t>(begin - w * kBits, 0, kBits);
  const std::int64_t high = std::clamp<std::int64_t>(end - w * kBits, 0, kBits);
  if (low >= high) return 0;
  const Word up_to_high = high == kBits ? ~Word{0} : (Word{1} << high) - 1;
  return up_to_high & (~Word{0} << low);
}

bool end_bit(Outside rule, ConstRow row, std::int64_t position) {
  if (rule == Outside::saturate || rule == Outside::stop)
    return (row[word_of(position)] >> (position % kBits) & 1) != 0;
  return rule == Outside::safe;
}

/// Word w of the bits shifted down by `distance` (towards bit 0); zeros come in above `size` words.
Word shifted_down(const Word* words, std::size_t size, std::size_t w, std::int64_t distance) {
  const std::size_t source = w + word_of(distance);
  const std::int64_t rest = distance % kBits;
  const Word low = source < size ? words[source] >> rest : 0;
  if (rest == 0 || source + 1 >= size) return low;
  return low | words[source + 1] << (kBits - rest);
}

struct Window {
  std::int64_t first;
  std::int64_t last;
};

/// Beyond n everything looks the same, so larger offsets mean no more than +-n.
Window window_on_line(std::int32_t low, std::int32_t high, std::int64_t n) {
  return {std::clamp<std::int64_t>(low, -n, n), std::clamp<std::int64_t>(high, -n, n)};
}

/// The same cells with -n/2 < first <= n/2, so that at most one copy of the row is needed before it.
Window window_on_ring(std::int32_t low, std::int32_t high, std::int64_t n) {
  std::int64_t first = (low % n + n) % n;
  if (first > n / 2) first -= n;
  return {first, first + std::min(std::int64_t{high} - low, n - 1)};
}

}  // namespace

void set_bits(MutableRow row, std::int64_t begin, std::int64_t end) {
  if (begin >= end) return;
  for (std::int64_t w = begin / kBits; w <= (end - 1) / kBits; ++w) {
    row[static_cast<std::size_t>(w)] |= mask_within(w, begin, end);
  }
}

bool all_set(ConstRow row, std::int64_t begin, std::int64_t end) {
  if (begin >= end) return true;
  for (std::int64_t w = begin / kBits; w <= (end - 1) / kBits; ++w) {
    const Word mask = mask_within(w, begin, end);
    if ((row[static_cast<std::size_t>(w)] & mask) != mask) return false;
  }
  return true;
}

bool any_set(ConstRow row) {
  return std::any_of(row.begin(), row.end(), [](Word word) { return word != 0; });
}

/// Ors the row in at bit `position` of the buffer, without what falls outside of it.
void RowEroder::place(ConstRow row, std::int64_t position) {
  const std::int64_t rest = (position % kBits + kBits) % kBits;
  const std::int64_t offset = (position - rest) / kBits;
  const auto size = static_cast<std::int64_t>(buffer_.size());
  const auto put = [&](std::int64_t w, Word bits) {
    if (0 <= w && w < size) buffer_[static_cast<std::size_t>(w)] |= bits;
  };
  for (std::size_t w = 0; w < row.size(); ++w) {
    const std::int64_t target = offset + static_cast<std::int64_t>(w);
    put(target, row[w] << rest);
    if (rest != 0) put(target + 1, row[w] >> (kBits - rest));
  }
}

void RowEroder::erode(ConstRow row, std::int64_t n, std::int32_t low, std::int32_t high, RowEnds ends,
                      MutableRow out) {
  const bool is_ring = ends.below == Outside::periodic;
  const Window window = is_ring ? window_on_ring(low, high, n) : window_on_line(low, high, n);
  const std::int64_t left = std::max<std::int64_t>(0, -window.first);
  const std::int64_t right = std::max<std::int64_t>(0, window.last);
  const std::int64_t length = left + n + right;
  const std::size_t size = word_of(length - 1) + 1;
  buffer_.assign(size, 0);
  if (is_ring) {
    for (std::int64_t at = left - n; at < length; at += n) place(row, at);
  } else {
    place(row, left);
    if (end_bit(ends.below, row, 0)) set_bits(buffer_, 0, left);
    if (end_bit(ends.above, row, n - 1)) set_bits(buffer_, left + n, length);
  }

  const std::int64_t width = window.last - window.first + 1;
  for (std::int64_t done = 1; done < width;) {
    const std::int64_t step = std::min(done, width - done);
    for (std::size_t w = 0; w < size; ++w) buffer_[w] &= shifted_down(buffer_.data(), size, w, step);
    done += step;
  }
  for (std::size_t w = 0; w < out.size(); ++w) {
    out[w] = shifted_down(buffer_.data(), size, w, window.first + left) &
             mask_within(static_cast<std::int64_t>(w), 0, n);
  }
}

}  // namespace coordreq
