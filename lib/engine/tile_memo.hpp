#pragma once

#include <cstdint>
#include <vector>

#include "engine/equal_work.hpp"
#include "engine/level_rows.hpp"

namespace coordreq {

/// The memo of a sweep: finds, for a tile to be worked out, a tile on which the same work was done in the
/// sweep.
///
/// A tile is worked out at most once a sweep, so that until the sweep is over its rows are the result of that
/// work, to be copied.
template <class Level>
class TileMemo {
 public:
  /// @pre unchecked: all outlive this object.
  TileMemo(const EqualWork& equal, LevelRows<Level>& levels)
      : equal_(equal), levels_(levels), is_on_(equal.tiles != nullptr && levels.is_interned()) {}

  /// False if there are no tiles, or if too few were found: then looking up costs more than it saves.
  [[nodiscard]] bool is_on() const { return is_on_; }
  /// Rows of a tile.
  [[nodiscard]] std::int64_t rows() const { return equal_.tiles->rows(); }

  void begin_sweep() {
    is_on_ = is_on_ && (looked_up_ < kEnough || kLeastFound * found_ >= looked_up_);
    if (!is_on_) return;
    levels_.renumber();
    keys_.clear();
    first_.clear();
    if (rows() == 1) return;
    lists_.clear();
    contents_.assign(static_cast<std::size_t>(equal_.tiles->size()), 0);
    for (const RowShare::Range run : held_rows(levels_.share(), levels_.rows())) {
      for (std::int64_t tile = run.begin / rows(); tile < (run.end + rows() - 1) / rows(); ++tile)
        contents_[static_cast<std::size_t>(tile)] = content(tile);
    }
  }

  /// The tile whose rows are the result for the tile that begins at `place`; that tile itself if it has to be
  /// worked out. @pre unchecked: called at most once a sweep for a tile
  [[nodiscard]] std::int64_t find(const RowPlace& place) {
    const std::int64_t tile = place.row / rows();
    key_.assign(1, (*equal_.numbers)[static_cast<std::size_t>(tile)]);
    equal_.tiles->add_contents(
        place,
        [this](std::int64_t other) {
          return rows() == 1 ? levels_.content(other) : contents_[static_cast<std::size_t>(other)];
        },
        scratch_, key_);
    const std::uint32_t number = keys_.number(key_);
    ++looked_up_;
    if (number == first_.size()) first_.push_back(tile);
    found_ += first_[number] != tile ? 1 : 0;
    return first_[number];
  }

  /// Makes the rows of `tile` equal to those of `other`; calls `visit(row)` for each that changes.
  template <class Visit>
  void copy(std::int64_t other, std::int64_t tile, const Visit& visit) {
    for (std::int64_t i = 0; i < rows(); ++i) {
      if (levels_.copy_row(other * rows() + i, tile * rows() + i)) visit(tile * rows() + i);
    }
  }
  /// To be called when rows of a tile have changed.
  void update(std::int64_t tile) {
    if (is_on_ && rows() > 1) contents_[static_cast<std::size_t>(tile)] = content(tile);
  }

 private:
  /// After so many tiles it is judged whether looking up pays: one of kLeastFound must have been found.
  static constexpr std::int64_t kEnough = 256;
  static constexpr std::int64_t kLeastFound = 16;

  std::uint32_t content(std::int64_t tile) {
    key_.clear();
    for (std::int64_t i = 0; i < rows(); ++i) key_.push_back(levels_.content(tile * rows() + i));
    return lists_.number(key_);
  }

  EqualWork equal_;
  LevelRows<Level>& levels_;
  bool is_on_;
  std::int64_t looked_up_ = 0;
  std::int64_t found_ = 0;
  Tiles::Scratch scratch_;
  Tiles::Numbers key_;
  ListNumbers<std::uint32_t> keys_;   ///< of the tiles that this sweep has worked out
  std::vector<std::int64_t> first_;   ///< [number of a key] the tile that had it first
  ListNumbers<std::uint32_t> lists_;  ///< contents of the rows of a tile
  Tiles::Numbers contents_;           ///< [tile] number of its list of contents; unused for tiles of one row
};

}  // namespace coordreq
