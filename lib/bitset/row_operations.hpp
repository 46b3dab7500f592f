#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitset/cell_set.hpp"
#include "spec/problem_spec.hpp"

// Operations on one row of bits. Rows of n bits take ceil(n / 64) words; bits beyond n are zero.
namespace coordreq {

using Word = CellSet::Word;
using ConstRow = std::span<const Word>;
using MutableRow = std::span<Word>;

/// Sets bits [begin, end) and leaves the others.
void set_bits(MutableRow row, std::int64_t begin, std::int64_t end);
/// True if all bits [begin, end) are set; true for an empty range.
[[nodiscard]] bool all_set(ConstRow row, std::int64_t begin, std::int64_t end);
[[nodiscard]] bool any_set(ConstRow row);

/// The row as it goes on beyond its ends: what a post that leaves there meets.
struct RowEnds {
  /// unsafe: zeros; safe: ones; saturate and stop: the first bit goes on; periodic (both ends): the row
  /// itself.
  Outside below = Outside::unsafe;
  Outside above = Outside::unsafe;  ///< likewise, with the last bit
};

/// Erosion by the window [low, high]: bit x of the result is the AND of bits x + low, ..., x + high of `row`
/// continued by `ends`. So {x : [x + low, x + high] inside the set} for a whole row at once, in
/// O(log(high - low + 1)) passes over the words (the window doubles with each pass).
class RowEroder {
 public:
  /// REQUIRES: low <= high; `out` has as many words as `row`. `out` may be `row`.
  void erode(ConstRow row, std::int64_t n, std::int32_t low, std::int32_t high, RowEnds ends, MutableRow out);

 private:
  void place(ConstRow row, std::int64_t position);

  std::vector<Word> buffer_;  ///< the row and as much of what lies beyond its ends as the window reaches
};

}  // namespace coordreq
