#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/action_groups.hpp"
#include "engine/cell_set.hpp"
#include "engine/pair_table.hpp"

namespace coordreq {

/// The rules of the agents of a class (contract, section 9), each over inputs of its own.
struct ClassRules {
  /// Some agent has no rule: the actions of the class are in the projection of C(x), too.
  bool asks_controller = false;
  /// Rules that do not permit all actions: indices into ActionGrouping::sources(), and the agent of each.
  std::vector<std::size_t> sources;
  std::vector<std::size_t> agents;
  std::size_t agent = 0;  ///< named where the class has no action, though no single rule forbids all
};

/// The rules by which the classes of a partition act instead of by C.
struct SilentRules {
  const CellSet* cells = nullptr;        ///< the cells in which the rules are asked for
  std::vector<ClassRules> classes;       ///< [class] of the grouping
  std::vector<const PairTable*> tables;  ///< [source]; null: the source is no rule
  /// [agent] Number of cells in own rows in which its class is the first without an action; null: not
  /// counted.
  std::vector<std::atomic<std::int64_t>>* lacking = nullptr;

  /// Whether every class may take all of its actions in all cells.
  [[nodiscard]] bool permit_all() const {
    for (const ClassRules& rules : classes) {
      if (rules.asks_controller || !rules.sources.empty()) return false;
    }
    return true;
  }
};

}  // namespace coordreq
