#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/equal_work.hpp"
#include "engine/level_rows.hpp"
#include "engine/shared_list_numbers.hpp"

namespace coordreq {

/// The memo of a sweep: finds, for a tile to be computed, a tile on which the same work is done in the
/// sweep.
///
/// A tile is computed at most once a sweep, so that until the sweep is over its rows are the result of that
/// work, to be copied.
///
/// Threads: several may call ask() while no levels change, each with a scratch of its own; several may call
/// update(), for different tiles; several may call first() and copy() for different tiles. Everything else is
/// for one thread.
template <class Level>
class TileMemo {
 public:
  struct Scratch {
    Tiles::Scratch tiles;
    Tiles::Numbers key;
  };

  /// @pre unchecked: all outlive this object.
  TileMemo(const EqualWork& equal, LevelRows<Level>& levels)
      : equal_(equal), levels_(levels), is_on_(equal.tiles != nullptr && levels.is_interned()) {
    if (is_on_) lists_ = std::make_unique<Lists>();
  }

  /// False if there are no tiles, or if too few were found: then looking up costs more than it saves.
  [[nodiscard]] bool is_on() const { return is_on_; }
  /// Rows of a tile.
  [[nodiscard]] std::int64_t rows() const { return equal_.tiles->rows(); }

  void begin_sweep(ThreadTeam& team) {
    is_on_ = is_on_ && (looked_up_ < kEnough || kLeastFound * found_ >= looked_up_);
    if (!is_on_) return;
    levels_.renumber();
    lists_->keys.clear();
    for (std::vector<First>& first : lists_->first) first.clear();
    if (rows() == 1) return;
    lists_->contents.clear();
    contents_.assign(static_cast<std::size_t>(equal_.tiles->size()), 0);
    std::vector<RowShare::Range> runs = held_rows(levels_.share(), levels_.rows());
    // Two runs may hold rows of one tile, which one thread numbers.
    std::int64_t end = 0;
    for (RowShare::Range& run : runs) {
      run = {std::max(run.begin / rows(), end), (run.end + rows() - 1) / rows()};
      end = run.end;
    }
    for_each_row_of(team, runs, kGrain, [&](ThreadTeam::Range range, int) {
      Tiles::Numbers key;
      for (std::int64_t tile = range.begin; tile < range.end; ++tile) update(tile, key);
    });
  }

  /// Asks about the tile that begins at `position`, to be computed. @param turn ascends in the order in which
  /// tiles are computed in the sweep, so that the answer is the same for any number of threads
  /// @returns what first() takes
  [[nodiscard]] std::uint32_t ask(const RowPosition& position, std::int64_t turn, Scratch& scratch) {
    const std::int64_t tile = position.row / rows();
    scratch.key.assign(1, (*equal_.numbers)[static_cast<std::size_t>(tile)]);
    equal_.tiles->add_contents(
        position,
        [this](std::int64_t other) {
          return rows() == 1 ? levels_.content(other) : contents_[static_cast<std::size_t>(other)];
        },
        scratch.tiles, scratch.key);
    return lists_->keys.number(scratch.key, [&](std::size_t shard, std::uint32_t number) {
      std::vector<First>& first = lists_->first[shard];
      if (number == first.size()) first.push_back({turn, tile});
      if (turn < first[number].turn) first[number] = {turn, tile};
    });
  }
  /// The tile whose rows are the result for a tile asked about; that tile itself if it has to be computed.
  /// @pre unchecked: all tiles of the batch have been asked about
  [[nodiscard]] std::int64_t first(std::uint32_t number) const {
    return lists_->first[SharedListNumbers::shard_of(number)][SharedListNumbers::in_shard(number)].tile;
  }
  /// So many tiles were asked about, and found.
  void count(std::int64_t looked_up, std::int64_t found) {
    looked_up_ += looked_up;
    found_ += found;
  }

  /// Makes the rows of `tile` equal to those of `other`; calls `visit(row)` for each that changes.
  template <class Visit>
  void copy(std::int64_t other, std::int64_t tile, const Visit& visit) {
    for (std::int64_t i = 0; i < rows(); ++i) {
      if (levels_.copy_row(other * rows() + i, tile * rows() + i)) visit(tile * rows() + i);
    }
  }
  /// To be called when rows of a tile have changed.
  void update(std::int64_t tile, Tiles::Numbers& scratch) {
    if (!is_on_ || rows() == 1) return;
    scratch.clear();
    for (std::int64_t i = 0; i < rows(); ++i) scratch.push_back(levels_.content(tile * rows() + i));
    contents_[static_cast<std::size_t>(tile)] = lists_->contents.number(scratch);
  }

 private:
  /// After so many tiles it is judged whether looking up pays: one of kLeastFound must have been found.
  static constexpr std::int64_t kEnough = 256;
  static constexpr std::int64_t kLeastFound = 16;
  /// Tiles that one thread takes at a time.
  static constexpr std::int64_t kGrain = 256;

  /// Of the tiles with one key the first in the order of the sweep.
  struct First {
    std::int64_t turn;
    std::int64_t tile;
  };
  struct Lists {
    SharedListNumbers keys;  ///< of the tiles asked about in this sweep
    std::array<std::vector<First>, SharedListNumbers::kShards> first;  ///< [shard][number in it]
    SharedListNumbers contents;                                        ///< of the rows of a tile
  };

  EqualWork equal_;
  LevelRows<Level>& levels_;
  bool is_on_;
  std::int64_t looked_up_ = 0;
  std::int64_t found_ = 0;
  std::unique_ptr<Lists> lists_;  ///< if it has ever been on
  Tiles::Numbers contents_;       ///< [tile] number of its list of contents; unused for tiles of one row
};

}  // namespace coordreq
