#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "base/short_wait.hpp"
#include "engine/level_kernels.hpp"
#include "engine/level_rows.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// How a patch is laid out: the cells of a unit over the inner dimensions, with room beyond the domain for
/// the largest box on either side. Patches of several sizes of boxes lie one after the other, row-major over
/// the dimensions.
struct PatchLayout {
  /// One of the inner dimensions.
  struct Side {
    std::int32_t count = 0;       ///< of indices in the domain
    std::int32_t stride = 0;      ///< in cells of a patch
    std::int32_t sizes = 0;       ///< number of different widths of boxes
    std::size_t size_stride = 0;  ///< from one width to the next, in sizes
    std::int32_t narrowest = 0;   ///< least last - first
    std::int32_t reach = 0;       ///< greatest last - first, of joined boxes too
  };

  PatchLayout(const RowEngine& engine, std::size_t level_bytes);

  std::vector<Side> sides;
  std::int64_t cells = 0;         ///< of a patch
  std::size_t room_beyond = 0;    ///< so many levels after the last patch may be read
  std::size_t sizes = 1;          ///< of boxes
  std::int32_t origin = 0;        ///< offset in a patch of the cell with index 0 in all dimensions
  std::int32_t first_offset = 0;  ///< origin in the patch for boxes of width 0, whether or not there is one
};

/// The patches that the readers of added-up rows need (SumReader), which they share: each is made by the
/// thread that asks for it first. A patch is the minimum over some ranges in the leading dimensions, of the
/// rows of a unit with their margins, eroded by boxes of every size that occurs or of one.
///
/// Threads: any number may call everything; each holds the patches of one unit at a time. What no thread
/// holds is used again for other units.
template <class Level>
class SumPatches {
 public:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  /// What a patch is made for.
  struct Key {
    std::vector<IndexRange> ranges;    ///< [leading dimension]; {0, -1} in each: the post has left for good
    std::vector<std::int32_t> widths;  ///< last - first of the one size; empty: all sizes are there
    [[nodiscard]] auto operator<=>(const Key&) const = default;
  };
  /// The patches of a unit while its levels do not change.
  struct Unit;

  /// @pre unchecked: `engine` outlives this object
  explicit SumPatches(const RowEngine& engine);
  SumPatches(const SumPatches&) = delete;
  SumPatches& operator=(const SumPatches&) = delete;
  ~SumPatches();

  [[nodiscard]] const PatchLayout& layout() const { return layout_; }
  /// held = the patches of a unit. @param held what this thread has held until now, or null
  void enter(std::int64_t unit, const LevelRows<Level>& levels, std::shared_ptr<Unit>& held);
  /// Gives up the patches of all units. @pre unchecked: no thread calls find() again before enter()
  void forget();
  /// A patch, [size][cell]; null where the unit has as many as are kept.
  /// @param wait of this thread, for a patch that another one is making
  [[nodiscard]] const Level* find(Unit& unit, const Key& key, ShortWait& wait);
  /// Makes a patch that is not kept.
  void make(const Unit& unit, const Key& key, std::vector<Level>& levels) const;

 private:
  /// Cells of a patch outside the domain, one after the other, and their levels: those of other cells, or a
  /// constant.
  struct Margin {
    std::int32_t cell;
    std::int32_t count;
    std::int32_t source;  ///< of the first; -1: the constant
    std::int32_t step;    ///< from the source of one to that of the next: 0 or 1
    Level constant;
  };

  void find_margins();
  void add_margin(const Margin& margin);
  void give_up(Unit& unit);
  void fill(const Unit& unit, const Key& key, Level* patch) const;
  void erode_in_place(const std::vector<std::int32_t>& widths, Level* patch) const;
  void erode(std::size_t size, Level* patches) const;

  const RowEngine& engine_;
  PatchLayout layout_;
  const LevelKernels<Level>* kernels_;
  std::vector<Margin> margins_;
  std::vector<std::int64_t> row_offsets_;  ///< [row of a unit] offset of its first cell
  std::vector<std::int32_t> narrowest_;    ///< [inner dimension]
  std::array<std::size_t, 2> most_;        ///< patches of all sizes, and of one, that a unit keeps
  std::array<std::size_t, 2> room_;        ///< levels of each

  std::mutex mutex_;  ///< of the members below, and of what units have
  std::vector<std::shared_ptr<Unit>> units_;
  std::array<std::vector<std::vector<Level>>, 2> spare_;  ///< of all sizes, and of one
};

extern template class SumPatches<std::uint8_t>;
extern template class SumPatches<std::uint16_t>;
extern template class SumPatches<std::uint32_t>;
extern template class SumPatches<std::uint64_t>;

}  // namespace coordreq
