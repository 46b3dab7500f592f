#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "base/zeroed_array.hpp"

namespace coordreq {

/// A set of cells of a grid, one bit a cell, in rows along the last dimension.
///
/// Row-major linear index = row * row_length + column. Each row starts at a word of its own, so that rows can
/// be shifted and combined without their neighbours and written by different threads; the price is padding of
/// at most 63 bits a row. Invariant: padding bits are zero.
class CellSet {
 public:
  using Word = std::uint64_t;
  static constexpr std::int64_t kWordBits = 64;

  CellSet() = default;
  CellSet(std::int64_t rows, std::int64_t row_length)
      : rows_(rows),
        row_length_(row_length),
        words_per_row_((row_length + kWordBits - 1) / kWordBits),
        words_(static_cast<std::size_t>(rows * words_per_row_)) {}

  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t row_length() const { return row_length_; }
  [[nodiscard]] std::int64_t words_per_row() const { return words_per_row_; }
  [[nodiscard]] std::int64_t cells() const { return rows_ * row_length_; }

  [[nodiscard]] std::span<Word> row(std::int64_t r) {
    return {words_.data() + r * words_per_row_, static_cast<std::size_t>(words_per_row_)};
  }
  [[nodiscard]] std::span<const Word> row(std::int64_t r) const {
    return {words_.data() + r * words_per_row_, static_cast<std::size_t>(words_per_row_)};
  }
  [[nodiscard]] bool test(std::int64_t linear) const {
    const std::int64_t column = linear % row_length_;
    return (row(linear / row_length_)[static_cast<std::size_t>(column / kWordBits)] >> (column % kWordBits) &
            1) != 0;
  }
  void set(std::int64_t linear) {
    const std::int64_t column = linear % row_length_;
    row(linear / row_length_)[static_cast<std::size_t>(column / kWordBits)] |= Word{1}
                                                                               << (column % kWordBits);
  }
  void reset(std::int64_t linear) {
    const std::int64_t column = linear % row_length_;
    row(linear / row_length_)[static_cast<std::size_t>(column / kWordBits)] &=
        ~(Word{1} << (column % kWordBits));
  }
  [[nodiscard]] std::int64_t count() const { return count(0, rows_); }
  /// Cells in the rows [begin, end).
  [[nodiscard]] std::int64_t count(std::int64_t begin, std::int64_t end) const {
    std::int64_t total = 0;
    for (std::int64_t w = begin * words_per_row_; w < end * words_per_row_; ++w)
      total += std::popcount(words_[static_cast<std::size_t>(w)]);
    return total;
  }
  [[nodiscard]] std::span<const Word> words() const { return {words_.data(), words_.size()}; }
  [[nodiscard]] std::span<Word> words() { return {words_.data(), words_.size()}; }
  [[nodiscard]] bool operator==(const CellSet&) const = default;

 private:
  std::int64_t rows_ = 0;
  std::int64_t row_length_ = 0;
  std::int64_t words_per_row_ = 0;
  ZeroedArray<Word> words_;
};

}  // namespace coordreq
