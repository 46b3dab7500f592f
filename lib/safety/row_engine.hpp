#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "abstraction/abstraction.hpp"
#include "bitset/row_operations.hpp"
#include "safety/condition_table.hpp"
#include "safety/row_slices.hpp"
#include "safety/row_target.hpp"
#include "safety/safe_tubes.hpp"

namespace coordreq {

/// The one question that every operator asks, answered for a whole row of cells at once:
/// {x in the row : empty != f(x, u) subset of Z}, and which u are allowed there.
///
/// A row is all cells that differ only in the last dimension. The post of a row is the AND of a box of rows
/// of Z (other dimensions), eroded along the row (last dimension); see RowSlices for rows that fall into
/// segments. Immutable once built, so safe to share between threads; scratch memory is the caller's.
class RowEngine {
 public:
  struct Scratch {
    RowEroder eroder;
    std::vector<Word> gathered;
    std::vector<Word> eroded;
    std::vector<Word> tube;
    std::vector<Word> safe_tubes;
    std::vector<const std::vector<RowSegment>*> slices;
    std::vector<std::size_t> positions;
    std::vector<IndexRange> box;
    std::vector<std::int64_t> indices;
  };

  /// @param allow may be null: everything is allowed
  /// @param tubes what tubes must stay in, if there are any
  /// REQUIRES: they outlive this object.
  RowEngine(const Abstraction& abstraction, const ConditionTable* allow, const SafeTubes& tubes,
            ThreadTeam& team);

  [[nodiscard]] const Abstraction& abstraction() const { return *abstraction_; }
  /// Those of the posts, one a state; then, if there are tubes, those of the tubes in the same order, once or
  /// twice.
  [[nodiscard]] const std::vector<RowSlices>& slices() const { return slices_; }
  [[nodiscard]] const ConditionTable* allow() const { return allow_; }
  [[nodiscard]] std::int64_t rows() const { return abstraction_->grid.rows(); }
  [[nodiscard]] std::int64_t row_length() const { return abstraction_->grid.row_length(); }
  [[nodiscard]] std::size_t row_words() const {
    return static_cast<std::size_t>((row_length() + CellSet::kWordBits - 1) / CellSet::kWordBits);
  }

  /// Number of tables of slices of posts: one a state.
  [[nodiscard]] std::size_t tables() const { return count_.size(); }
  /// Where the entries of `row` begin in slices()[table].ids.
  [[nodiscard]] std::int64_t base(std::int64_t row, std::size_t table) const;

  /// out = {x in the row : not blocked, tube safe and post inside `target`} for the slices numbered `ids`,
  /// one for each of slices().
  void inside(std::span<const std::uint32_t> ids, const RowTarget& target, MutableRow out,
              Scratch& scratch) const;

  /// A target for inside(). REQUIRES: `set` outlives it.
  [[nodiscard]] RowTarget target(const CellSet& set, ThreadTeam& team) const {
    return RowTarget(set, slices_[tables() - 1], abstraction_->grid.dimensions().back(), team);
  }

 private:
  /// Slices of all states that are tested against one target.
  struct Family {
    std::span<const RowSlices> slices;
    RowEnds ends;  ///< rules of the last dimension
  };
  [[nodiscard]] Family family(std::size_t number) const;
  void cut(const std::vector<TransitionTable>& tables, const std::vector<GridDimension>& targets);
  void clear_unsafe_tubes(std::span<const std::uint32_t> ids, MutableRow out, Scratch& scratch) const;
  void boxes_inside(const Family& family, std::span<const std::uint32_t> ids, const RowTarget& target,
                    MutableRow out, Scratch& scratch) const;
  [[nodiscard]] bool inside_simple(std::span<const RowSlices> slices, std::span<const std::uint32_t> ids,
                                   const RowTarget& target, MutableRow out, Scratch& scratch) const;
  void gather(const CellSet& target, std::vector<std::int64_t>& indices, const std::vector<IndexRange>& box,
              MutableRow out) const;
  [[nodiscard]] bool holds(ConstRow row, IndexRange range) const;
  void place_segment(const RowSegment& last, const RowEnds& ends, std::int32_t begin, std::int32_t end,
                     Scratch& scratch, MutableRow out) const;

  const Abstraction* abstraction_;
  const ConditionTable* allow_;
  std::vector<RowSlices> slices_;
  std::vector<RowEnds> ends_;             ///< one a family: posts; tubes; tubes that pass no limit
  std::vector<std::int64_t> row_stride_;  ///< rows from one index of a dimension to the next
  std::vector<std::int64_t> count_;       ///< indices of a dimension
  std::vector<RowTarget> tube_targets_;   ///< one for each family of tubes
};

}  // namespace coordreq
