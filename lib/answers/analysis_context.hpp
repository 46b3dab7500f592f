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

/// A controller file of the user: the pairs that it lists.
struct ListedController {
  std::string sha256;  ///< of the file
  PackedPairs pairs;
};

/// The data that all answers to a problem share: its abstraction, S, and the engine that reads them.
///
/// 1. Rows, columns and dimensions are those of the grid of the abstraction, with the states in the order of
///    the model; `order` maps cells of the spec's grid to them. Inputs and agents are the spec's.
/// 2. Neither copied nor moved: members refer to one another.
/// 3. `abstraction` is there after the stage "abstraction" (`share` too, if rows are cut before there are
///    tables), all members after it after "safe set".
/// 4. Threads: any number may read once "safe set" is over; no member changes after that.
struct AnalysisContext {
  /// @param all the processes that share the work; null: there is one process
  explicit AnalysisContext(const Model& problem, Ranks* all = nullptr)
      : model(problem), spec(problem.spec()), ranks(all) {}
  AnalysisContext(const AnalysisContext&) = delete;
  AnalysisContext& operator=(const AnalysisContext&) = delete;

  const Model& model;
  const ProblemSpec& spec;
  Ranks* ranks;
  std::optional<ListedController> listed;  ///< if there is one; the model then has the order of the spec
  std::optional<Abstraction> abstraction;
  /// Which process owns which rows; nothing: there is one process.
  std::optional<RowShare> share;
  CellSet safe;                 ///< S, in the rows held
  std::int64_t safe_cells = 0;  ///< |S|
  /// G of a goal that ends the task, a part of S: cells that count as T (contract, section 5). Nothing if no
  /// goal ends the task.
  std::optional<CellSet> terminal;
  std::int64_t terminal_cells = 0;  ///< |G|, 0 if there is none
  PairRules pairs;
  std::optional<CellSet> beyond;  ///< TubeSets::beyond
  std::optional<RowEngine> engine;
  std::optional<RowHull> hull;
  std::optional<Tiles> tiles;  ///< in which equal work is found; nothing where a sample has little of it
  Tiles::Numbers
      tiles_with_terminal;  ///< [tile] equal numbers where the same cells count as T, too; empty if none do
  /// Agents that can be exchanged, in S too; two or more, or none. Of several processes none: on three
  /// vehicles it saved 7 % of the time of two processes and 12 % of eight, which then hold the rows of all
  /// orders.
  std::vector<AbstractAgent> like_agents;
  std::optional<CellOrder> order;

  /// The sets that tubes must stay in, if there are tubes. @pre S is there
  [[nodiscard]] TubeSets tubes() const;
  /// Which process owns which rows, or null.
  [[nodiscard]] const RowShare* shared_rows() const { return share ? &*share : nullptr; }
  /// The cells that count as T, or null.
  [[nodiscard]] const CellSet* terminal_or_null() const { return terminal ? &*terminal : nullptr; }
  /// Cells of a set in the rows of all processes. Together. @param team null: this thread alone
  [[nodiscard]] std::int64_t count(const CellSet& set, ThreadTeam* team = nullptr) const;
  /// The tiles or null.
  [[nodiscard]] const Tiles* equal_work() const { return tiles ? &*tiles : nullptr; }
  /// Equal work of an operator that depends on the tables, S, and G of a goal that ends the task.
  [[nodiscard]] EqualWork equal(const RowSymmetry* symmetry = nullptr) const {
    return {equal_work(), tiles && terminal ? &tiles_with_terminal : nullptr, symmetry};
  }
  /// The symmetry under which answers are the same, if the inputs of each class are chosen together; nothing
  /// if there is none.
  [[nodiscard]] std::optional<RowSymmetry> symmetry(const std::vector<InputClass>& classes) const;
};

/// Finds S and makes the engine. @pre unchecked: the abstraction is there. Together.
void set_up_context(AnalysisContext& context, ThreadTeam& team);

}  // namespace coordreq
