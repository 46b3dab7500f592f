#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/list_numbers.hpp"
#include "engine/row_engine.hpp"
#include "engine/row_hull.hpp"

namespace coordreq {

/// Rows that are compared together to find equal work: a *tile* is one row, or the rows of a unit.
///
/// The result of an operator for a tile follows from the tables, from the tile's own cells, and from the
/// tiles in the box that its posts can meet. Tables that send two tiles to boxes of one size, and to the same
/// ranges within these, are equal *seen from the tiles*. Where tables and contents are equal in this sense,
/// so are results. Numbers stand for contents: equal numbers mean equal contents, which have been compared.
///
/// Why: rows that look alike are computed, held and packed once. K of the gridworld takes 218 visits of
/// rows instead of 2,587, that of the intersection 80,679 instead of 255,287, and the intersection half the
/// memory. Where a sample finds little equal nothing is compared. Tried for networks, too: there looking for
/// equal rows took 1.4 of the time, though 62 % were equal. The switch is FastPaths::equal_rows.
///
/// Not for tables that are added up (SumRows), nor where tubes can block a post. Where several processes
/// share the work, each knows the tiles that it owns, and no tile is cut. Immutable once built.
class Tiles {
 public:
  using Numbers = std::vector<std::uint32_t>;
  struct Scratch {
    std::vector<IndexRange> ranges;
    std::vector<std::int64_t> counter;
  };

  /// Rows or units as tiles, whichever are more often equal in a sample; nothing if neither are often.
  /// @param set the content of rows in the sample
  /// @param team may be null
  /// @pre unchecked: engine and hull outlive the tiles.
  [[nodiscard]] static std::optional<Tiles> find(const RowEngine& engine, const RowHull& hull,
                                                 const CellSet& set, ThreadTeam* team = nullptr);
  /// Tiles without a sample.
  /// @param leading number of leading dimensions that tell tiles apart: all across rows, or those of a unit
  [[nodiscard]] static std::optional<Tiles> make(const RowEngine& engine, const RowHull& hull,
                                                 std::size_t leading);

  [[nodiscard]] std::int64_t size() const { return size_; }
  /// The tiles that this process owns.
  [[nodiscard]] RowShare::Range local_tiles() const { return local_tiles_; }
  /// Rows of a tile, which have neighbouring numbers.
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  /// Number of leading dimensions that tell tiles apart.
  [[nodiscard]] std::size_t leading() const { return leading_; }
  [[nodiscard]] const RowEngine& engine() const { return *engine_; }
  /// [tile] Equal numbers where the tables are equal, seen from the tiles.
  [[nodiscard]] const Numbers& tables() const { return tables_; }

  /// Appends the content of the tile that begins at `position`, and of the tiles that its posts can meet.
  /// @param content called with a tile: the number of its content
  template <class Content>
  void add_contents(const RowPosition& position, const Content& content, Scratch& scratch,
                    Numbers& list) const {
    list.push_back(content(position.row / rows_));
    scratch.ranges.resize(leading_);
    for (std::size_t t = 0; t < leading_; ++t) scratch.ranges[t] = hull_->range(position, t);
    for_each_row(engine_->grid(), 0, scratch.ranges, scratch.counter,
                 [&](std::int64_t row) { list.push_back(content(row / rows_)); });
  }

  /// shift = how much further up the boxes of row `to` lie than those of row `from`: [leading dimension] in
  /// indices.
  /// @pre unchecked: the rows are in tiles with equal tables
  void find_shift(std::int64_t from, std::int64_t to, std::vector<std::int32_t>& shift) const;

  /// [tile] Equal numbers where `before` is equal, and so are the contents of the tile and of all that its
  /// posts can meet. @param content [row] equal numbers for equal rows @param team may be null
  [[nodiscard]] Numbers refined(const Numbers& before, const Numbers& content,
                                ThreadTeam* team = nullptr) const;

 private:
  Tiles(const RowEngine& engine, const RowHull& hull, std::size_t leading, ThreadTeam* team);

  /// A table of posts, or of pairs.
  struct Source {
    const std::vector<std::int64_t>* state_stride;
    std::int64_t before;  ///< offset of the first choice held
    std::int64_t combinations;
    bool by_rows;     ///< it depends on dimensions that tell the rows of a tile apart
    Numbers numbers;  ///< [choice of its states] equal numbers for equal meanings under all inputs
  };

  void add_source(const std::vector<std::int64_t>& state_stride, std::int64_t before,
                  std::int64_t combinations, Numbers numbers);
  void add_pairs(const PairTable& pairs);
  [[nodiscard]] Numbers number_choices(std::size_t t) const;
  void add_tables(std::int64_t tile, Numbers& list) const;
  void number_tables(ThreadTeam* team);
  [[nodiscard]] Numbers contents_of_tiles(const Numbers& content) const;
  [[nodiscard]] double fraction_different(const Numbers& content, ThreadTeam* team) const;

  const RowEngine* engine_;
  const RowHull* hull_;
  std::size_t leading_;
  std::int64_t rows_;
  std::int64_t size_;
  RowShare::Range local_tiles_;
  std::vector<Source> sources_;
  Numbers tables_;
};

/// Calls `visit(row, first)` for the rows for which `has(row)` is true, in order; `first` is the row at the
/// same position in the first tile of the same class: the row itself in the first tile of a class.
/// @param tiles null: all rows are different
/// @param classes [tile] equal numbers where results are equal
/// @pre unchecked: `has` is the same for the rows of two tiles of one class
template <class Has, class Visit>
void for_each_with_first(const Tiles* tiles, const Tiles::Numbers& classes, RowShare::Range rows,
                         const Has& has, const Visit& visit) {
  std::vector<std::int64_t> first;  // [class] its first tile
  for (std::int64_t r = rows.begin; r < rows.end; ++r) {
    if (!has(r)) continue;
    if (tiles == nullptr) {
      visit(r, r);
      continue;
    }
    const std::int64_t tile = r / tiles->rows();
    const std::uint32_t number = classes[static_cast<std::size_t>(tile)];
    if (number >= first.size()) first.resize(number + 1, -1);
    if (first[number] < 0) first[number] = tile;
    visit(r, first[number] * tiles->rows() + r % tiles->rows());
  }
}

/// [row] Equal numbers for equal rows of a set. @param share the rows held are numbered; null: all rows
[[nodiscard]] Tiles::Numbers number_rows(const CellSet& set, const RowShare* share = nullptr,
                                         ThreadTeam* team = nullptr);

}  // namespace coordreq
