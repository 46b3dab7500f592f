#pragma once

#include <cstdint>
#include <vector>

#include "engine/equal_work.hpp"
#include "engine/level_rows.hpp"

namespace coordreq {

/// Finds tiles of which the work in a sweep is equal to work on another tile in the same sweep.
///
/// A tile is worked out at most once a sweep, so that the rows of one that has been are its result until the
/// sweep is over: what is to be copied stands there.
template <class Level>
class TileMemo {
 public:
  /// @pre unchecked: all outlive this object.
  TileMemo(const EqualWork& equal, LevelRows<Level>& levels)
      : equal_(equal), levels_(levels), is_on_(equal.tiles != nullptr && levels.is_interned()) {}

  /// False where too little has been found: looking up costs more than it saves.
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

  /// The tile whose result is that of the one at `place`; the latter itself if it is to be worked out.
  /// @pre unchecked: it is asked once a sweep.
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
  /// Rows of the tile have changed.
  void update(std::int64_t tile) {
    if (is_on_ && rows() > 1) contents_[static_cast<std::size_t>(tile)] = content(tile);
  }

 private:
  /// Tiles to look up before it is judged whether that pays, and one of how many has to be found.
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
  ListNumbers<std::uint32_t> keys_;  ///< of the tiles that this sweep has worked out
  std::vector<std::int64_t> first_;  ///< [number of a key] the tile that had it first
  ListNumbers<std::uint32_t> lists_;
  Tiles::Numbers contents_;  ///< [tile] by the contents of its rows; unused for tiles of one row
};

}  // namespace coordreq
