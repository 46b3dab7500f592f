#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/level_rows.hpp"
#include "engine/row_box.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// Reads rows that are cut into segments: the minimum over a box of rows, and over windows along them.
///
/// The minimum over the leading dimensions, which is the same for all rows of a unit, is taken once and kept
/// (the switch is FastPaths::shared_minima).
///
/// One object a thread. Levels do not change from one enter() to the next.
template <class Level>
class BoxReader {
 public:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  /// @param outer number of leading dimensions whose minimum is shared by the rows of a unit
  /// @pre unchecked: `engine` and `levels` (from engine.make_levels(family)) outlive this object.
  BoxReader(const RowEngine& engine, const RowFamily& family, std::size_t outer,
            const LevelRows<Level>& levels);

  /// Goes to a unit, and reads levels of the same layout from now on: forgets the minima that the rows of the
  /// last one share.
  void enter(const LevelRows<Level>& levels) {
    levels_ = &levels;
    ++epoch_;
  }
  /// From now on only these lanes of rows are asked about: what stands in others means nothing.
  void set_lanes(LaneRange lanes) {
    asked_ = lanes;
    is_part_asked_ = lanes.size() < engine_.all_lanes().size();
  }
  /// Least levels of the boxes given by the numbers of their slices, one a table: for each cell of the row
  /// the minimum over its box; 0 where a slice is blocked, else the greatest level where the post has left
  /// for good. The row may be read up to the next call; whole blocks, as LevelKernels ask.
  [[nodiscard]] const Level* minimum(std::span<const std::uint32_t> ids);
  /// Least levels of a box of cells, for the lanes [begin, end) of a row.
  /// @pre unchecked: it lies inside the domain or its margins
  [[nodiscard]] const Level* minimum(const RowBox& box, std::int64_t begin, std::int64_t end);

  [[nodiscard]] const LevelKernels<Level>& kernels() const { return *kernels_; }
  /// A row of this many levels holds the lanes of a row and the rest of its last block.
  [[nodiscard]] std::size_t lanes() const { return lanes_; }

 private:
  /// Rows of minima over the leading dimensions, by the number of the row within a unit.
  struct Shared {
    std::vector<IndexRange> ranges;
    std::vector<const Level*> rows;  ///< null: not taken yet
    std::vector<Level> storage;
    std::uint64_t epoch = 0;
  };

  [[nodiscard]] bool is_one_segment(std::span<const std::uint32_t> ids, bool& blocked, bool& gone);
  void read_segment(const RowSegment& last, bool gone, std::int64_t begin, std::int64_t end, Level* out);
  void read_windows(bool gone, std::int64_t begin, std::int64_t end, Level* out);
  void take_window(std::size_t k, std::size_t lanes, Level* out);
  void read_row(std::span<const std::uint32_t> ids, bool gone);
  void read_fixed(IndexRange range, bool gone, std::int64_t begin, std::int64_t end, Level* out);
  void read_by_segments(std::span<const std::uint32_t> ids);
  void collect_rows(bool gone);
  [[nodiscard]] Shared& shared();
  [[nodiscard]] const Level* shared_row(Shared& shared, std::int64_t inner);

  const RowEngine& engine_;
  RowFamily family_;
  std::size_t outer_;
  const LevelRows<Level>* levels_;
  const LevelKernels<Level>* kernels_;
  std::size_t lanes_;
  LaneRange asked_;             ///< set_lanes()
  bool is_part_asked_ = false;  ///< not all lanes are
  RowShape shape_;
  std::vector<IndexRange> ranges_;   ///< of the box being read, in the dimensions across rows
  std::vector<IndexRange> windows_;  ///< of that box, along rows
  std::vector<const Level*> rows_;   ///< its rows, or shared minima that stand for them
  std::vector<const Level*> sources_;
  std::vector<std::int64_t> counter_;
  std::vector<std::int64_t> shared_counter_;
  std::vector<const std::vector<RowSegment>*> slices_;
  std::vector<std::size_t> positions_;
  std::vector<Level> gone_row_;  ///< a row of greatest levels with its margins
  std::vector<Level> wide_;      ///< a row with margins, before the window is taken
  std::vector<Level> result_;
  std::vector<Shared> slots_;
  std::uint64_t epoch_ = 1;
  std::size_t last_slot_ = 0;  ///< slot used last
};

extern template class BoxReader<std::uint8_t>;
extern template class BoxReader<std::uint16_t>;
extern template class BoxReader<std::uint32_t>;
extern template class BoxReader<std::uint64_t>;

}  // namespace coordreq
