#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/equal_work.hpp"
#include "engine/like_agents.hpp"
#include "engine/packed_pairs.hpp"
#include "engine/pair_table.hpp"
#include "engine/row_engine.hpp"
#include "engine/row_hull.hpp"
#include "engine/tube_sets.hpp"
#include "model/cell_order.hpp"
#include "model/input_class.hpp"
#include "model/model.hpp"
#include "ranks/row_share.hpp"
#include "reach/abstraction.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// A controller that the user brings: the pairs that it lists.
struct ListedController {
  std::string sha256;  ///< of its file
  PackedPairs pairs;
};

/// What all answers to a problem stand on: its abstraction, S, and the engine that reads them.
///
/// 1. Rows, columns and dimensions are those of the grid of the abstraction, with the states in the order of
///    the model; `order` maps cells of the spec's grid to them. Inputs and agents are the spec's.
/// 2. Neither copied nor moved: its parts refer to one another. What stages make is there after them.
struct Ground {
  /// @param all the processes that share the work; null: there is one
  explicit Ground(const Model& problem, Ranks* all = nullptr)
      : model(problem), spec(problem.spec()), ranks(all) {}
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;

  const Model& model;
  const ProblemSpec& spec;
  Ranks* ranks;
  std::optional<ListedController> listed;  ///< of `controller.file`; then the order is that of the spec
  std::optional<Abstraction> abstraction;  ///< after "abstraction", as all that follows after "safe set"
  /// Which rows are whose, if there are several processes; there with the abstraction if that is divided.
  std::optional<RowShare> share;
  CellSet safe;                 ///< S, in the rows held
  std::int64_t safe_cells = 0;  ///< |S|
  /// G of a goal that ends the task, a part of S: cells that count as T (contract, section 5). Nothing where
  /// no goal does.
  std::optional<CellSet> over;
  std::int64_t over_cells = 0;  ///< |G|, 0 if there is none
  PairRules pairs;
  std::optional<CellSet> beyond;  ///< TubeSets::beyond
  std::optional<RowEngine> engine;
  std::optional<RowHull> hull;
  std::optional<Tiles> tiles;      ///< where equal work is looked for, if there seems to be much of it
  Tiles::Numbers tiles_with_over;  ///< [tile] equal numbers where the same cells count as T, too; if any do
  std::vector<AbstractAgent> like_agents;  ///< that can change places, in S too; two or more, or none
  std::optional<CellOrder> order;

  /// What tubes must stay in, if there are any. @pre S is there
  [[nodiscard]] TubeSets tubes() const;
  /// Which rows are whose, or null.
  [[nodiscard]] const RowShare* shared_rows() const { return share ? &*share : nullptr; }
  /// The cells that count as T, or null.
  [[nodiscard]] const CellSet* over_or_null() const { return over ? &*over : nullptr; }
  /// Cells of a set in the rows of all processes. Together.
  [[nodiscard]] std::int64_t count(const CellSet& set) const;
  /// The tiles or null.
  [[nodiscard]] const Tiles* equal_work() const { return tiles ? &*tiles : nullptr; }
  /// Work that is equal where S is, and G of a goal that ends the task; or none.
  [[nodiscard]] EqualWork equal(const RowSymmetry* symmetry = nullptr) const {
    return {equal_work(), tiles && over ? &tiles_with_over : nullptr, symmetry};
  }
  /// Where answers are the same but for the order of like agents, if the inputs of each class are chosen
  /// together. Nothing if there is no such place.
  [[nodiscard]] std::optional<RowSymmetry> symmetry(const std::vector<InputClass>& classes) const;
};

/// S and the engine, on an abstraction that is there. Together.
void lay_ground(Ground& ground, ThreadTeam& team);

/// Rows that a process would own, and hold of others.
struct RankRows {
  std::int64_t own = 0;
  std::int64_t ghosts = 0;
  std::vector<double> slices = {};  ///< RowFractions::slices
};
/// Of so many processes, on an abstraction that is there. Ghost rows are those of all cells, in S or not.
[[nodiscard]] std::vector<RankRows> rows_of_ranks(const Ground& ground, int ranks);

}  // namespace coordreq
