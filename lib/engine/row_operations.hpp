#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "engine/cell_set.hpp"

// Rows of n bits take ceil(n / 64) words; bits beyond n are zero.
namespace coordreq {

using Word = CellSet::Word;
using ConstRow = std::span<const Word>;
using MutableRow = std::span<Word>;

/// Sets bits [begin, end) and leaves the others.
void set_bits(MutableRow row, std::int64_t begin, std::int64_t end);
/// Sets the bits of `target` that are set in `source`, moved up by `offset`. @pre `target` has them
void add_bits(ConstRow source, std::int64_t offset, MutableRow target);
[[nodiscard]] bool any_set(ConstRow row);
/// True if every bit of `a` is set in `b`. @pre equally many words
[[nodiscard]] bool is_subset(ConstRow a, ConstRow b);

/// Calls `visit(position)` for every set bit.
template <class Visit>
void for_each_bit(ConstRow row, const Visit& visit) {
  for (std::size_t w = 0; w < row.size(); ++w) {
    for (Word word = row[w]; word != 0; word &= word - 1) {
      visit(static_cast<std::int64_t>(w) * CellSet::kWordBits + std::countr_zero(word));
    }
  }
}

}  // namespace coordreq
