#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/row_operations.hpp"

namespace coordreq {

/// Different rows of bits, each held once and numbered 0, 1, ... in the order in which they first came.
class RowNumbers {
 public:
  explicit RowNumbers(std::size_t words) : words_(words), slots_(64, kFree) {}

  /// The number of a row. REQUIRES: `row` has as many words as were said.
  std::uint32_t number(ConstRow row) {
    for (std::size_t slot = hash(row) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
      if (slots_[slot] != kFree) {
        if (std::ranges::equal((*this)[slots_[slot]], row)) return slots_[slot];
        continue;
      }
      slots_[slot] = size_;
      rows_.insert(rows_.end(), row.begin(), row.end());
      if (2 * std::size_t{++size_} > slots_.size()) grow();
      return size_ - 1;
    }
  }
  [[nodiscard]] ConstRow operator[](std::uint32_t number) const {
    return {rows_.data() + number * words_, words_};
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }

 private:
  static constexpr std::uint32_t kFree = UINT32_MAX;

  static std::size_t hash(ConstRow row) {
    Word mixed = 0;
    for (const Word word : row) {
      mixed = (mixed ^ word) * 0x9E3779B97F4A7C15U;
      mixed ^= mixed >> 32U;
    }
    return mixed;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kFree);
    for (std::uint32_t n = 0; n < size_; ++n) {
      std::size_t slot = hash((*this)[n]) & (slots_.size() - 1);
      while (slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = n;
    }
  }

  std::size_t words_;
  std::vector<Word> rows_;
  std::uint32_t size_ = 0;
  std::vector<std::uint32_t> slots_;  ///< open addressing, a power of two
};

}  // namespace coordreq
