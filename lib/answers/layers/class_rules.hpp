#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/action_groups.hpp"
#include "engine/cell_set.hpp"
#include "engine/pair_table.hpp"

namespace coordreq {

/// What a class does by rules of its agents (contract, section 9), each over inputs of its own.
struct ClassRules {
  /// Some agent has no rule: what the class does is in the projection of C(x), too.
  bool asks_controller = false;
  /// Those that do not permit everything: places among ActionGrouping::sources(), and whose each is.
  std::vector<std::size_t> sources;
  std::vector<std::size_t> agents;
  std::size_t agent = 0;  ///< who is named where the class has no action and no rule alone is why
};

/// What the classes of a partition do by rules instead of by C.
struct SilentRules {
  const CellSet* cells = nullptr;        ///< where that is asked for
  std::vector<ClassRules> classes;       ///< of the grouping
  std::vector<const PairTable*> tables;  ///< [source]; null: it is no rule
  /// [agent] In how many of the cells of own rows its class has no action, if no class before it is without
  /// one: counted where it is not null.
  std::vector<std::atomic<std::int64_t>>* lacking = nullptr;

  /// In no class there is anything to be known of single cells.
  [[nodiscard]] bool permit_all() const {
    for (const ClassRules& own : classes) {
      if (own.asks_controller || !own.sources.empty()) return false;
    }
    return true;
  }
};

}  // namespace coordreq
