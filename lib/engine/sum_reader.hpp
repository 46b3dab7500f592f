#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/short_wait.hpp"
#include "engine/row_engine.hpp"
#include "engine/sum_kernels.hpp"
#include "engine/sum_patches.hpp"

namespace coordreq {

/// Reads rows that are added up, where the last states are coupled: each cell of a row goes to a box of its
/// own, given by sums (SumRows). There is no window for a whole row, and levels are fetched cell by cell.
///
/// All cells of a unit move alike in the leading dimensions. For each choice of ranges there, the minimum
/// over them is a *patch*: the levels of a unit over the inner dimensions, with margins beyond the domain.
/// Boxes in it are of few sizes; the patch is eroded by each size once, and then one fetch a cell gives the
/// minimum of its box. Readers share patches (SumPatches), so that a unit has one set of them for all
/// threads.
///
/// Choices of one class mostly differ by the same for all cells of a row. A box a cell around several of them
/// gives a bound, and where the bound lowers nothing none of them is fetched: the aircraft on a fine grid
/// takes 0.55 of its time (FastPaths::choice_bounds).
///
/// One object a thread. Levels do not change from one enter() to the next.
template <class Level>
class SumReader {
 public:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  /// @pre the posts of the engine are not cut.
  /// @param patches of this engine, shared with other readers
  /// @pre unchecked: `engine` outlives this object
  SumReader(const RowEngine& engine, std::shared_ptr<SumPatches<Level>> patches);

  /// Goes to a unit, see SumPatches::enter(). @pre unchecked: `levels` (from
  /// engine.make_levels(engine.posts())) outlive the visit
  void enter(std::int64_t unit, const LevelRows<Level>& levels) {
    ++epoch_;
    patches_->enter(unit, levels, unit_);
  }
  /// Least levels of the boxes given by the numbers of their slices, one a table: for each cell of the row
  /// the minimum over its box; 0 where a slice is blocked, else the greatest level where the post has left
  /// for good. The row may be read up to the next call; whole blocks, as LevelKernels ask.
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids) {
    return minimum(ids, engine_.all_lanes(), kTop);
  }
  /// minimum() in some lanes of the row alone; the first of these lanes comes first, after the last a block
  /// of `rest`.
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids, LaneRange lanes, Level rest);
  /// Takes several choices of slices for one row of cells, numbered 0, 1, ... @param ids one choice after the
  /// other
  void take(std::span<const std::uint32_t> ids);
  /// minimum() of one of these choices.
  [[nodiscard]] const Level* minimum_of(std::size_t choice, LaneRange lanes, Level rest);
  /// Levels that are nowhere above the minima of the choices [begin, end): the least levels of one box a cell
  /// that holds its boxes of all these choices. Null if the choices differ much, or not by the same for all
  /// cells.
  [[nodiscard]] const Level* bound(std::size_t begin, std::size_t end, LaneRange lanes);

 private:
  using Key = typename SumPatches<Level>::Key;
  /// The patch for one choice in the leading dimensions, eroded by boxes of every size, or of one.
  struct Slot {
    Key key;
    std::uint64_t epoch = 0;
    const Level* levels = nullptr;  ///< [size][cell of the patch]
  };
  /// The slices of some choices.
  struct Choices {
    std::vector<RowSegment::Kind> kinds;  ///< [choice] of the leading dimensions together, see lead()
    std::vector<IndexRange> ranges;       ///< [choice][leading dimension]
    std::vector<SumRows::Rows> rows;      ///< [inner dimension]
  };

  [[nodiscard]] RowSegment::Kind lead(std::span<const std::uint32_t> ids, IndexRange* ranges) const;
  [[nodiscard]] const Level* minimum(RowSegment::Kind kind, LaneRange lanes, Level rest);
  [[nodiscard]] bool join(std::size_t begin, std::size_t end);
  [[nodiscard]] std::int32_t greatest_width(std::size_t i, const SumRows::Row& row) const;
  void fetch(const Level* patch, LaneRange lanes, Level rest);
  void fill_rest(LaneRange lanes, Level rest);
  [[nodiscard]] const Level* patch();

  const RowEngine& engine_;
  RowFamily family_;
  std::shared_ptr<SumPatches<Level>> patches_;
  const SumKernels* sums_;
  std::vector<SumRows::Reader> readers_;  ///< [inner dimension]
  std::vector<BoxSides> sides_;           ///< [inner dimension]
  Key box_;                         ///< leading ranges of the box being read, and its widths if it is joined
  std::vector<SumRows::Row> rows_;  ///< [inner dimension] of the box being read
  Choices choices_;
  std::vector<std::int32_t> offsets_;
  std::vector<Level> result_;
  std::shared_ptr<typename SumPatches<Level>::Unit> unit_;
  std::vector<Slot> slots_;  ///< by hash: patches that were found
  Slot private_slot_;        ///< a patch that is not shared, in private_patch_
  std::vector<Level> private_patch_;
  ShortWait wait_;
  std::uint64_t epoch_ = 1;
};

extern template class SumReader<std::uint8_t>;
extern template class SumReader<std::uint16_t>;
extern template class SumReader<std::uint32_t>;
extern template class SumReader<std::uint64_t>;

}  // namespace coordreq
