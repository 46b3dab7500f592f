#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/packed_pairs.hpp"
#include "engine/row_operations.hpp"
#include "model/condition_table.hpp"

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

/// Pairs of states and joint inputs that are kept: one bit row along the last state dimension for each
/// choice of the other states and the inputs in use, equal rows held once. Laid out as ConditionTable is.
class PairTable {
 public:
  /// What a condition permits.
  explicit PairTable(const ConditionTable& allow);
  /// What is listed, and permitted by a condition too. It depends on all states and inputs.
  /// @param allow may be null: everything is permitted
  /// REQUIRES: `listed` is over the cells of `grid` in its order, and over all joint inputs; grid and inputs
  /// outlive this object.
  PairTable(const UniformGrid& grid, const InputSpace& inputs, const PackedPairs& listed,
            const ConditionTable* allow, ThreadTeam& team);

  /// The bits at a position of the table.
  [[nodiscard]] ConstRow row(std::int64_t position) const {
    return rows_[ids_[static_cast<std::size_t>(position)]];
  }
  /// The bits of all cells of grid row `row` under joint input `u`.
  [[nodiscard]] ConstRow row(std::int64_t row, std::int64_t u) const;

  /// [position]: equal numbers mean equal bits.
  [[nodiscard]] const std::vector<std::uint32_t>& ids() const { return ids_; }
  [[nodiscard]] const std::vector<std::int32_t>& inputs() const { return inputs_; }  ///< in use, ascending
  [[nodiscard]] const std::vector<std::int64_t>& state_stride() const { return state_stride_; }
  [[nodiscard]] const std::vector<std::int64_t>& input_stride() const { return input_stride_; }

 private:
  const UniformGrid* grid_;
  const InputSpace* input_space_;
  std::vector<std::int32_t> inputs_;
  std::vector<std::int64_t> state_stride_;  ///< in positions; 0 where not in use
  std::vector<std::int64_t> input_stride_;
  RowNumbers rows_;
  std::vector<std::uint32_t> ids_;
};

}  // namespace coordreq
