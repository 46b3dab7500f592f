#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/requires.hpp"
#include "base/thread_team.hpp"
#include "engine/level_rows.hpp"
#include "engine/pair_table.hpp"
#include "engine/row_box.hpp"
#include "engine/row_slices.hpp"
#include "engine/tube_sets.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// The slices of all states for one kind of boxes, posts or tubes, and the layout of the levels that they are
/// read from.
struct RowFamily {
  /// [state] In the dimensions along rows no offset is larger than the dimension, either way.
  std::span<const RowSlices> slices;
  RowShape shape;  ///< its margins hold all offsets

  /// All slices are cut into segments. Else the slices of the dimensions from outer() on are added up, and
  /// those of the dimensions before it move all cells of a unit alike.
  [[nodiscard]] bool is_cut() const { return slices.back().is_cut(); }
};

/// The abstraction laid out for whole rows of cells, and how work on it is divided.
///
/// The least level in the posts of a row is a minimum over a box of rows (in the dimensions across rows) and
/// over windows along the row. Rows run along the last dimension, or along several where each of these moves
/// by an offset of its own: see join_rows(). Where the first `outer()` dimensions move independently,
/// whatever the others do, the minimum over them is the same for all rows that share these indices: a *unit*.
/// PostReader takes that minimum once.
///
/// Threads: any number may read. set_pairs() and take_tube_sets() are called before any other thread has the
/// engine.
///
/// 1. slices() holds tables() tables of posts, one a state; then as many for each of demands(). target(t)
///    is the dimension that table t was cut for.
/// 2. Unit k is the rows from k * unit_rows() on, unit_rows() of them. If outer() is 0 there is one unit.
/// 3. No table of the first outer() dimensions depends on another dimension.
/// 4. If posts are added up, outer() > 0 and along() is 1; the tables from outer() on are sums, those
///    before it are cut.
/// 5. The margins of a family hold every window of its slices.
/// 6. All processes choose the same outer(). Rows have the numbers of the whole grid in each of them.
class RowEngine {
 public:
  /// @param pairs may be null: all pairs are allowed
  /// @param tubes the sets that tubes must stay in, if there are tubes
  /// @param share which rows are whose, together; null: there is one process
  /// @param team for large tables; null: this thread alone
  /// @pre unchecked: they outlive this object
  RowEngine(const Abstraction& abstraction, const PairRules* pairs, const TubeSets& tubes,
            const RowShare* share = nullptr, ThreadTeam* team = nullptr);

  /// From now on only these pairs are allowed. @pre there were no pairs.
  /// @pre unchecked: allow() and permitted() were not called before; `pairs` outlives this object
  void set_pairs(const PairRules& pairs) {
    REQUIRES(pairs_ == nullptr);
    pairs_ = &pairs;
  }
  /// Reads the sets that tubes must stay in, in the rows held: when they have been filled
  /// (TubeSets::are_known).
  void take_tube_sets();

  [[nodiscard]] const Abstraction& abstraction() const { return *abstraction_; }
  [[nodiscard]] const UniformGrid& grid() const { return abstraction_->grid; }
  /// The slices of posts, one table a state; then, if there are tubes, the slices of tubes in the same order,
  /// once or twice.
  [[nodiscard]] const std::vector<RowSlices>& slices() const { return slices_; }
  [[nodiscard]] RowFamily posts() const { return family(0); }
  /// The dimension, with its rules for leaving the domain, that a table of slices was cut for.
  [[nodiscard]] const GridDimension& target(std::size_t table) const { return targets_[table]; }
  /// A set that tubes may stay in: a post is blocked unless its tube is inside the set of one of the demands.
  struct Demand {
    RowFamily family;
    const LevelRows<std::uint8_t>* inside;  ///< the greatest level for members, else 0
  };
  [[nodiscard]] std::vector<Demand> demands() const;
  /// The admissible pairs, or null: all.
  [[nodiscard]] const PairTable* allow() const { return pairs_ == nullptr ? nullptr : pairs_->admissible(); }
  /// PairRules::permitted, or null.
  [[nodiscard]] const PairTable* permitted() const {
    return pairs_ != nullptr && pairs_->permitted ? &*pairs_->permitted : nullptr;
  }
  /// Null if there is one process.
  [[nodiscard]] const RowShare* share() const { return share_; }
  [[nodiscard]] std::int64_t rows() const { return grid().rows(); }
  [[nodiscard]] std::int64_t row_length() const { return grid().row_length(); }
  [[nodiscard]] LaneRange all_lanes() const { return {0, static_cast<std::size_t>(row_length())}; }
  [[nodiscard]] std::size_t row_words() const {
    return static_cast<std::size_t>((row_length() + CellSet::kWordBits - 1) / CellSet::kWordBits);
  }
  /// Number of tables of slices of posts: one a state.
  [[nodiscard]] std::size_t tables() const { return grid().size(); }
  /// Number of dimensions across rows, and along them.
  [[nodiscard]] std::size_t across() const { return grid().across(); }
  [[nodiscard]] std::size_t along() const { return tables() - across(); }

  /// True if the first dimensions move independently: none of their tables depends on a dimension after them.
  [[nodiscard]] bool is_closed(std::size_t outer) const;
  /// Number of leading dimensions whose minimum is shared by the rows of a unit; may be 0.
  [[nodiscard]] std::size_t outer() const { return outer_; }
  /// Rows of a unit, which have neighbouring numbers. All rows if outer() is 0.
  [[nodiscard]] std::int64_t unit_rows() const { return unit_rows_; }

  /// Levels of all rows, 0, with the margins that a family asks for.
  template <class Level>
  [[nodiscard]] LevelRows<Level> make_levels(const RowFamily& family, bool interned = false) const {
    return {rows(), family.shape, interned, share_};
  }
  /// The greatest level for the cells of a set, 0 for all others, laid out for the posts, in the rows held.
  template <class Level>
  [[nodiscard]] LevelRows<Level> make_levels(const CellSet& set, ThreadTeam& team,
                                             bool interned = false) const {
    auto levels = make_levels<Level>(posts(), interned);
    put_set(levels, set, team);
    return levels;
  }

 private:
  [[nodiscard]] std::vector<RowSlices> summed_slices() const;
  void add_family(const std::vector<TransitionTable>& tables, const std::vector<GridDimension>& targets,
                  ThreadTeam* team = nullptr);
  void add_demand(const CellSet& inside, const std::vector<GridDimension>& targets);
  void add_inner_demand(const CellSet& inside, std::vector<GridDimension> dimensions);
  [[nodiscard]] RowFamily family(std::size_t number) const;
  void choose_outer();
  [[nodiscard]] RowMargins margins_of(RowSlices& slices, std::int64_t count, RowEnds ends,
                                      ThreadTeam* team) const;

  const Abstraction* abstraction_;
  const PairRules* pairs_;
  const RowShare* share_;
  std::vector<RowSlices> slices_;
  std::vector<GridDimension> targets_;           ///< [table of slices]
  std::vector<LevelRows<std::uint8_t>> inside_;  ///< one for each family of tubes
  std::vector<const CellSet*> inside_sets_;      ///< the cells of each
  std::vector<RowShape> shapes_;                 ///< one a family: posts; tubes; tubes that pass no limit
  std::size_t outer_ = 0;
  std::int64_t unit_rows_ = 1;
};

}  // namespace coordreq
