#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/level_rows.hpp"
#include "engine/row_engine.hpp"
#include "engine/row_reader.hpp"
#include "engine/sum_kernels.hpp"

namespace coordreq {

/// Reads rows that are added up, where the last states are coupled: each cell of a row goes to a box of its
/// own, given by sums (SumRows). Then nothing is one window for a whole row, and levels are fetched cell by
/// cell.
///
/// For each choice of boxes in the leading dimensions, in which all cells of a unit move alike, the unit's
/// levels are one *block* of the inner dimensions, continued beyond the domain by what a post meets there.
/// Boxes in it are of few sizes; the block is eroded by each size once, and then one fetch a cell gives the
/// minimum of its box.
template <class Level>
class SumReader final : public RowReader<Level> {
 public:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  /// REQUIRES: the posts of the engine are not cut; `engine` and `levels` (from
  /// engine.make_levels(engine.posts())) outlive this object.
  SumReader(const RowEngine& engine, const LevelRows<Level>& levels);

  void enter() override { ++epoch_; }
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids) override;

 private:
  /// A cell of a block outside the domain, and what it holds: the level of another cell, or a constant.
  struct Margin {
    std::int32_t cell;
    std::int32_t source;  ///< -1: the constant
    Level constant;
  };
  /// The block for one choice in the leading dimensions, eroded by boxes of every size.
  struct Slot {
    std::vector<IndexRange> ranges;
    std::uint64_t epoch = 0;
    std::vector<Level> levels;  ///< [size][cell of the block]
  };

  void lay_out_block();
  void find_margins();
  [[nodiscard]] bool choose_outer(std::span<const std::uint32_t> ids, bool& gone);
  [[nodiscard]] Slot& slot(bool gone);
  void fill_block(Slot& slot, bool gone);
  void erode(Slot& slot, std::size_t size);
  void erode_from_block(Slot& slot);

  const RowEngine& engine_;
  RowFamily family_;
  const LevelRows<Level>& levels_;
  const LevelKernels<Level>* kernels_;
  const SumKernels* sums_;
  std::vector<SumRows::Reader> readers_;  ///< by inner dimension
  std::vector<BoxSides> sides_;           ///< likewise
  std::vector<std::int32_t> sizes_;       ///< likewise: widths there are
  std::vector<std::size_t> size_stride_;  ///< likewise: into the sizes
  std::vector<std::int32_t> widest_;      ///< likewise: greatest last - first
  std::int64_t block_cells_ = 0;
  std::size_t variants_ = 1;
  std::int32_t origin_ = 0;       ///< place of the cell with index 0 everywhere
  std::int32_t first_place_ = 0;  ///< the same in the block of boxes of width 0, if there were one
  std::vector<Margin> margins_;
  std::vector<std::int64_t> places_of_rows_;  ///< [row of a unit] its first cell
  std::vector<IndexRange> ranges_;
  std::vector<std::int64_t> counter_;
  std::vector<const Level*> sources_;
  std::vector<std::int32_t> place_;
  std::vector<Level> result_;
  std::vector<Slot> slots_;
  std::uint64_t epoch_ = 1;
};

extern template class SumReader<std::uint8_t>;
extern template class SumReader<std::uint16_t>;
extern template class SumReader<std::uint32_t>;

}  // namespace coordreq
