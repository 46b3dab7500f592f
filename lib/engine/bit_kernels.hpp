#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/level_kernels.hpp"

namespace coordreq {

/// Operations on rows of bits, 64 a word. Exactly the words named are read and written.
struct BitKernels {
  /// target[w] &= the 64 bits from bit lane + s + 64 * w of `bits` on, for all s < count and w < words.
  /// @pre unchecked: the word after the last of these bits may be read, too.
  void (*and_shifted)(const std::uint64_t* bits, std::size_t lane, std::size_t count, std::uint64_t* target,
                      std::size_t words);
  /// 1 if some bit is in both rows, plus 2 if some bit of `a` is not in `b`.
  int (*compare)(const std::uint64_t* a, const std::uint64_t* b, std::size_t words);
  /// target |= source. @returns whether target then has all bits of `whole`.
  bool (*join)(const std::uint64_t* source, const std::uint64_t* whole, std::uint64_t* target,
               std::size_t words);
};

[[nodiscard]] const BitKernels& bit_kernels(InstructionSet set);

}  // namespace coordreq
