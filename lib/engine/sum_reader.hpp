#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "engine/level_rows.hpp"
#include "engine/row_engine.hpp"
#include "engine/row_reader.hpp"
#include "engine/sum_kernels.hpp"

namespace coordreq {

/// Reads rows that are added up, where the last states are coupled: each cell of a row goes to a box of its
/// own, given by sums (SumRows). There is no window for a whole row, and levels are fetched cell by cell.
///
/// All cells of a unit move alike in the leading dimensions. For each choice of ranges there, the minimum
/// over them is a *patch*: the levels of a unit over the inner dimensions, with margins beyond the domain.
/// Boxes in it are of few sizes; the patch is eroded by each size once, and then one fetch a cell gives the
/// minimum of its box.
///
/// Choices of one class mostly differ by the same for all cells of a row. A box a cell around several of them
/// gives a bound, and where the bound lowers nothing none of them is fetched: the aircraft on a fine grid
/// takes 0.55 of its time (FastPaths::choice_bounds).
template <class Level>
class SumReader final : public RowReader<Level> {
 public:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  /// @pre the posts of the engine are not cut.
  /// @pre unchecked: `engine` and `levels` (from engine.make_levels(engine.posts())) outlive this object
  SumReader(const RowEngine& engine, const LevelRows<Level>& levels);

  void read(const LevelRows<Level>& levels) override { levels_ = &levels; }
  void enter() override {
    ++epoch_;
    slots_.used = 0;
    joined_slots_.used = 0;
  }
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids) override {
    return minimum(ids, {0, static_cast<std::size_t>(levels_->row_length())}, kTop);
  }
  /// minimum() in some lanes of the row alone; the first of these lanes comes first, after the last a block
  /// of `rest`.
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids, LaneRange lanes, Level rest);
  /// Takes several choices of slices for one row of cells, numbered 0, 1, ... @param ids one choice after the
  /// other
  void take(std::span<const std::uint32_t> ids);
  /// minimum() of one of the choices taken.
  [[nodiscard]] const Level* minimum_of(std::size_t choice, LaneRange lanes, Level rest);
  /// Levels that are nowhere above the minima of the choices [begin, end): the least levels of one box a cell
  /// that holds its boxes of all these choices. Null if the choices differ much, or not by the same for all
  /// cells.
  [[nodiscard]] const Level* bound(std::size_t begin, std::size_t end, LaneRange lanes);

 private:
  /// A cell of a patch outside the domain, and its level: that of another cell, or a constant.
  struct Margin {
    std::int32_t cell;
    std::int32_t source;  ///< -1: the constant
    Level constant;
  };
  /// The patch for one choice in the leading dimensions, eroded by boxes of every size, or of one.
  struct Slot {
    std::vector<IndexRange> ranges;
    std::vector<std::int32_t> widths;  ///< last - first of the one size; empty: all sizes are there
    std::uint64_t epoch = 0;
    Level* levels = nullptr;  ///< [size][cell of the patch], a buffer
  };
  /// The buffers are for all slots together, so that there are as many as one unit has needed.
  struct Slots {
    std::vector<Slot> table;  ///< by hash
    std::deque<std::vector<Level>> buffers;
    std::size_t used = 0;  ///< buffers that slots of this epoch have
  };
  /// The slices of some choices.
  struct Choices {
    std::vector<RowSegment::Kind> kinds;  ///< [choice] of the leading dimensions together, see lead()
    std::vector<IndexRange> ranges;       ///< [choice][leading dimension]
    std::vector<SumRows::Rows> rows;      ///< [inner dimension]
  };

  void lay_out_patch();
  void find_margins();
  [[nodiscard]] RowSegment::Kind lead(std::span<const std::uint32_t> ids, IndexRange* ranges) const;
  [[nodiscard]] const Level* minimum(RowSegment::Kind kind, LaneRange lanes, Level rest);
  [[nodiscard]] bool join(std::size_t begin, std::size_t end);
  [[nodiscard]] std::int32_t greatest_width(std::size_t i, const SumRows::Row& row) const;
  void fetch(const Slot& slot, LaneRange lanes, Level rest);
  void fill_rest(LaneRange lanes, Level rest);
  [[nodiscard]] Slot& slot(Slots& slots, const std::vector<std::int32_t>& widths, bool gone);
  [[nodiscard]] Level* next_buffer(Slots& slots, std::size_t sizes) const;
  void fill(Slot& slot, bool gone);
  void fill_patch(Slot& slot, bool gone);
  void erode(Slot& slot, std::size_t size);
  void erode_patch(Slot& slot, const std::vector<std::int32_t>& widths);

  const RowEngine& engine_;
  RowFamily family_;
  const LevelRows<Level>* levels_;
  const LevelKernels<Level>* kernels_;
  const SumKernels* sums_;
  std::vector<SumRows::Reader> readers_;  ///< [inner dimension]
  std::vector<BoxSides> sides_;           ///< [inner dimension]
  std::vector<std::int32_t> sizes_;       ///< [inner dimension] number of different widths
  std::vector<std::size_t> size_stride_;  ///< [inner dimension] from one width to the next, in sizes
  std::vector<std::int32_t> narrowest_;   ///< [inner dimension] least last - first
  std::vector<std::int32_t> reach_;       ///< [inner dimension] greatest last - first, of joined boxes too
  std::int64_t patch_cells_ = 0;
  std::size_t variants_ = 1;
  std::int32_t origin_ = 0;        ///< offset in a patch of the cell with index 0 in all dimensions
  std::int32_t first_offset_ = 0;  ///< origin_ in the patch for boxes of width 0, whether or not there is one
  std::vector<Margin> margins_;
  std::vector<std::int64_t> row_offsets_;  ///< [row of a unit] offset of its first cell
  std::vector<IndexRange> ranges_;         ///< [leading dimension] of the box being read
  std::vector<SumRows::Row> rows_;         ///< [inner dimension] of the box being read
  std::vector<std::int32_t> widths_;  ///< [inner dimension] greatest last - first of a cell in a joined box
  Choices taken_;
  std::vector<std::int64_t> counter_;
  std::vector<const Level*> sources_;
  std::vector<std::int32_t> offsets_;
  std::vector<Level> result_;
  Slots slots_;
  Slots joined_slots_;
  std::uint64_t epoch_ = 1;
};

extern template class SumReader<std::uint8_t>;
extern template class SumReader<std::uint16_t>;
extern template class SumReader<std::uint32_t>;
extern template class SumReader<std::uint64_t>;

}  // namespace coordreq
