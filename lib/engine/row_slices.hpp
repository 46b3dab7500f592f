#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/row_box.hpp"
#include "engine/row_shape.hpp"
#include "engine/sum_rows.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// Cells [begin, end) of a row for which one state's next range has one simple form.
struct RowSegment {
  enum class Kind : std::uint8_t {
    fixed,    ///< the same cells `range` for all
    shifted,  ///< cell c goes to the raw indices c + range.first, ..., c + range.last (modulo count on a
              ///< ring)
    gone,     ///< the whole range has left the domain through a safe side
    blocked,  ///< part of the range leaves through an unsafe side
  };
  std::int32_t begin = 0;
  std::int32_t end = 0;
  Kind kind = Kind::fixed;
  IndexRange range;
  [[nodiscard]] auto operator<=>(const RowSegment&) const = default;
};

/// One state's transition table (or its table of tubes) cut into rows along the last state dimension: for
/// each choice of the other states and of the inputs in use the number of a slice, equal slices stored once.
///
/// Example: x(next) = x + 3 along a row of 10 cells. The row is cut where the form of the range changes:
///
///     cells         0  1  2  3  4  5  6 | 7  8  9
///     raw indices   3  4  5  6  7  8  9 | 10 11 12
///     `saturate`    [0, 7) shifted 3..3 | [7, 10) fixed 9..9
///     `safe`        [0, 7) shifted 3..3 | [7, 10) gone
///     `unsafe`      [0, 7) shifted 3..3 | [7, 10) blocked
///
/// So the row has one slice of two segments for this input, and the minimum over posts of seven cells is one
/// shifted copy of the row of levels.
///
/// 1. A slice is a list of segments that together cover the row. `shifted` occurs only for the last dimension
///    itself: there a whole row is eroded at once, and integrators (x' = x + c) give one segment a row.
/// 2. If the state is periodic, 0 <= range.first < count, and range.last may be beyond as in ResolvedRange.
/// 3. Where rows run along several dimensions, each of their tables is cut along its own, into one `shifted`
///    segment a slice.
/// 4. If `sums` is there rows are not cut but added up when they are read: each row is a slice of its own,
///    whose number is its position, and `ids` and `slices` are empty.
/// 5. Positions are counted from the first row held (HeldCells).
struct RowSlices {
  std::vector<std::uint32_t> ids;  ///< row-major over states (those across rows), then inputs
  std::vector<std::vector<RowSegment>> slices;
  std::vector<std::int64_t> state_stride;  ///< into `ids`; 0 where not in use, and along rows
  std::vector<std::int64_t> input_stride;
  std::int64_t before = 0;              ///< positions before the first one held
  std::vector<std::int32_t> inputs;     ///< in use, ascending
  std::int64_t input_combinations = 1;  ///< product of their counts; divides every state stride
  std::optional<SumRows> sums;

  /// The first position of a row. @pre unchecked: the row is held
  [[nodiscard]] std::int64_t base(const RowPosition& position) const {
    return position.offset(state_stride) - before;
  }
  /// Number of positions.
  [[nodiscard]] std::int64_t size() const {
    return sums ? sums->size() : static_cast<std::int64_t>(ids.size());
  }
  /// The slice at a position; equal numbers mean equal slices.
  [[nodiscard]] std::uint32_t number(std::int64_t position) const {
    return sums ? static_cast<std::uint32_t>(position) : ids[static_cast<std::size_t>(position)];
  }
  /// No two positions have a slice in common.
  [[nodiscard]] bool all_distinct() const { return sums.has_value(); }
  /// Slices are lists of segments.
  [[nodiscard]] bool is_cut() const { return !sums.has_value(); }
  /// True if for no cell of the row the least level over slice `a` can be below that over slice `b`: its
  /// range is inside, or it is gone, or `b` is blocked. False also where the segments do not show it.
  [[nodiscard]] bool is_within(std::uint32_t a, std::uint32_t b, const GridDimension& target) const;
  /// Bytes of all lists.
  [[nodiscard]] std::uint64_t bytes() const;
};

/// For each base, a multiple of input_combinations: the range around the slices from there to the next one,
/// resolved, or a window along the row; {0, -1}: the slices meet no cell.
/// @param along the table's dimension if it is along rows; null: it is across them
/// @param team may be null
[[nodiscard]] std::vector<IndexRange> slice_hulls(const RowSlices& slices, const GridDimension& target,
                                                  const RowDimension* along, ThreadTeam* team);

/// Cuts a table into slices. @param table of `state`, in abstraction.tables or abstraction.tubes
/// @param target the dimension of `state`, maybe with other rules for leaving the domain
[[nodiscard]] RowSlices cut_into_rows(const Abstraction& abstraction, const TransitionTable& table,
                                      std::size_t state, const GridDimension& target);

/// RowSlices of a table whose rows stay sums.
[[nodiscard]] RowSlices keep_as_sums(const Abstraction& abstraction, const TransitionTable& table,
                                     SumRows sums);

}  // namespace coordreq
