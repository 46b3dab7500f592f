#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reach/abstraction.hpp"

namespace coordreq {

/// Reads a transition table a row at a time: the raw ranges of one state for all indices of one dimension,
/// the other states and the inputs being fixed. The same ranges as TransitionTable::range(), in any form of
/// table.
///
/// Immutable, so safe to share between threads.
class TableRows {
 public:
  /// @param table of `state`; may be that of its tube. @pre unchecked: it outlives this object.
  /// @param along the state dimension of the rows
  TableRows(const TransitionTable& table, std::size_t state, std::size_t along);

  /// All ranges of a row are equal.
  [[nodiscard]] bool is_constant() const { return !shifts_along_ && !varies_; }
  /// Range c of a row is that of 0 moved by c, and nothing else.
  [[nodiscard]] bool is_shift() const { return shifts_along_ && !varies_; }

  /// @param states indices of all states; that of `along` is ignored
  /// @param inputs indices of all inputs
  /// @param out cells 0, 1, ... of the row; at most as many as it has
  /// Cost: a few additions a cell.
  void read(std::span<const std::int64_t> states, std::span<const std::int64_t> inputs,
            std::span<IndexRange> out) const;

 private:
  void read_sum(std::span<const std::int64_t> states, std::span<const std::int64_t> inputs, std::size_t base,
                std::int64_t offset, std::span<IndexRange> out) const;

  const TransitionTable* table_;
  std::size_t state_;
  std::size_t along_;
  std::int64_t stride_;  ///< of entries or base along the row
  bool shifts_along_;
  bool varies_;
};

}  // namespace coordreq
